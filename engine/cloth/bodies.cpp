#include "cloth/bodies.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/forces.h"
#include "cloth/frame_inputs.h"
#include "cloth/method.h"
#include "cloth/simulation_model.h"
#include "cloth/texels.h"
#include "mesh/mesh_shape.h"
#include "world/body_pose.h"
#include "world/collider_pose.h"
#include "world/mass_properties.h"
#include "world/overlap.h"
#include "world/weather.h"

namespace drape {

namespace {

double substep_length(const SimulationModel& model) { return 1 / (model.scene.time.fps * model.scene.solver.substeps); }

std::array<double, 9> product(const std::array<double, 9>& a, const std::array<double, 9>& b) {
    std::array<double, 9> result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) result[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return result;
}
std::array<double, 9> transposed(const std::array<double, 9>& a) {
    return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}

BodyFrame frame_of(const Collider& body) {
    const MassProperties whole = *mass_properties(body.shape);
    if (body.inertia) return {*body.inertia, whole.center};
    const double density = *body.mass / whole.volume;
    if (!special(body.shape).mesh)
        return {{density * whole.inertia[0], density * whole.inertia[4], density * whole.inertia[8]}, whole.center};
    const PrincipalAxes own = principal_axes(whole.inertia);
    return {times(density, own.moments), rotate(transposed(own.axes), whole.center), own.axes};
}

/// Returns a mesh that is solid and keeps its form; null for all else.
const MeshShape* solid_mesh(const Collider& collider) {
    const Mesh* const mesh = special(collider.shape).mesh;
    return mesh && mesh->shape && mesh->shape->shell() == 0 && !collider.deforms() ? mesh->shape.get() : nullptr;
}

void add_hull_points(const SceneDescription& scene, MemberBodies& all) {
    const auto add = [&all](const Collider& collider) {
        const MeshShape* const mesh = solid_mesh(collider);
        const std::vector<Vec3> points = mesh ? hull_points(*mesh) : std::vector<Vec3>();
        for (const Vec3& point : points) all.hull_points.push_back(texel(point, 0));
        all.hull_counts.push_back(points.size());
    };
    for (const Body& body : all.bodies) add(body.collider);
    for (const std::size_t number : all.obstacles) add(scene.colliders[number]);
}

Vec3 vector_at(std::span<const float> row, int texel) {
    const auto* const first = &row[4 * static_cast<std::size_t>(texel)];
    return {double{first[0]}, double{first[1]}, double{first[2]}};
}

}  // namespace

MemberBodies bodies_of(const SceneDescription& scene, std::size_t list_count) {
    MemberBodies all{.gravity = gravity_at(scene, 0), .list_count = list_count};
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        const Collider& each = scene.colliders[k];
        all.meet =
            all.meet || (each.mass ? !all.bodies.empty() || special(each.shape).mesh : !special(each.shape).plane);
        if (each.mass)
            all.bodies.push_back({k, each, frame_of(each), light_cover(scene, each)});
        else
            all.obstacles.push_back(k);
    }
    all.meet = all.meet && !all.bodies.empty();
    if (!all.meet) all.obstacles.clear();
    all.obstacles_move =
        std::ranges::any_of(all.obstacles, [&](std::size_t number) { return scene.colliders[number].moves(); });
    if (all.meet) add_hull_points(scene, all);
    return all;
}

std::size_t body_count(const SimulationModel& model) { return model.bodies.front().bodies.size(); }

std::size_t obstacle_count(const SimulationModel& model) { return model.bodies.front().obstacles.size(); }
bool bodies_meet(const SimulationModel& model) { return model.bodies.front().meet; }
bool boxes_meet(const SimulationModel& model) {
    const MemberBodies& own = model.bodies.front();
    const auto bodies = std::ranges::count_if(
        own.bodies, [](const Body& body) { return std::holds_alternative<Box>(body.collider.shape); });
    const auto obstacles = std::ranges::count_if(own.obstacles, [&](std::size_t number) {
        return std::holds_alternative<Box>(model.scene.colliders[number].shape);
    });
    return own.meet && bodies > 0 && bodies + obstacles > 1;
}
bool obstacles_move(const SimulationModel& model) {
    return std::ranges::any_of(model.bodies, &MemberBodies::obstacles_move);
}
bool has_light_bodies(const SimulationModel& model) {
    return std::ranges::any_of(model.bodies, [](const MemberBodies& own) {
        return std::ranges::any_of(own.bodies, [](const Body& body) { return body.cover > 0; });
    });
}

