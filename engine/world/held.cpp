#include "world/held.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/motion.h"
#include "world/overlap.h"
#include "world/start.h"
#include "world/surface_distance.h"

namespace drape {

namespace {

constexpr double least_held_depth = 1e-3, least_jump = 1e-2;  ///< edge lengths; smaller values are rounding
constexpr double most_distances =
    1e6;  ///< distances computed for a pin; the instants are reduced to that, but not below least_instants
constexpr double least_instants = 64;
constexpr int parts_of_a_frame = 4;  ///< parts examined where method auto chooses the substeps

/// The particles that a pin holds, where they start, in m.
struct HeldByPin {
    std::vector<Vec3> rest;
    Vec3 pivot{0, 0, 0};
};

/// A particle belongs to the last pin that names it.
std::vector<HeldByPin> held_by_pin(const Cloth& cloth) {
    std::vector<HeldByPin> held(cloth.pins.size());
    const std::size_t columns = cloth.grid[0];
    std::vector<int> owner(columns * cloth.grid[1], -1);
    for (std::size_t pin = 0; pin < cloth.pins.size(); ++pin) {
        const IndexBox& box = cloth.pins[pin].particles;
        for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
            for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column)
                owner[row * columns + column] = static_cast<int>(pin);
    }
    for (std::size_t particle = 0; particle < owner.size(); ++particle)
        if (owner[particle] >= 0)
            held[static_cast<std::size_t>(owner[particle])].rest.push_back(start_place(
                cloth, static_cast<std::uint32_t>(particle % columns), static_cast<std::uint32_t>(particle / columns)));
    for (std::size_t pin = 0; pin < held.size(); ++pin) {
        for (const Vec3& at : held[pin].rest)
            held[pin].pivot = plus(held[pin].pivot, times(1 / static_cast<double>(held[pin].rest.size()), at));
        held[pin].pivot = cloth.pins[pin].pivot.value_or(held[pin].pivot);
    }
    return held;
}

Vec3 led(const RigidTransform& motion, const Vec3& pivot, const Vec3& rest) {
    return plus(plus(rotate(motion.rotation, minus(rest, pivot)), pivot), motion.translation);
}

/// Returns the least distance along the straight path between two points; for a convex shape the distance is convex
/// there.
double least_between(const Collider& collider, Vec3 from, Vec3 to) {
    const auto distance = [&](const Vec3& at) {
        return std::visit([&](const auto& shape) { return exact::shape_distance(shape, at); }, collider.shape);
    };
    for (int step = 0; step < 40; ++step) {
        const Vec3 way = minus(to, from), a = plus(from, times(1.0 / 3, way)), b = plus(from, times(2.0 / 3, way));
        distance(a) < distance(b) ? to = b : from = a;
    }
    return distance(from);
}

/// One pin beside one collider, at the examined instants.
class Beside {
  public:
    Beside(const Pin& pin, const HeldByPin& held, const Collider& collider)
        : pin_(pin),
          held_(held),
          given_(collider),
          collider_(formed(collider, 0)),
          reach_(shape_geometry(collider.shape).reach) {
        const ColliderPose pose = collider_pose(collider, 0);
        for (const Vec3& rest : held.rest) start_ = std::max(start_, -distance(exact::to_local(pose, rest)));
    }
    double start() const { return start_; }

    /// Examines the next instant. `frame` ends at this instant or after it; depths below `least` do not count.
    void look(double time, std::uint32_t frame, double least, HeldDeep& found) {
        const RigidTransform motion = motion_at(pin_.path, time);
        const ColliderPose pose = collider_pose(collider_, time);
        if (given_.deforms()) collider_ = formed(given_, time);
        const bool first = before_.empty();
        before_.resize(held_.rest.size());
        for (std::size_t k = 0; k < held_.rest.size(); ++k) {
            const Vec3 local = exact::to_local(pose, led(motion, held_.pivot, held_.rest[k]));
            const At now{local, distance(local)};
            double depth = -now.distance;
            const bool inside = depth > least;
            const double way = first ? 0 : length(minus(local, before_[k].local));
            if (now.distance > 0 && before_[k].distance > 0 && now.distance + before_[k].distance < way)
                depth = -least_between(collider_, before_[k].local, local);
            before_[k] = now;
            if (!(depth > least)) continue;
            if (found.depth == 0) found.first = frame;
            found.stays = found.stays || inside;
            if (depth > found.depth) found.depth = depth, found.worst = frame;
        }
    }

