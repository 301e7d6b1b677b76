#include "cloth/frame_inputs.h"

#include <cmath>

#include "cloth/collider_pose.h"
#include "scene/gust.h"
#include "scene/motion.h"

namespace drape {

namespace {

glsl::vec4 row(const std::array<double, 9>& m, std::size_t k, double w) {
    return {static_cast<float>(m[3 * k]), static_cast<float>(m[3 * k + 1]), static_cast<float>(m[3 * k + 2]),
            static_cast<float>(w)};
}

template <class Shape>
glsl::Collider collider_record(const Shape& shape, double before, double now, const glsl::vec4& size) {
    const ColliderPose pose = collider_pose(shape, now);
    glsl::Collider record{row(pose.rotation, 0, pose.center[0]),
                          row(pose.rotation, 1, pose.center[1]),
                          row(pose.rotation, 2, pose.center[2]),
                          {},
                          {},
                          {},
                          size};
    if (shape.path.moves()) {
        const ColliderPose last = collider_pose(shape, before);
        ColliderPose change;
        for (std::size_t k = 0; k < 9; ++k) change.rotation[k] = pose.rotation[k] - last.rotation[k];
        for (std::size_t k = 0; k < 3; ++k) change.center[k] = pose.center[k] - last.center[k];
        record.change_x = row(change.rotation, 0, change.center[0]);
        record.change_y = row(change.rotation, 1, change.center[1]);
        record.change_z = row(change.rotation, 2, change.center[2]);
    }
    return record;
}

glsl::vec4 shape_texel(const Vec3& size, double friction) {
    return {static_cast<float>(size[0]), static_cast<float>(size[1]), static_cast<float>(size[2]),
            static_cast<float>(std::sqrt(friction))};
}

void add_colliders(FrameInputs& inputs, const Colliders& colliders, const std::array<bool, 4>& wanted, double before,
                   double now) {
    if (wanted[0])
        for (const PlaneCollider& plane : colliders.planes) {
            const std::array<double, 9> r = collider_pose(plane, now).rotation;
            Vec3 n;
            for (std::size_t k = 0; k < 3; ++k)
                n[k] = r[3 * k] * plane.normal[0] + r[3 * k + 1] * plane.normal[1] + r[3 * k + 2] * plane.normal[2];
            inputs.colliders[0].push_back(collider_record(plane, before, now, shape_texel(n, plane.friction)));
        }
    if (wanted[1])
        for (const SphereCollider& sphere : colliders.spheres)
            inputs.colliders[1].push_back(
                collider_record(sphere, before, now, shape_texel({sphere.radius, 0, 0}, sphere.friction)));
    if (wanted[2])
        for (const BoxCollider& box : colliders.boxes)
            inputs.colliders[2].push_back(
                collider_record(box, before, now, shape_texel(box.half_extents, box.friction)));
    if (wanted[3])
        for (const EllipsoidCollider& ellipsoid : colliders.ellipsoids)
            inputs.colliders[3].push_back(
                collider_record(ellipsoid, before, now, shape_texel(ellipsoid.radii, ellipsoid.friction)));
}

/// Motion of a pin: x = R (rest - pivot) + pivot + translation.
glsl::PinMotion pin_motion(const DynamicPin& pin, double start, double end) {
    const RigidTransform motion = motion_at(pin.path, end);
    const auto& r = motion.rotation;
    Vec3 shift;
    for (std::size_t k = 0; k < 3; ++k)
        shift[k] = pin.pivot[k] + motion.translation[k] -
                   (r[3 * k] * pin.pivot[0] + r[3 * k + 1] * pin.pivot[1] + r[3 * k + 2] * pin.pivot[2]);
    const float held = pin.release && *pin.release <= start + 1e-9 ? 0.0f : 1.0f;
    return {row(r, 0, shift[0]), row(r, 1, shift[1]), row(r, 2, shift[2]), {held, 0, 0, 0}};
}

template <class List>
bool any_moves(const List& list) {
    for (const auto& collider : list)
        if (collider.path.moves()) return true;
    return false;
}

std::array<std::size_t, collider_kind_count> collider_counts(const Colliders& c) {
    return {c.planes.size(), c.spheres.size(), c.boxes.size(), c.ellipsoids.size()};
}

}  // namespace

std::array<bool, collider_kind_count> moving_kinds(const Colliders& c) {
    return {any_moves(c.planes), any_moves(c.spheres), any_moves(c.boxes), any_moves(c.ellipsoids)};
}

std::size_t collider_record_count(const SceneDescription& scene, ColliderKind kind) {
    const auto index = static_cast<std::size_t>(kind);
    return collider_counts(scene.colliders)[index] * (moving_kinds(scene.colliders)[index] ? scene.solver.substeps : 1);
}

FrameInputs frame_inputs(const SimulationModel& model, std::uint32_t frame) {
    const SceneDescription& scene = model.scene;
    const double frame_start = (static_cast<double>(frame) - 1) / scene.time.fps;
    const double h = 1.0 / (scene.time.fps * scene.solver.substeps);
    const std::array<bool, collider_kind_count> moving = moving_kinds(scene.colliders);
    FrameInputs inputs;
    inputs.pins.resize(model.cloths.size());
    for (std::uint32_t substep = 0; substep < scene.solver.substeps; ++substep) {
        const double start = frame_start + substep * h, end = frame_start + (substep + 1) * h;
        if (model.windy) {
            const Vec3 wind = wind_velocity(scene.wind, 0.5 * (start + end));
            inputs.wind.push_back(row({wind[0], wind[1], wind[2]}, 0, 0));
        }
        std::array<bool, collider_kind_count> wanted;
        for (std::size_t kind = 0; kind < collider_kind_count; ++kind) wanted[kind] = moving[kind] || substep == 0;
        add_colliders(inputs, scene.colliders, wanted, start, end);
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            for (const DynamicPin& pin : model.cloths[cloth].dynamic_pins)
                inputs.pins[cloth].push_back(pin_motion(pin, start, end));
    }
    return inputs;
}

glsl::ivec4 first_colliders(const SceneDescription& scene, std::uint32_t substep) {
    const std::array<bool, collider_kind_count> moving = moving_kinds(scene.colliders);
    const auto counts = collider_counts(scene.colliders);
    const auto first = [&](std::size_t kind) { return moving[kind] ? static_cast<int>(counts[kind] * substep) : 0; };
    return {first(0), first(1), first(2), first(3)};
}

}  // namespace drape
