#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "solver/cloth_constants.h"
#include "solver/step_row.h"

namespace drape {

namespace {

graph::PushConstants push_of(const StepConstants& constants) {
    return std::visit(
        []<class Push>(const Push& push) {
            if constexpr (std::is_same_v<Push, std::monostate>)
                return graph::PushConstants();
            else
                return graph::PushConstants(push);
        },
        constants);
}

graph::PushConstants push_of(const StepRow& row, const StepPlace& place) {
    return row.push ? row.push(place) : push_of(place.step.constants);
}

/// Returns what each of the cloths that take a step together is pushed in the frame's first substep.
std::vector<graph::PushConstants> pushes_of_each(const StepRow& row, const StepPlace& place) {
    if (!place.cloth || place.cloth->count() == 1) return {};
    ClothState cloth = *place.cloth;
    Step step = place.step;
    step.substep = step.iteration = 0;
    std::size_t own = 0;
    return pushes_of(*place.cloth, place.model, [&](const ClothModel& model) {
        cloth.model = &model;
        if (!place.step.own.empty()) step.constants = place.step.own[own++];
        return push_of(row, {step, &cloth, place.contact, place.model, place.device});
    });
}

graph::PassName name_of(const StepRow& row, const StepPlace& place) {
    const std::string label = row.label(place);
    if (place.cloth) return place.cloth->step_name(label, place.step);
    return {fmt::format("{} (substep {})", label, place.step.substep), "simulate", label};
}

/// In iterations that the device may skip, the dispatch has the size that the decision before it wrote.
DispatchSize size_of(const KernelRow& kernel, const StepPlace& place, const vulkan::ComputePipeline& pipeline) {
    DispatchSize size = kernel.size(place, pipeline);
    if (!place.step.conditional) return size;
    const auto [x, y, z] = pipeline.local_size();
    size.sizes = (*place.cloth)[Field::iterations];
    size.slot = size_slot(*place.cloth->iteration_sizes, {(size.width + x - 1) / x, (size.height + y - 1) / y, 1, 0},
                          glsl::iteration_size_count);
    return size;
}

void turn(ClothState& cloth, Turn turned) {
    if (turned == Turn::state) cloth.turn();
    if (turned == Turn::displacement) cloth.turn_displacement();
}

/// Returns the image that holds the line method's control for a step. A prediction reads that of the substep before,
/// which earlier steps of its substep take too, and writes the other; a frame begins and ends with it at home.
Field control_of(const Step& step, bool written) {
    const bool ends_frame = step.kind == StepKind::advance;
    if (ends_frame && written) return Field::line_control;
    const bool joins_orders =
        step.kind == StepKind::seam_give && step.push<glsl::SeamPush>().stage == glsl::seam_orders;
    const bool is_before = ends_frame || step.kind == StepKind::release || step.kind == StepKind::gas_pressure ||
                           joins_orders || (step.kind == StepKind::predict && !written);
    return (step.substep + (is_before ? 0 : 1)) % 2 == 0 ? Field::line_control : Field::line_control_spare;
}

/// Names of resources that a step takes for others: the spare images where it writes those, and the row's own.
std::string alias_of(const StepRow& row, const StepPlace& place, Turn turned, std::string_view name, bool written) {
    if (row.alias)
        if (std::string other = row.alias(place, name, written); !other.empty()) return other;
    if (name == row_of(Field::line_control).variable()) return row_of(control_of(place.step, written)).variable();
    for (const auto& [field, spare] : spare_fields)
        if (written && name == row_of(field).variable() &&
            (turned == Turn::state || (turned == Turn::displacement && field == Field::displacement)))
            return row_of(spare).variable();
    return std::string(name);
}

}  // namespace

void add_step_pass(graph::Graph& graph, Pipelines& pipelines, ClothState* cloth, ContactHandles* contact,
                   SceneInputs& inputs, const SimulationModel& model, const Step& step, ClothState* bearer) {
    const StepRow& row = step_rows()[static_cast<std::size_t>(step.kind)];
    const auto kernel = std::ranges::find(row.kernels, step.kernel, &KernelRow::kernel);
    if (kernel == row.kernels.end()) throw std::logic_error("a step has a kernel that its row has not");
    const StepPlace place{step, cloth, contact, model, pipelines};
    const std::string module(kernel->shader);
    const std::vector<graph::PushConstants> each = pushes_of_each(row, place);
    graph::Handle own = each.empty() ? graph::Handle() : own_constants(graph, *cloth, module, module, each);
    const auto value = [&](std::string_view name) { return step_constant(place, name); };
    const vulkan::ComputePipeline& pipeline = pipelines.get(module, value, own.valid());
    const Turn turned = row.turn ? row.turn(place) : Turn::nothing;
    PassResources resources{cloth,
                            contact,
                            inputs,
                            {{"constants", &own},
                             {"sewn_places", &inputs.sewn_places},
                             {"openings", &inputs.openings},
                             {"gas_sums", &inputs.gas_sums}}};
    if (bearer) {
        resources.own.emplace_back("bodies", &(*bearer)[Field::bodies]);
        resources.own.emplace_back("body_constants", &(*bearer)[Field::body_constants]);
        resources.own.emplace_back("body_meetings", &(*bearer)[Field::body_meetings]);
        resources.own.emplace_back("met_bodies", &(*bearer)[Field::met_bodies]);
        resources.own.emplace_back("hull_points", &(*bearer)[Field::hull_points]);
        resources.own.emplace_back("colliders", &inputs.colliders);
        resources.own.emplace_back("body_actions", &inputs.body_actions);
    }
    resources.alias = [&](std::string_view name, bool written) { return alias_of(row, place, turned, name, written); };
    add_compute_pass(graph, name_of(row, place), pipeline, push_of(row, place), size_of(*kernel, place, pipeline),
                     std::move(resources));
    if (cloth) turn(*cloth, turned);
}

}  // namespace drape