bool has_bodies(const SimulationModel& model, std::size_t cloth) {
    return body_count(model) > 0 && cloth % (model.cloths.size() / model.member_count) == 0;
}

std::vector<glsl::BodyConstants> body_constants(const SimulationModel& model, std::size_t member) {
    std::vector<glsl::BodyConstants> all;
    const MemberBodies& own = model.bodies[member];
    std::size_t points = 0;
    const auto add = [&](const Collider& collider, std::size_t number, const glsl::vec4& inverse, double reach,
                         const BodyFrame& frame, double cover = 0) {
        const std::size_t count = own.meet ? own.hull_counts[all.size()] : 0;
        const glsl::vec4 axes = frame.axes ? texel(quaternion_of(transposed(*frame.axes))) : glsl::vec4{0, 0, 0, 1};
        all.push_back({inverse,
                       texel(frame.center, std::sqrt(collider.friction)),
                       texel(shape_geometry(collider.shape).size, reach),
                       axes,
                       // A sphere's shell has two thirds of its mass times its radius squared.
                       texel({cover, 2.0 / 3 * cover * reach * reach, 0, 0}),
                       {collider.kind(), static_cast<int>(number), static_cast<int>(points), static_cast<int>(count)}});
        points += count;
    };
    for (const auto& [number, body, frame, cover, acts] : own.bodies) {
        double reach = 0;  // of what contact keeps cloth from, too
        for (std::size_t list = 0; list < own.list_count; ++list)
            reach = std::max(reach,
                             shape_geometry(model.kept_colliders[own.first_list + list][number].collider.shape).reach);
        const Vec3& inertia = frame.moments;
        add(body, number, texel({1 / inertia[0], 1 / inertia[1], 1 / inertia[2], 1 / *body.mass}), reach, frame, cover);
    }
    for (const std::size_t number : own.obstacles) {
        const Collider& obstacle = model.scene.colliders[number];
        const double reach = shape_geometry(obstacle.shape).reach;
        add(obstacle, number, {0, 0, 0, 0}, std::isfinite(reach) ? reach : 1e15, {});
    }
    return all;
}

std::vector<glsl::vec4> bodies_at_start(const SimulationModel& model, std::size_t member) {
    std::vector<glsl::vec4> all;
    const double h = substep_length(model);
    const MemberBodies& own = model.bodies[member];
    for (const auto& [number, body, frame, cover, acts] : own.bodies) {
        ColliderPose pose = collider_pose(body, 0);
        if (frame.axes) pose.rotation = product(pose.rotation, *frame.axes);
        const Vec3 middle = plus(pose.center, rotate(pose.rotation, frame.center));
        const Vec3& inertia = frame.moments;
        // Velocities are those in the middle of substeps (docs/physics.md 11).
        const Vec3 velocity = plus(body.velocity, times(-0.5 * h, own.gravity));
        Vec3 spin{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vec3 along{pose.rotation[axis], pose.rotation[3 + axis], pose.rotation[6 + axis]};
            spin = plus(spin, times(inertia[axis] * dot(along, body.angular_velocity), along));
        }
        std::vector<glsl::vec4> state(glsl::body_texels);
        state[glsl::body_position] = texel(middle, 0);
        for (std::size_t k = 0; k < 3; ++k)
            component(state[glsl::body_remainder], k) =
                static_cast<float>(middle[k] - double{component(state[glsl::body_position], k)});
        state[glsl::body_turn] = texel(quaternion_of(pose.rotation));
        state[glsl::body_velocity] = state[glsl::body_last_velocity] = texel(velocity, 0);
        state[glsl::body_spin] = texel(spin, 0);
        state[glsl::body_last_spin] = texel(spin, h);
        all.insert(all.end(), state.begin(), state.end());
    }
    return all;
}

double most_given(const Body& body, double seconds) {
    const BodyActions& acts = body.acts;
    const double reach = shape_geometry(body.collider.shape).reach, least = std::ranges::min(body.frame.moments);
    const double push = length(acts.impulse) + seconds * length(acts.force);
    const double twist = length(acts.twist) + seconds * length(acts.moment);
    const double set = acts.sets ? length(acts.velocity) + reach * length(acts.turning) : 0;
    return set + push / *body.collider.mass + reach * twist / least;
}

