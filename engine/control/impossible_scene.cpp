#include "control/impossible_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/frame_inputs.h"
#include "world/collider_pose.h"
#include "world/contact_shape.h"
#include "world/overlap.h"
#include "world/surface_distance.h"
#include "world/weather.h"

namespace drape {

namespace {

struct Held {
    Vec3 rest, now;  ///< m
};

/// Returns the particles that pins hold at a time.
std::vector<Held> held_particles(const ClothModel& cloth, double time) {
    std::vector<bool> is_dynamic(cloth.position.size());
    std::vector<Held> held;
    for (const glsl::PinnedParticle& particle : cloth.pinned) {
        const DynamicPin& pin = cloth.dynamic_pins[static_cast<std::size_t>(particle.index.z)];
        if (pin.hand || pin.follows) continue;  // where it took its particles is not known here
        is_dynamic[cloth.grid.particle(static_cast<std::uint32_t>(particle.index.x),
                                       static_cast<std::uint32_t>(particle.index.y))] = true;
        if (pin.release && *pin.release <= time) continue;
        const RigidTransform motion = pin_transform(pin, time);
        const Vec3 rest{particle.rest.x, particle.rest.y, particle.rest.z};
        held.push_back({rest, plus(rotate(motion.rotation, rest), motion.translation)});
    }
    for (std::size_t particle = 0; particle < cloth.position.size(); ++particle) {
        const glsl::vec4& at = cloth.position[particle];
        if (at.w != 0 || is_dynamic[particle]) continue;
        const Vec3 place{at.x, at.y, at.z};
        held.push_back({place, place});
    }
    return held;
}

/// Returns the point of the collider nearest to `point`; for a point inside, the point itself.
Vec3 projected(const Collider& collider, const ColliderPose& pose, const Vec3& point) {
    const double distance = exact::surface_distance(collider, pose, point);
    if (!(distance > 0)) return point;
    const double step = 1e-6 * std::max(1.0, distance);
    Vec3 normal{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vec3 before = point, after = point;
        before[axis] -= step;
        after[axis] += step;
        normal[axis] = exact::surface_distance(collider, pose, after) - exact::surface_distance(collider, pose, before);
    }
    const double size = length(normal);
    return size > 0 ? minus(point, times(distance / size, normal)) : point;
}

/// Contact keeps particles out of enlarged shapes, so that the cloth's triangles stay outside the colliders themselves.
std::optional<Finding> pinched_between(const SimulationModel& model, const Cloth& cloth, std::size_t a, std::size_t b,
                                       double time) {
    const Collider &one = model.scene.colliders[a], &other = model.scene.colliders[b];
    const auto stays = [](const Collider& each) { return each.path.keys.empty() && !each.deforms(); };
    if (stays(one) && stays(other)) return {};  // two colliders at rest are as far apart as at the start
    const double room = room_between(one, other, time), at_start = room_between(one, other, 0);
    if (!(room < at_start)) return {};
    const double kept_out = room_between(contact_shape(cloth, one), contact_shape(cloth, other), 0);
    const double thickness = least_thickness(cloth), taken = at_start - kept_out + 2 * thickness;
    if (!(room < taken) || kept_out < 2 * thickness) return {};
    return Finding{.value = taken,
                   .bound = room,
                   .collider = collider_place(model.scene, a),
                   .other = collider_place(model.scene, b)};
}

}  // namespace

std::optional<HeldInside> held_inside(const SimulationModel& model, std::size_t cloth, double time) {
    std::optional<HeldInside> found;
    if (model.scene.colliders.empty()) return found;
    const std::vector<Held> held = held_particles(model.cloths[cloth], time);
    for (std::size_t index = 0; index < model.scene.colliders.size() && !held.empty(); ++index) {
        if (model.scene.colliders[index].mass) continue;  // only the device knows where it is
        const Collider collider = formed(model.scene.colliders[index], time);
        const ColliderPose pose = collider_pose(collider, time);
        const double reach = shape_geometry(collider.shape).reach;
        HeldInside one{index, 0, 0};
        for (const Held& particle : held) {
            if (distance(particle.now, pose.center) > reach) continue;  // spares the costly distance
            const double depth = -exact::surface_distance(collider, pose, particle.now);
            if (!(depth > 0)) continue;
            ++one.particles;
            one.depth = std::max(one.depth, depth);
        }
        if (one.depth > (found ? found->depth : 0)) found = one;
    }
    return found;
}

double room_between(const Collider& one, const Collider& other, double time) {
    const Collider a = formed(one, time), b = formed(other, time);
    const ColliderPose pose_a = collider_pose(a, time), pose_b = collider_pose(b, time);
    Vec3 on_a = pose_a.center, on_b = pose_b.center;
    double room = 0;
    constexpr int most_rounds = 500;
    for (int round = 0; round < most_rounds; ++round) {
        on_a = projected(a, pose_a, on_b);
        on_b = projected(b, pose_b, on_a);
        const double now = length(minus(on_a, on_b));
        if (round > 0 && !(room - now > 1e-12 * room)) break;
        room = now;
    }
    return length(minus(on_a, on_b));
}

std::optional<Finding> held_in_collider(const SimulationModel& model, std::size_t cloth, std::uint32_t frame) {
    const auto found = held_inside(model, cloth, frame / model.scene.time.fps);
    if (!found) return std::nullopt;
    return Finding{.value = found->depth,
                   .collider = collider_place(model.scene, found->collider),
                   .count = static_cast<std::uint32_t>(found->particles)};
}

std::optional<Finding> held_apart(const SimulationModel& model, std::size_t index, std::uint32_t frame, double bound) {
    const ClothModel& cloth = model.cloths[index];
    if (!cloth.rigid || cloth.start_strain > 0) return std::nullopt;
    const std::vector<Held> held = held_particles(cloth, frame / model.scene.time.fps);
    const std::size_t stride = held.size() / 256 + 1;  // testing all pairs of many particles takes long
    Finding found{.bound = bound};
    for (std::size_t a = 0; a < held.size(); a += stride)
        for (std::size_t b = 0; b < a; b += stride)
            found.value =
                std::max(found.value, distance(held[a].now, held[b].now) / distance(held[a].rest, held[b].rest) - 1);
    return found;
}

std::optional<Finding> pinched(const SimulationModel& model, std::size_t cloth, std::uint32_t frame) {
    const std::vector<Collider>& all = model.scene.colliders;
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (all[a].mass || all[b].mass) continue;  // only the device knows where they are
            if (auto found = pinched_between(model, model.scene.cloths[cloth], b, a, frame / model.scene.time.fps))
                return found;
        }
    return std::nullopt;
}

/// Drag 1/2 rho Cd v^2 accelerates cloth of areal density s to the speed v within the time 2 s / (rho Cd v).
std::optional<Finding> blown_away(const SimulationModel& model, std::size_t cloth, double bound) {
    const Wind& wind = model.scene.wind;
    if (!wind.blows() || !(wind.drag > 0)) return std::nullopt;
    const double speed = fastest_wind(wind);
    const double seconds = 2 * model.scene.cloths[cloth].areal_density / (wind.air_density * wind.drag * speed);
    return Finding{.value = 1 / (seconds * model.scene.time.fps), .bound = bound};
}

std::string impossible_scene(const SimulationModel& model, std::uint32_t frame, std::span<const SceneBound> rows) {
    for (const SceneBound& row : rows)
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
            std::optional<Finding> found = row.find(model, cloth, frame);
            if (!found || !(found->value > found->bound)) continue;
            found->cloth = model.cloths[cloth].name;
            return told(row.words, *found);
        }
    return {};
}

}  // namespace drape
