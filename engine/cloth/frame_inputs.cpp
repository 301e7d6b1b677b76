#include "cloth/frame_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "world/collider_pose.h"
#include "world/gas.h"
#include "world/gust.h"
#include "world/motion.h"
#include "world/weather.h"

namespace drape {

RigidTransform pin_transform(const DynamicPin& pin, double time) {
    RigidTransform motion = motion_at(pin.path, time);
    const auto& r = motion.rotation;
    for (std::size_t k = 0; k < 3; ++k)
        motion.translation[k] +=
            pin.pivot[k] - (r[3 * k] * pin.pivot[0] + r[3 * k + 1] * pin.pivot[1] + r[3 * k + 2] * pin.pivot[2]);
    return motion;
}

namespace {

template <int kind>
using Shape = std::variant_alternative_t<kind, ColliderShape>;
static_assert(std::variant_size_v<ColliderShape> == glsl::collider_kind_count,
              "shaders/shared/collider_types.h has another number of kinds");
static_assert(std::is_same_v<Shape<glsl::kind_plane>, Plane> && std::is_same_v<Shape<glsl::kind_sphere>, Sphere> &&
              std::is_same_v<Shape<glsl::kind_box>, Box> && std::is_same_v<Shape<glsl::kind_ellipsoid>, Ellipsoid> &&
              std::is_same_v<Shape<glsl::kind_capsule>, Capsule> && std::is_same_v<Shape<glsl::kind_mesh>, Mesh>);

glsl::vec4 row(const std::array<double, 9>& m, std::size_t k, double w) {
    return {static_cast<float>(m[3 * k]), static_cast<float>(m[3 * k + 1]), static_cast<float>(m[3 * k + 2]),
            static_cast<float>(w)};
}

/// Returns a bound, m, on how far any point of a collider's surface moves when its pose changes; a huge value for a
/// turn so wide that a straight line between the two poses is no good measure of a path (`most_way` in colliders.h).
float surface_motion(const ColliderPose& change, double reach) {
    double squared = 0;
    for (const double element : change.rotation) squared += element * element;
    const double turn = std::sqrt(squared / 2);  // the farthest that a point at distance 1 moves
    if (!(turn < 0.2) || !std::isfinite(reach)) return 1e15f;
    return static_cast<float>((length(change.center) + (turn > 0 ? turn * reach : 0)) * 1.00001);
}

}  // namespace

glsl::ColliderRecord collider_record(const Collider& collider, double before, double now, const Vec3& way_out,
                                     std::size_t field) {
    const ColliderPose pose = collider_pose(collider, now);
    Vec3 size = shape_geometry(collider.shape).size;
    if (special(collider.shape).plane) size = rotate(pose.rotation, size);
    glsl::ColliderRecord record{
        row(pose.rotation, 0, pose.center[0]),
        row(pose.rotation, 1, pose.center[1]),
        row(pose.rotation, 2, pose.center[2]),
        {},
        {},
        {},
        {static_cast<float>(size[0]), static_cast<float>(size[1]), static_cast<float>(size[2]),
         static_cast<float>(std::sqrt(collider.friction))},
        {static_cast<float>(way_out[0]), static_cast<float>(way_out[1]), static_cast<float>(way_out[2]), 0}};
    if (collider.path.moves()) {
        const ColliderPose last = collider_pose(collider, before);
        ColliderPose change;
        for (std::size_t k = 0; k < 9; ++k) change.rotation[k] = pose.rotation[k] - last.rotation[k];
        for (std::size_t k = 0; k < 3; ++k) change.center[k] = pose.center[k] - last.center[k];
        record.change_x = row(change.rotation, 0, change.center[0]);
        record.change_y = row(change.rotation, 1, change.center[1]);
        record.change_z = row(change.rotation, 2, change.center[2]);
        record.way_out.w = surface_motion(change, shape_geometry(collider.shape).reach);
    }
    if (const Mesh* mesh = special(collider.shape).mesh) {
        record.way_out.x = static_cast<float>(field);
        record.way_out.y = static_cast<float>(mesh->grown);
    }
    return record;
}

void add_deformation(glsl::ColliderRecord& record, double share, double way) {
    record.way_out.z = static_cast<float>(share);
    record.way_out.w = static_cast<float>(record.way_out.w + way * 1.00001);
}

namespace {

/// Returns h times the rate of change of the pin's motion just before a time, by the second-order backward difference.
RigidTransform pin_velocity(const DynamicPin& pin, double time, double h) {
    constexpr double step = 1.0 / 64;
    const RigidTransform now = pin_transform(pin, time), before = pin_transform(pin, time - step * h),
                         earlier = pin_transform(pin, time - 2 * step * h);
    const auto rate = [](double a, double b, double c) { return (3 * (a - b) - (b - c)) / (2 * step); };
    RigidTransform velocity;
    for (std::size_t k = 0; k < 9; ++k)
        velocity.rotation[k] = rate(now.rotation[k], before.rotation[k], earlier.rotation[k]);
    for (std::size_t k = 0; k < 3; ++k)
        velocity.translation[k] = rate(now.translation[k], before.translation[k], earlier.translation[k]);
    return velocity;
}

/// Returns A x + b for A = `rotation` R^T and b = `translation` - A t, which applies what is known of rest positions to
/// the places where x -> R x + t, a pin's motion, has taken them.
RigidTransform at_places(const RigidTransform& of_rest, const RigidTransform& motion) {
    RigidTransform found;
    for (std::size_t i = 0; i < 3; ++i) {
        found.translation[i] = of_rest.translation[i];
        for (std::size_t j = 0; j < 3; ++j) {
            double& element = found.rotation[3 * i + j];
            element = 0;
            for (std::size_t k = 0; k < 3; ++k) element += of_rest.rotation[3 * i + k] * motion.rotation[3 * j + k];
            found.translation[i] -= element * motion.translation[j];
        }
    }
    return found;
}

/// Returns how far a pin's motion takes places in a substep.
RigidTransform pin_change(const DynamicPin& pin, double start, double end) {
    const RigidTransform before = pin_transform(pin, start);
    RigidTransform change = at_places(pin_transform(pin, end), before);
    for (std::size_t k = 0; k < 3; ++k) change.rotation[4 * k] -= 1;
    return change;
}

/// Returns the velocity that a pin had when it let go, times h.
RigidTransform let_go(const DynamicPin& pin, double h) {
    const MotionPath& path = pin.let_go.keys.empty() ? pin.path : pin.let_go;
    const DynamicPin then{.path = path, .pivot = pin.pivot, .release = pin.release, .number = pin.number};
    const RigidTransform velocity = pin_velocity(then, *pin.release, h);
    return pin.follows ? at_places(velocity, pin_transform(then, *pin.release)) : velocity;
}

/// `recent`: s; a release that long ago is over, and its particles may be held by others.
glsl::PinMotion pin_motion(const DynamicPin& pin, double start, double end, double recent) {
    const double h = end - start;
    const bool released = !pin.holds(start);
    const bool over = released && start - *pin.release >= recent;
    const RigidTransform motion = released      ? let_go(pin, h)
                                  : pin.follows ? pin_change(pin, start, end)
                                                : pin_transform(pin, end);
    const auto& [r, shift] = motion;
    // A release before the start of a run takes place at its start.
    const double late = released ? std::clamp((start - std::max(*pin.release, 0.0)) / h, 0.0, 1.0) : 0.0;
    const auto& [first, last] = over ? no_particles : pin.held;
    return {
        row(r, 0, shift[0]),
        row(r, 1, shift[1]),
        row(r, 2, shift[2]),
        {released ? 0.0f : 1.0f, static_cast<float>(late), pin.follows ? 1.0f : 0.0f, 0},
        {static_cast<int>(first[0]), static_cast<int>(first[1]), static_cast<int>(last[0]), static_cast<int>(last[1])}};
}

}  // namespace

std::size_t weather_vectors(const SimulationModel& model) {
    if (!model.windy) return 0;
    std::size_t count = (model.weighs ? 2 : 1) + model.scene.gas.size();
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        if (model.cloths[cloth].member == 0) count += model.scene.cloths[cloth].loads.size();
    return count;
}

std::size_t first_weather(const SimulationModel& model, std::size_t member, std::uint32_t substep) {
    return (member * model.scene.solver.substeps + substep) * weather_vectors(model);
}

std::size_t collider_record_count(const SimulationModel& model) {
    return model.kept_colliders.size() * model.scene.colliders.size() *
           (model.colliders_move ? model.most_substeps() : 1);
}

int first_collider(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep) {
    const std::size_t lists = model.colliders_move ? model.kept_colliders.size() * substep : 0;
    return static_cast<int>(model.scene.colliders.size() * (lists + cloth.collider_list));
}

std::array<std::uint32_t, glsl::collider_kind_count> kind_ends(const std::vector<Collider>& colliders) {
    std::array<std::uint32_t, glsl::collider_kind_count> ends{};
    for (const Collider& collider : colliders)
        for (std::size_t kind = static_cast<std::size_t>(collider.kind()); kind < ends.size(); ++kind) ++ends[kind];
    return ends;
}

FrameInputs frame_inputs(const SimulationModel& model, std::uint32_t frame) {
    FrameInputs inputs;
    take_frame_inputs(model, frame, inputs);
    return inputs;
}

void take_frame_inputs(const SimulationModel& model, std::uint32_t frame, FrameInputs& inputs) {
    const SceneDescription& scene = model.scene;
    const double frame_start = (static_cast<double>(frame) - 1) / scene.time.fps;
    const double h = 1.0 / (scene.time.fps * scene.solver.substeps);
    inputs.wind.clear();
    inputs.openings.clear();
    inputs.colliders.clear();
    inputs.collider_sets = model.colliders_move ? scene.solver.substeps : 1;
    inputs.stiffness.clear();
    if (std::ranges::any_of(model.cloths, &ClothModel::stiffens))
        for (const Cloth& cloth : scene.cloths)
            inputs.stiffness.push_back(static_cast<float>(stiffness_factor(scene, cloth, frame)));
    inputs.body_actions = model.options.bodies ? body_actions(model) : std::vector<glsl::BodyAction>();
    inputs.forms = model.mesh_fields.forms(frame_start, frame / scene.time.fps);
    // Distances change at constant speed from those at the frame's start to those at its end, whatever poses lie
    // between.
    std::vector<double> ways;
    for (const Collider& collider : scene.colliders)
        ways.push_back(deformed(collider, frame_start, frame / scene.time.fps) / scene.solver.substeps);
    const double recent = frame > 1 ? 1 / scene.time.fps - 1e-9 : std::numeric_limits<double>::infinity();
    inputs.pins.resize(model.cloths.size());
    for (std::vector<glsl::PinMotion>& pins : inputs.pins) pins.clear();
    for (std::uint32_t substep = 0; substep < scene.solver.substeps; ++substep) {
        const double start = frame_start + substep * h, end = frame_start + (substep + 1) * h;
        if (model.windy) {
            const Vec3 wind = wind_velocity(scene.wind, 0.5 * (start + end));
            inputs.wind.push_back(row({wind[0], wind[1], wind[2]}, 0, 0));
            if (model.weighs) {
                const Vec3 more = minus(gravity_at(scene, 0.5 * (start + end)), gravity_at(scene, 0));
                inputs.wind.push_back(row({more[0], more[1], more[2]}, 0, 0));
            }
        }
        for (const Cloth& cloth : scene.cloths)
            for (const Load& load : cloth.loads) {
                const double middle = 0.5 * (start + end);
                const Vec3 force = force_at(load, middle);
                inputs.wind.push_back(row({force[0], force[1], force[2]}, 0, pressure_at(load, middle)));
            }
        for (const Gas& gas : scene.gas)
            inputs.wind.push_back({static_cast<float>(gas_at(gas, 0.5 * (start + end))), 0, 0, 0});
        for (const double closed : model.closings)
            inputs.openings.push_back(
                {{static_cast<float>(opening_at(start, closed)), static_cast<float>(opening_at(end, closed))}});
        if (substep == 0 || model.colliders_move)
            for (const std::vector<KeptCollider>& list : model.kept_colliders)
                for (std::size_t k = 0; k < list.size(); ++k) {
                    const auto& [collider, way_out] = list[k];
                    inputs.colliders.push_back(collider_record(collider, start, end,
                                                               start < way_out.until ? way_out.normal : Vec3{},
                                                               model.mesh_fields.first(k)));
                    if (collider.deforms())
                        add_deformation(inputs.colliders.back(), (substep + 1.0) / scene.solver.substeps, ways[k]);
                }
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            for (const DynamicPin& pin : model.cloths[cloth].dynamic_pins)
                inputs.pins[cloth].push_back(pin_motion(pin, start, end, recent));
    }
}

}  // namespace drape