std::vector<glsl::BodyAction> body_actions(const SimulationModel& model) {
    std::vector<glsl::BodyAction> all;
    for (const Body& body : model.bodies.front().bodies) {
        const BodyActions& acts = body.acts;
        all.push_back({texel(acts.force, acts.sets ? 1 : 0), texel(acts.moment, 0), texel(acts.impulse, 0),
                       texel(acts.twist, 0), texel(acts.velocity, 0), texel(acts.turning, 0)});
    }
    return all;
}

glsl::BodyMovePush body_move_push(const SimulationModel& model, std::size_t member, std::uint32_t substep) {
    const MemberBodies& own = model.bodies[member];
    const std::size_t records = model.scene.colliders.size();
    const std::size_t weather = first_weather(model, member, substep) + 1;
    return {texel(own.gravity, substep_length(model)),
            static_cast<int>(own.bodies.size()),
            static_cast<int>(records * (model.kept_colliders.size() * substep + own.first_list)),
            static_cast<int>(own.list_count),
            static_cast<int>(records),
            static_cast<int>(kind_ends(model.scene.colliders)[glsl::kind_plane]),
            model.weighs ? static_cast<int>(weather) : 0,
            static_cast<float>(recovery_speed * substep_length(model)),
            static_cast<int>(member * own.bodies.size()),
            substep == 0 ? 1 : 0,
            static_cast<int>(own.obstacles.size()),
            0,
            0};
}

glsl::BodyStrikePush body_strike_push(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep) {
    const double unit = cloth.inner_mass / cloth.substep_length / double{impulse_units(model)};
    return {static_cast<int>(body_count(model)), substep == 0 ? 1 : 0,
            static_cast<float>(unit / damping_mean(cloth.damping, cloth.substep_length)), 0};
}

std::vector<BodyState> body_states(const SimulationModel& model, std::span<const float> state, std::uint32_t frame) {
    std::vector<BodyState> all;
    const MemberBodies& own = model.bodies.front();
    const double time = frame / model.scene.time.fps;
    for (std::size_t k = 0; k < own.bodies.size(); ++k) {
        const auto& [number, body, own_frame, cover, acts] = own.bodies[k];
        const std::size_t length = std::size_t{4} * glsl::body_texels;
        const std::span<const float> row = state.subspan(k * length, length);
        const double h = double{row[std::size_t{4} * glsl::body_last_spin + 3]};
        const Vec3 half_fall = times(0.5 * h, gravity_at(model.scene, time));
        BodyState now{.collider = number};
        const float* const turn = &row[std::size_t{4} * glsl::body_turn];
        now.turn = {double{turn[0]}, double{turn[1]}, double{turn[2]}, double{turn[3]}};
        const std::array<double, 9> rotation = rotation_of(now.turn);
        const Vec3 middle = plus(vector_at(row, glsl::body_position), vector_at(row, glsl::body_remainder));
        now.position = minus(middle, rotate(rotation, own_frame.center));
        if (own_frame.axes) now.turn = quaternion_of(product(rotation, transposed(*own_frame.axes)));
        const auto mean = [&](int last, int next) {
            return times(0.5, plus(vector_at(row, last), vector_at(row, next)));
        };
        // Halfway between the motion of the last substep and that of the next one.
        now.velocity = mean(glsl::body_last_velocity, glsl::body_velocity);
        const bool lies = row[std::size_t{4} * glsl::body_last_velocity + 3] != 0;  // on a plane, which holds it next
        if (!lies) now.velocity = plus(now.velocity, plus(half_fall, times(0.5 * h / *body.mass, acts.force)));
        const Vec3 carried = times(*body.mass, now.velocity);
        now.momentum = cover > 0 ? plus(carried, vector_at(row, glsl::body_owed)) : carried;
        const Vec3 spin = plus(mean(glsl::body_last_spin, glsl::body_spin), times(lies ? 0 : 0.5 * h, acts.moment));
        const Vec3 turning = cover > 0 ? plus(spin, vector_at(row, glsl::body_owed_spin)) : spin;
        now.angular_momentum = plus(turning, cross(middle, now.momentum));
        const Vec3& inertia = own_frame.moments;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vec3 along{rotation[axis], rotation[3 + axis], rotation[6 + axis]};
            now.angular_velocity = plus(now.angular_velocity, times(dot(along, spin) / inertia[axis], along));
        }
        now.kinetic_energy = 0.5 * (dot(carried, now.velocity) + dot(spin, now.angular_velocity));
        now.potential_energy = -*body.mass * dot(gravity_at(model.scene, time), middle);
        all.push_back(now);
    }
    return all;
}

}  // namespace drape
