// The twin decides whether another iteration follows, from the same records in the same order as the device.
#include <array>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

using Workgroup = std::array<ResidualRecord, workgroup_width>;

ResidualRecord joined_over_workgroup(Workgroup& lanes) {
    for (std::size_t stride = workgroup_width / 2; stride > 0; stride /= 2)
        for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = joined(lanes[lane], lanes[lane + stride]);
    return lanes[0];
}

ResidualRecord with_spring(const ResidualRecord& record, const ClothModel& model, const TwinCloth& state, ivec2 first,
                           int channel) {
    const ivec2 offset = spring_directions[static_cast<std::size_t>(channel)].offset;
    const ivec2 second{first.x + offset.x, first.y + offset.y};
    if (second.x >= model.residual.grid.x || second.y >= model.residual.grid.y) return record;
    const std::size_t a = at(model.grid, first), b = at(model.grid, second);
    const vec3 edge = spring_edge(xyz(state[Field::position][a]), xyz(state[Field::position][b]),
                                  xyz(state[Field::displacement][a]), xyz(state[Field::displacement][b]));
    const float flat = channel == 0 ? model.residual.rest_length.x : model.residual.rest_length.y;
    return add_residual(record, edge, model.rest_length(flat, a, channel),
                        state.topology.masked() ? component(state.topology.spring_shares()[a], channel) : 1.0f,
                        model.residual.compression, state.tension(static_cast<std::size_t>(channel))[a]);
}

ResidualRecord strip(const ClothModel& model, const TwinCloth& state, ivec2 first) {
    ResidualRecord record = empty_residual();
    for (int y = first.y; y < first.y + residual_rows && y < model.residual.grid.y; ++y)
        for (int channel = 0; channel < 2; ++channel) record = with_spring(record, model, state, {first.x, y}, channel);
    return record;
}

ResidualRecord residual(const ClothModel& model, const TwinCloth& state) {
    const ivec2 grid = model.residual.grid;
    std::vector<ResidualRecord> partials;
    for (int y = 0; y < grid.y; y += residual_rows)
        for (int x = 0; x < grid.x; x += workgroup_width) {
            Workgroup lanes;
            lanes.fill(empty_residual());
            for (int lane = 0; lane < workgroup_width && x + lane < grid.x; ++lane)
                lanes[static_cast<std::size_t>(lane)] = strip(model, state, {x + lane, y});
            partials.push_back(joined_over_workgroup(lanes));
        }
    Workgroup lanes;
    lanes.fill(empty_residual());
    for (std::size_t i = 0; i < partials.size(); ++i)
        lanes[i % workgroup_width] = joined(lanes[i % workgroup_width], partials[i]);
    return joined_over_workgroup(lanes);
}

void run_residual(const TwinPlace& where) { where.state.residual = drape::residual(where.model, where.state); }

void run_decide(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    if (step.substep == 0 && step.iteration == 0) state.iteration_count = scene.scene.solver.substeps;
    state.iterates = needs_iteration(state.residual, scene.iteration_limit());
    if (state.iterates) ++state.iteration_count;
}

}  // namespace

std::vector<TwinRow> twin_check_rows() { return {{StepKind::residual, run_residual}, {StepKind::decide, run_decide}}; }

}  // namespace drape
