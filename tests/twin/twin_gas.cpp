// The twin of the passes that find the pressure of gas.
#include <algorithm>
#include <array>

#include "cloth/air.h"
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// Joins the records of all lanes as include/workgroup_reduction.h does.
template <class Record>
Record joined_lanes(std::array<Record, workgroup_width>& lanes) {
    for (std::size_t stride = workgroup_width / 2; stride > 0; stride /= 2)
        for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = joined(lanes[lane], lanes[lane + stride]);
    return lanes[0];
}

/// Returns where a particle is as a substep begins.
vec3 place_now(const TwinPlace& where, std::size_t particle) {
    const vec3 start = xyz(where.state[Field::position][particle]);
    const bool lags = where.step.substep > 0 && where.step.substep < where.scene.scene.solver.substeps;
    return lags ? start + xyz(where.state[Field::displacement][particle]) : start;
}

void run_gas_area(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<GasAreaPush>();
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const std::size_t particle = at(model.grid, {x, y});
            const vec3 own = place_now(where, particle);
            const auto edge = [&](int right, int down) {
                return place_now(where, at(model.grid, {std::clamp(x + right, 0, push.grid.x - 1),
                                                        std::clamp(y + down, 0, push.grid.y - 1)})) -
                       own;
            };
            const GasEdges edges{edge(-1, 0),  edge(1, 0),  edge(0, -1), edge(0, 1),
                                 edge(-1, -1), edge(1, -1), edge(-1, 1), edge(1, 1)};
            const uint air = state.topology.masked() ? air_of(state.topology, x, y) : border_air({x, y}, push.grid);
            state[Field::wind_force][particle] = texel(gas_turned(gas_area(edges, air), push.sign));
        }
}

void run_gas_sum(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<GasSumPush>();
    const std::size_t count = state[Field::position].size();
    const vec3 origin = place_now(where, static_cast<std::size_t>(push.origin));
    for (std::size_t group = 0; group * gas_particles < count; ++group) {
        std::array<GasSum, workgroup_width> lanes;
        lanes.fill(empty_gas_sum());
        const std::size_t begin = group * gas_particles;
        for (std::size_t i = begin; i < std::min(begin + gas_particles, count); ++i) {
            const vec3 moved = xyz(state[Field::displacement][i]);
            const vec3 inertia = model.scheme.second_order
                                     ? gas_inertia(moved, xyz(state[Field::displacement_before][i]),
                                                   xyz(state[Field::velocity_excess][i]))
                                     : moved;
            const bool touched = !scene.scene.colliders.empty() && state[Field::displacement_remainder][i].w != 0.0f;
            GasSum& lane = lanes[(i - begin) % workgroup_width];
            lane = joined(lane, gas_term(xyz(state[Field::wind_force][i]), model.gas->shares[i],
                                         state[Field::position][i].w == 0.0f, touched, place_now(where, i) - origin,
                                         moved, inertia));
        }
        GasSum sum = joined_lanes(lanes);
        sum.origin = texel(origin, sum.origin.w);
        (*state.gas_sums)[static_cast<std::size_t>(push.first) + group] = sum;
    }
}

bool next_is_bdf2(const TwinPlace& where, const GasPush& push) {
    if (!where.model.scheme.second_order) return false;
    const std::vector<uint>& texels = where.state.integers(Field::line_control);
    LineControl last{texels[control_order], texels[control_wrong_lines], texels[control_hold]};
    if (push.joint >= 0) {
        const glsl::uvec4 joint = (*where.state.sewn)[static_cast<std::size_t>(push.joint)].control;
        last = {joint.x, joint.y, joint.z};
    }
    return next_control(last, push.most_wrong).order == 2u;
}

void run_gas_pressure(const TwinPlace& where) {
    const auto& push = where.step.push<GasPush>();
    const GasSum* const sums = &(*where.state.gas_sums)[static_cast<std::size_t>(push.first)];
    std::array<GasSum, workgroup_width> lanes;
    lanes.fill(empty_gas_sum());
    for (std::size_t i = 0; i < static_cast<std::size_t>(push.count); ++i)
        lanes[i % workgroup_width] = joined(lanes[i % workgroup_width], gas_seen(sums[i], xyz(sums[0].origin)));
    std::vector<vec4>& texels = where.state[Field::gas];
    const float amount = push.ends == 0 ? where.inputs.wind[static_cast<std::size_t>(push.weather)].x : 0.0f;
    const GasState next =
        gas_next(joined_lanes(lanes), {texels[0], texels[1]}, amount, next_is_bdf2(where, push), push);
    texels = {next.now, next.kept};
}

}  // namespace

std::vector<TwinRow> twin_gas_rows() {
    return {{StepKind::gas_area, run_gas_area},
            {StepKind::gas_sum, run_gas_sum},
            {StepKind::gas_pressure, run_gas_pressure}};
}

}  // namespace drape
