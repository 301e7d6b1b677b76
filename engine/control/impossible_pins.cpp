#include "control/impossible_pins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/frame_inputs.h"
#include "world/collider_pose.h"
#include "world/surface_distance.h"

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

/// Returns how deep (m) a point is below the collider's surface; 0: it is outside.
double depth_in(const Collider& collider, const ColliderPose& pose, const Vec3& point) {
    if (distance(point, pose.center) > shape_geometry(collider.shape).reach) return 0;  // spares the costly distance
    return std::max(0.0, -exact::surface_distance(collider, pose, point));
}

std::optional<HeldInside> deepest(const SimulationModel& model, const std::vector<Held>& held, double time) {
    std::optional<HeldInside> found;
    for (std::size_t index = 0; index < model.scene.colliders.size(); ++index) {
        if (held.empty()) break;
        const Collider collider = formed(model.scene.colliders[index], time);
        const ColliderPose pose = collider_pose(collider, time);
        HeldInside one{index, 0, 0};
        for (const Held& particle : held) {
            const double depth = depth_in(collider, pose, particle.now);
            if (!(depth > 0)) continue;
            ++one.particles;
            one.depth = std::max(one.depth, depth);
        }
        if (one.particles > 0 && (!found || one.depth > found->depth)) found = one;
    }
    return found;
}

std::string in_collider(const SimulationModel& model, const ClothModel& cloth, const std::vector<Held>& held,
                        double time) {
    const std::optional<HeldInside> found = deepest(model, held, time);
    if (!found) return {};
    return fmt::format("{} of the particles that cloth '{}' is held by {} inside collider {} (of {}), up to {:.3g} m",
                       found->particles, cloth.name, found->particles == 1 ? "is" : "are", found->collider,
                       collider_lists[model.scene.colliders[found->collider].shape.index()], found->depth);
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

std::optional<HeldInside> held_inside(const SimulationModel& model, std::size_t cloth, double time) {
    if (model.scene.colliders.empty()) return std::nullopt;
    return deepest(model, held_particles(model.cloths[cloth], time), time);
}

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