  private:
    struct At {
        Vec3 local{};
        double distance = 0;  ///< m; an estimate from below where the particle is beyond the shape's reach
    };
    double distance(const Vec3& local) const {
        if (const double off = length(local) - reach_; off > 0) return off;  // spares the costly distance
        return std::visit([&](const auto& shape) { return exact::shape_distance(shape, local); }, collider_.shape);
    }
    const Pin& pin_;
    const HeldByPin& held_;
    const Collider& given_;
    Collider collider_;
    double reach_, start_ = 0;
    std::vector<At> before_;
};

/// Returns the collider in which a pin's particles come to be deepest.
HeldDeep deepest_of(const SceneDescription& scene, const Cloth& cloth, const Pin& pin, const HeldByPin& held) {
    const double fps = scene.time.fps, last = (scene.time.frame_count - 1) / fps;
    const double end = std::min(pin.release.value_or(last), last);
    const bool chosen = scene.solver.method == SolverMethod::automatic;
    const double distances = static_cast<double>(held.rest.size() * scene.colliders.size());
    const double instants = std::ceil(std::min(end * fps * (chosen ? parts_of_a_frame : scene.solver.substeps),
                                               std::max(least_instants, most_distances / distances)));
    HeldDeep worst;
    for (std::size_t index = 0; index < scene.colliders.size(); ++index) {
        const Collider& collider = scene.colliders[index];
        if (!collider.moves() && pin.path.keys.empty()) continue;
        Beside beside(pin, held, collider);
        const double least = std::max(least_held_depth * least_spacing(cloth), 1.001 * beside.start());
        HeldDeep one;
        one.collider = index;
        // Forms of a mesh are costly to compute, so only those at whole frames are examined.
        const double count = collider.deforms() ? std::min(instants, std::ceil(end * fps)) : instants;
        for (double k = 0; k <= count; ++k) {
            const double time = count > 0 ? end * k / count : 0;
            beside.look(time, static_cast<std::uint32_t>(std::ceil(time * fps - 1e-6)), least, one);
        }
        if (one.depth > worst.depth) worst = one;
    }
    return worst;
}

}  // namespace

std::vector<HeldDeep> held_in_colliders(const SceneDescription& scene) {
    std::vector<HeldDeep> all;
    if (scene.colliders.empty()) return all;
    for (std::size_t index = 0; index < scene.cloths.size(); ++index) {
        const Cloth& cloth = scene.cloths[index];
        if (cloth.pins.empty()) continue;
        const std::vector<HeldByPin> held = held_by_pin(cloth);
        for (std::size_t pin = 0; pin < cloth.pins.size(); ++pin) {
            if (held[pin].rest.empty()) continue;
            HeldDeep found = deepest_of(scene, cloth, cloth.pins[pin], held[pin]);
            found.cloth = index;
            found.pin = pin;
            if (found.depth > 0) all.push_back(found);
        }
    }
    return all;
}

std::vector<PathJump> path_jumps(const SceneDescription& scene) {
    std::vector<PathJump> all;
    for (std::size_t index = 0; index < scene.cloths.size(); ++index) {
        const Cloth& cloth = scene.cloths[index];
        const auto begins = [](const Pin& pin) {
            return pin.path.keys.empty() || motion_at(pin.path, 0) == RigidTransform{};
        };
        if (std::ranges::all_of(cloth.pins, begins)) continue;
        const std::vector<HeldByPin> held = held_by_pin(cloth);
        for (std::size_t pin = 0; pin < cloth.pins.size(); ++pin) {
            PathJump jump{index, pin, 0};
            const RigidTransform motion = motion_at(cloth.pins[pin].path, 0);
            for (const Vec3& rest : held[pin].rest)
                jump.distance = std::max(jump.distance, length(minus(led(motion, held[pin].pivot, rest), rest)));
            if (jump.distance > least_jump * least_spacing(cloth)) all.push_back(jump);
        }
    }
    return all;
}

std::string held_text(const SceneDescription& scene, const HeldDeep& held) {
    return fmt::format(
        "cloth \"{}\" is held up to {:.3g} m inside {}, from frame {} on, deepest in "
        "frame {}{}",
        scene.cloths[held.cloth].name, held.depth, collider_place(scene, held.collider), held.first, held.worst,
        held.stays ? "" : ", and led through it within a substep");
}

}  // namespace drape
