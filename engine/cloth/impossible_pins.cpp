#include "cloth/impossible_pins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cloth/frame_inputs.h"
#include "scene/collider_pose.h"
#include "scene/vectors.h"

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
        is_dynamic[cloth.grid.particle(static_cast<std::uint32_t>(particle.index.x),
                                       static_cast<std::uint32_t>(particle.index.y))] = true;
        const DynamicPin& pin = cloth.dynamic_pins[static_cast<std::size_t>(particle.index.z)];
        if (pin.release && *pin.release <= time) continue;
        const RigidTransform motion = pin_transform(pin, time);
        const Vec3 rest{particle.rest.x, particle.rest.y, particle.rest.z};
        Vec3 now = rotate(motion.rotation, rest);
        for (std::size_t k = 0; k < 3; ++k) now[k] += motion.translation[k];
        held.push_back({rest, now});
    }
    for (std::size_t particle = 0; particle < cloth.position.size(); ++particle) {
        const glsl::vec4& at = cloth.position[particle];
        if (at.w != 0 || is_dynamic[particle]) continue;
        const Vec3 place{at.x, at.y, at.z};
        held.push_back({place, place});
    }
    return held;
}

double square(double value) { return value * value; }
double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

// These tell whether a point, in the shape's own frame about its centre, is inside.
bool inside(const Plane& plane, const Vec3& p) { return dot(p, plane.normal) < 0; }
bool inside(const Sphere& sphere, const Vec3& p) { return dot(p, p) < square(sphere.radius); }
bool inside(const Box& box, const Vec3& p) {
    return std::abs(p[0]) < box.half_extents[0] && std::abs(p[1]) < box.half_extents[1] &&
           std::abs(p[2]) < box.half_extents[2];
}
bool inside(const Ellipsoid& ellipsoid, const Vec3& p) {
    return square(p[0] / ellipsoid.radii[0]) + square(p[1] / ellipsoid.radii[1]) + square(p[2] / ellipsoid.radii[2]) <
           1;
}
bool inside(const Capsule& capsule, const Vec3& p) {
    const double half = 0.5 * distance(capsule.from, capsule.to), along = p[1] - std::clamp(p[1], -half, half);
    return square(p[0]) + square(along) + square(p[2]) < square(std::min(capsule.radii[0], capsule.radii[1]));
}

bool inside(const Collider& collider, double time, const Vec3& point) {
    const ColliderPose pose = collider_pose(collider, time);
    const auto& r = pose.rotation;
    const Vec3 from{point[0] - pose.center[0], point[1] - pose.center[1], point[2] - pose.center[2]};
    Vec3 local{};
    for (std::size_t k = 0; k < 3; ++k) local[k] = r[k] * from[0] + r[3 + k] * from[1] + r[6 + k] * from[2];
    return std::visit([&](const auto& shape) { return inside(shape, local); }, collider.shape);
}

std::string in_collider(const SimulationModel& model, const ClothModel& cloth, const std::vector<Held>& held,
                        double time) {
    for (std::size_t index = 0; index < model.scene.colliders.size(); ++index) {
        const Collider& collider = model.scene.colliders[index];
        const auto deep = std::ranges::count_if(held, [&](const Held& one) { return inside(collider, time, one.now); });
        if (deep > 0)
            return fmt::format("{} of the particles that cloth '{}' is held by {} inside collider {} (of {})", deep,
                               cloth.name, deep == 1 ? "is" : "are", index, collider_lists[collider.shape.index()]);
    }
    return {};
}

std::string too_far_apart(const SimulationModel& model, const ClothModel& cloth, const std::vector<Held>& held) {
    if (!cloth.rigid || cloth.start_strain > 0) return {};
    const double limit = model.stretch_limits().worst;
    const std::size_t stride = held.size() / 256 + 1;  // all pairs of many take long
    double worst = 0;
    for (std::size_t a = 0; a < held.size(); a += stride)
        for (std::size_t b = 0; b < a; b += stride)
            worst = std::max(worst, distance(held[a].now, held[b].now) / distance(held[a].rest, held[b].rest) - 1);
    if (worst <= limit) return {};
    return fmt::format("pins hold two particles of cloth '{}', which is rigid, {:.3g} % farther apart than at rest",
                       cloth.name, 100 * worst);
}

}  // namespace

std::string impossible_pins(const SimulationModel& model, std::uint32_t frame) {
    const double time = frame / model.scene.time.fps;
    for (const ClothModel& cloth : model.cloths) {
        const std::vector<Held> held = held_particles(cloth, time);
        if (std::string text = in_collider(model, cloth, held, time); !text.empty()) return text;
        if (std::string text = too_far_apart(model, cloth, held); !text.empty()) return text;
    }
    return {};
}

}  // namespace drape
