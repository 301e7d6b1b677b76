#include "cloth/bodies.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/forces.h"
#include "cloth/frame_inputs.h"
#include "cloth/method.h"
#include "cloth/simulation_model.h"
#include "cloth/texels.h"
#include "world/body_pose.h"
#include "world/collider_pose.h"
#include "world/mass_properties.h"
#include "world/overlap.h"
#include "world/weather.h"

namespace drape {

namespace {

double substep_length(const SimulationModel& model) { return 1 / (model.scene.time.fps * model.scene.solver.substeps); }

/// Returns the principal moments, kg m^2, along the shape's axes.
Vec3 inertia_of(const Collider& body) {
    if (body.inertia) return *body.inertia;
    const MassProperties whole = *mass_properties(body.shape);
    const double density = *body.mass / whole.volume;
    return {density * whole.inertia[0], density * whole.inertia[4], density * whole.inertia[8]};
}

Vec3 vector_at(std::span<const float> row, int texel) {
    const auto* const first = &row[4 * static_cast<std::size_t>(texel)];
    return {double{first[0]}, double{first[1]}, double{first[2]}};
}

}  // namespace

MemberBodies bodies_of(const SceneDescription& scene, std::size_t list_count) {
    MemberBodies all{{}, gravity_at(scene, 0), 0, list_count};
    for (std::size_t k = 0; k < scene.colliders.size(); ++k)
        if (scene.colliders[k].mass) all.bodies.push_back({k, scene.colliders[k]});
    return all;
}

std::size_t body_count(const SimulationModel& model) { return model.bodies.front().bodies.size(); }

bool has_bodies(const SimulationModel& model, std::size_t cloth) {
    return body_count(model) > 0 && cloth % (model.cloths.size() / model.member_count) == 0;
}

std::vector<glsl::BodyConstants> body_constants(const SimulationModel& model, std::size_t member) {
    std::vector<glsl::BodyConstants> all;
    const MemberBodies& own = model.bodies[member];
    for (const auto& [number, body, acts] : own.bodies) {
        const Vec3 inertia = inertia_of(body);
        double reach = 0;  // of what contact keeps cloth from, too
        for (std::size_t list = 0; list < own.list_count; ++list)
            reach = std::max(reach,
                             shape_geometry(model.kept_colliders[own.first_list + list][number].collider.shape).reach);
        const Vec3 center = mass_properties(body.shape)->center;
        all.push_back({texel({1 / inertia[0], 1 / inertia[1], 1 / inertia[2], 1 / *body.mass}),
                       texel(center, std::sqrt(body.friction)),
                       texel(shape_geometry(body.shape).size, reach),
                       {body.kind(), static_cast<int>(number), 0, 0}});
    }
    return all;
}

std::vector<glsl::vec4> bodies_at_start(const SimulationModel& model, std::size_t member) {
    std::vector<glsl::vec4> all;
    const double h = substep_length(model);
    const MemberBodies& own = model.bodies[member];
    for (const auto& [number, body, acts] : own.bodies) {
        const ColliderPose pose = collider_pose(body, 0);
        const Vec3 middle = plus(pose.center, rotate(pose.rotation, mass_properties(body.shape)->center));
        const Vec3 inertia = inertia_of(body);
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
    const Vec3 inertia = inertia_of(body.collider);
    const double reach = shape_geometry(body.collider.shape).reach, least = std::ranges::min(inertia);
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
            0,
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
        const auto& [number, body, acts] = own.bodies[k];
        const std::size_t length = std::size_t{4} * glsl::body_texels;
        const std::span<const float> row = state.subspan(k * length, length);
        const double h = double{row[std::size_t{4} * glsl::body_last_spin + 3]};
        const Vec3 half_fall = times(0.5 * h, gravity_at(model.scene, time));
        BodyState now{.collider = number};
        const float* const turn = &row[std::size_t{4} * glsl::body_turn];
        now.turn = {double{turn[0]}, double{turn[1]}, double{turn[2]}, double{turn[3]}};
        const std::array<double, 9> rotation = rotation_of(now.turn);
        const Vec3 middle = plus(vector_at(row, glsl::body_position), vector_at(row, glsl::body_remainder));
        now.position = minus(middle, rotate(rotation, mass_properties(body.shape)->center));
        const auto mean = [&](int last, int next) {
            return times(0.5, plus(vector_at(row, last), vector_at(row, next)));
        };
        // Halfway between the motion of the last substep and that of the next one.
        now.velocity = mean(glsl::body_last_velocity, glsl::body_velocity);
        const bool lies = row[std::size_t{4} * glsl::body_last_velocity + 3] != 0;  // on a plane, which holds it next
        if (!lies) now.velocity = plus(now.velocity, plus(half_fall, times(0.5 * h / *body.mass, acts.force)));
        now.momentum = times(*body.mass, now.velocity);
        const Vec3 spin = plus(mean(glsl::body_last_spin, glsl::body_spin), times(lies ? 0 : 0.5 * h, acts.moment));
        now.angular_momentum = plus(spin, cross(middle, now.momentum));
        const Vec3 inertia = inertia_of(body);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vec3 along{rotation[axis], rotation[3 + axis], rotation[6 + axis]};
            now.angular_velocity = plus(now.angular_velocity, times(dot(along, spin) / inertia[axis], along));
        }
        now.kinetic_energy = 0.5 * (dot(now.momentum, now.velocity) + dot(spin, now.angular_velocity));
        now.potential_energy = -*body.mass * dot(gravity_at(model.scene, time), middle);
        all.push_back(now);
    }
    return all;
}

}  // namespace drape
