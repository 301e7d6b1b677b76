// These passes of the twin are between a cloth's fields and the sheet on which contact sees all cloths.
#include <algorithm>
#include <utility>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

vec3 summed(const TwinSums& sums, std::size_t which, float largest) {
    const auto number = [](std::int64_t units) {
        const auto bits = static_cast<std::uint64_t>(units);
        return self_number({static_cast<uint>(bits), static_cast<uint>(bits >> 32)});
    };
    const auto& sum = sums.units[which];
    return self_impulse_of({number(sum[0]), number(sum[1]), number(sum[2])}, largest);
}

TwinContact::TwinContact(const SelfContact& contact)
    : model(&contact),
      owners(contact.owners()),
      positions(owners.size()),
      displacements(owners.size()),
      last_motions(owners.size()),
      supports(owners.size()),
      before(owners.size()) {}

std::size_t place_on_sheet(const SelfClothPush& push, std::size_t particle) {
    const auto columns = static_cast<std::size_t>(push.grid.x);
    const std::size_t column = particle % columns, row = particle / columns;
    return (static_cast<std::size_t>(push.first.y) + row) * static_cast<std::size_t>(push.sheet.x) +
           static_cast<std::size_t>(push.first.x) + column;
}

namespace {

/// Begins a substep's contact, when all cloths are on the sheet.
void begin_contact(TwinContact& contact, const SelfClothPush& push) {
    SelfRecord& record = contact.record;
    if (push.begins_frame != 0) record = {};
    std::vector<vec3> samples;
    for (const SelfCloth& cloth : contact.model->cloths)
        for (int k = 0; push.held == 0 && k < self_cloth_samples; ++k) {
            const ivec2 sample = self_sample(cloth.grid, k);
            const int place = (cloth.first.y + sample.y) * push.sheet.x + cloth.first.x + sample.x;
            samples.push_back(xyz(contact.displacements[static_cast<std::size_t>(place)]));
        }
    vec3 sum{};
    for (const vec3& sample : samples) sum = sum + sample;
    const vec3 mean = self_mean(sum, push.cloth_count);
    float least = 1;
    for (const vec3& sample : samples) least = self_least(least, self_part_made(sample, mean));
    record.carried = texel(self_common_motion(mean, least));
    record.point_count = record.edge_count = 0;
    record.touching_point_count = record.touching_edge_count = 0;
    record.cell_count = 0;
}

/// Returns bits of a cell's triangles that meet nothing, for their seams' sake.
std::uint32_t left_out(const SelfSewn& sewn, const SelfClothPush& push, const FrameInputs& inputs) {
    std::uint32_t bits = sewn.left_out & 3u;
    const std::size_t opening = static_cast<std::size_t>(push.opening) + (sewn.left_out >> 4);
    if (!inputs.openings.empty() && inputs.openings[opening].left.y != 0.0f) bits |= (sewn.left_out >> 2) & 3u;
    return bits;
}

void run_self_gather(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SelfClothPush>();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const ivec2 own{static_cast<int>(i) % push.grid.x, static_cast<int>(i) / push.grid.x};
        std::uint32_t triangles = cell_inside(own, push.grid) ? state.topology.grid().cell(own.x, own.y) : 0u;
        const std::size_t place = place_on_sheet(push, i);
        vec4& laid = meeting->positions[place];
        laid = state[Field::position][i];
        if (meeting->model->is_sewn()) {
            const SelfSewn& sewn = meeting->model->sewn[place];
            if (laid.w > 0.0f && sewn.inverse_mass > 0.0f) laid.w = sewn.inverse_mass;
            triangles &= ~left_out(sewn, push, inputs);
        }
        meeting->displacements[place] = texel(xyz(state[Field::displacement][i]), static_cast<float>(triangles));
        if (step.last) {
            vec4& before = where.before()[i];
            if (step.substep > 0 && !state[Field::paid].empty() && state[Field::position][i].w > 0.0f)
                before = texel(without_advance(xyz(before), xyz(state[Field::paid][paid_turn]),
                                               xyz(state[Field::paid][paid_turn + 1]), xyz(state[Field::position][i])),
                               before.w);
            meeting->last_motions[place] = before;
        }
        if (!state[Field::support].empty())
            meeting->supports[place] = {std::exchange(state[Field::support][i], vec4{}), state[Field::support_grip][i]};
    }
    if (push.cloth_count > 0) begin_contact(*meeting, push);
}

void run_self_return(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<SelfClothPush>();
    cut_short(*meeting, step.cloth);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const std::size_t place = place_on_sheet(push, i);
        const vec3 normal = support_normal(meeting->supports[place]);
        const bool ends_lying = step.last && state[Field::position][i].w > 0.0f &&
                                (normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f);
        if (ends_lying) where.before()[i] = texel(xyz(state[Field::displacement][i]));
        if (meeting->before[place].w == 0.0f) continue;
        const vec3 velocity = xyz(meeting->velocities[place]);
        vec4& start = state[Field::position][i];
        start = texel(self_start(xyz(start), xyz(meeting->displacements[place]), velocity), start.w);
        state.move_to(i, velocity);
        if (ends_lying || (step.last && meeting->before[place].w == self_pushed))
            where.before()[i] = texel(xyz(meeting->last_motions[place]));
        if (!model.scheme.second_order) continue;
        uint& hold = state.integers(Field::line_control)[control_hold];
        hold = std::max(hold, line_hold_contact);
    }
}

}  // namespace

std::vector<TwinRow> twin_sheet_rows() {
    return {{StepKind::self_gather, run_self_gather}, {StepKind::self_return, run_self_return}};
}

}  // namespace drape
