#include "solver/cloth_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "cloth/frame_steps.h"
#include "cloth/kernel_steps.h"
#include "cloth/spring_tension.h"
#include "cloth/step_flops.h"
#include "cloth/together.h"
#include "solver/compute_pass.h"
#include "solver/contact_readback.h"
#include "solver/cut_pass.h"
#include "solver/form_pass.h"
#include "solver/host_inputs.h"
#include "solver/position_upload.h"
#include "solver/readback_pass.h"
#include "solver/statistics_pass.h"
#include "solver/step_row.h"
#include "solver/tear_pass.h"
#include "vulkan/api.h"

namespace drape {

using graph::Lifetime;

namespace {

Lifetime lifetime_of(FieldLife life, bool inspection = false) {
    switch (life) {
        case FieldLife::frame:
            return inspection ? Lifetime::persistent : Lifetime::transient;
        case FieldLife::constant:
            return Lifetime::constant;
        case FieldLife::input:
            return Lifetime::host_input;
        case FieldLife::state:
        case FieldLife::device:
            break;
    }
    return Lifetime::persistent;
}

Lifetime lifetime_of(const FieldRow& row, const FieldContext& about) {
    if (row.rewritten && row.rewritten(about)) return Lifetime::persistent;
    return lifetime_of(row.life, about.needs.inspection);
}
Lifetime lifetime_of(const ContactRow& row, const ContactContext&) { return lifetime_of(row.life); }

template <class Row>
VkFormat format_of(const Row& row) {
    if (&row.element == &glsl::layout_of<glsl::vec4>()) return VK_FORMAT_R32G32B32A32_SFLOAT;
    return &row.element == &glsl::layout_of<float>() ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32_UINT;
}

/// `slices`: the names of the cloths whose fields lie below each other in one image; none: the field is one resource.
template <class Row, class Context>
graph::Handle declare_row(graph::Graph& graph, const std::string& name, const Row& row, const Context& about,
                          bool buffered, const std::vector<std::string>& slices = {}) {
    const FieldExtent extent = row.extent(about);
    if (!row.is_image())
        return graph.buffer({name, extent.count() * row.element.size, lifetime_of(row, about), &row.element,
                             row.view == FieldView::texel_buffer});
    const std::uint64_t height = extent.height * std::max<std::size_t>(slices.size(), 1);
    return graph.image({name, format_of(row), static_cast<std::uint32_t>(extent.width),
                        static_cast<std::uint32_t>(height), VK_SAMPLE_COUNT_1_BIT, lifetime_of(row, about),
                        buffered && row.view == FieldView::image_and_buffer, slices});
}

/// Lists that cloths together have one after the other in one buffer.
constexpr Field joined_lists[] = {Field::nested_boxes, Field::tethers, Field::skin, Field::pinned_particles,
                                  Field::pin_motions};

/// Declares the lists of cloths together, joined.
void declare_lists(graph::Graph& graph, const ClothLayout& layout, const SimulationModel& run, const FrameNeeds& needs,
                   ClothState& whole) {
    for (const Field field : joined_lists) {
        const FieldRow& row = row_of(field);
        std::uint64_t count = 0;
        for (const std::size_t cloth : whole.cloths)
            if (const FieldContext about = layout.context(cloth, needs, run); row.needed(about))
                count += row.extent(about).count();
        if (count == 0) continue;
        whole[field] = graph.buffer({resource_name(whole.name, row), count * row.element.size,
                                     row.life == FieldLife::constant ? Lifetime::constant : Lifetime::host_input,
                                     &row.element, row.view == FieldView::texel_buffer});
    }
}

/// Adds a copy of the colliders as the host gives them, in which passes move bodies.
graph::Handle add_copy_of_colliders(graph::Graph& graph, graph::Handle given) {
    graph::BufferDeclaration copied = graph.resources()[given.resource].buffer;
    copied.name = "moved colliders";
    copied.lifetime = Lifetime::transient;
    const auto copy = std::make_shared<graph::Handle>(graph.buffer(copied));
    graph.add_pass(
        {"copy of colliders", "simulate", "copy of colliders"},
        [&](graph::PassSetup& setup) {
            setup.read(given, graph::Access::transfer_read);
            *copy = setup.write(*copy, graph::Access::transfer_write);
        },
        [given, copy, size = copied.byte_count](graph::PassContext& context) {
            const VkBufferCopy region{0, 0, size};
            vkCmdCopyBuffer(context.commands(), context.buffer(given).handle(), context.buffer(*copy).handle(), 1,
                            &region);
        });
    return *copy;
}

/// Declares what says which of them are present.
void declare_present(graph::Graph& graph, const Together& together, ClothState& whole) {
    whole.sizes_of_present = together.sizes_of_present;
    whole.present =
        graph.buffer<glsl::uint>(present_name(whole.name), 2 * together.cloths.size(), Lifetime::host_input);
    whole.present_sizes =
        graph.buffer<glsl::uvec4>(present_sizes_name(whole.name), most_present_sizes, Lifetime::host_input);
}

}  // namespace

ClothSolver::ClothSolver(const vulkan::Device& device, const SimulationModel& model, const Kernels& kernels,
                         bool in_part)
    : model_(model),
      run_(&model),
      in_part_(in_part),
      verdicts_(kernel_verdicts(device, model, kernels)),
      layout_(device, model, kernels),
      pipelines_(device, in_part) {}

void ClothSolver::declare(graph::Graph& graph, const FrameNeeds& needs, const SimulationModel& run, StateSet set) {
    cloths_.clear();
    together_.clear();
    run_ = &run;
    set_ = set;
    for (const SkippedWork& work : run.skipped()) graph.skip(work.what, work.reason);
    for (const Compromise& each : run.compromises()) graph.compromise(each.what, each.reason);
    declare_inputs(graph);
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) declare_cloth(graph, index, needs);
    for (Together& together : layout_.together) declare_together(graph, together, needs);
    if (!run.self_contact) return;
    contact_.capacity = layout_.lists.capacity;
    contact_.buffered = layout_.kernels.has(Kernel::buffer_store);
    const ContactContext about{*run.self_contact, contact_.capacity};
    for (const ContactRow& row : contact_fields())
        if (row.needed(about))
            contact_[row.field] = declare_row(graph, resource_name(row, set_), row, about, contact_.buffered);
}

void ClothSolver::declare_inputs(graph::Graph& graph) {
    inputs_ = {};
    if (model_.windy)
        inputs_.wind = graph.buffer<glsl::vec4>(
            "wind", model_.member_count * model_.most_substeps() * weather_vectors(model_), Lifetime::host_input);
    if (std::ranges::any_of(model_.cloths, &ClothModel::stiffens))
        inputs_.stiffness = graph.buffer<float>("stiffness", model_.cloths.size(), Lifetime::host_input);
    if (model_.compares_states())
        inputs_.attempt = graph.buffer<glsl::SubstepChange>(attempt_name, model_.cloths.size(), Lifetime::host_input);
    if (const std::size_t count = collider_record_count(model_))
        inputs_.colliders = graph.buffer({.name = "colliders",
                                          .byte_count = count * sizeof(glsl::ColliderRecord),
                                          .lifetime = Lifetime::host_input,
                                          .element = &glsl::layout_of<glsl::ColliderRecord>(),
                                          .texels = true});
    if (model_.options.bodies)
        inputs_.body_actions = graph.buffer<glsl::BodyAction>(
            body_actions_name, model_.member_count * body_count(model_), Lifetime::host_input);
    if (body_count(model_) > 0) inputs_.colliders = add_copy_of_colliders(graph, inputs_.colliders);
    if (!model_.mesh_fields.empty())
        inputs_.mesh_fields =
            graph.buffer({.name = mesh_fields_name,
                          .byte_count = model_.mesh_fields.texels().size() * sizeof(glsl::vec4),
                          .lifetime = model_.mesh_fields.deform() ? Lifetime::persistent : Lifetime::constant,
                          .element = &glsl::layout_of<glsl::vec4>(),
                          .texels = true});
    if (model_.sewn_count > 0)
        inputs_.sewn_places = graph.buffer<glsl::SewnPlace>("sewn places", model_.sewn_count, Lifetime::persistent);
    if (model_.gas_sum_count > 0)
        inputs_.gas_sums = graph.buffer<glsl::GasSum>("gas sums", model_.gas_sum_count, Lifetime::persistent);
    if (!model_.closings.empty())
        inputs_.openings = graph.buffer<glsl::SeamOpening>("openings", model_.most_substeps() * model_.closings.size(),
                                                           Lifetime::host_input);
    declare_forms(graph, model_, inputs_);
}

ClothState ClothSolver::state_of(std::size_t cloth) const {
    ClothState state;
    state.model = &run_->cloths[cloth];
    state.topology = &layout_.topologies[cloth];
    state.buffered = layout_.kernels.has(Kernel::buffer_store);
    state.index_count = static_cast<std::uint32_t>(state.topology->indices().size());
    state.iteration_sizes = layout_.iteration_sizes[cloth];
    return state;
}

void ClothSolver::declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs) {
    const FieldContext about = layout_.context(index, needs, *run_);
    ClothState state = state_of(index);
    state.name = about.cloth.name;
    state.cloths = {index};
    state.pinned_count = about.cloth.pinned.size();
    state.pin_count = about.cloth.dynamic_pins.size();
    for (const FieldRow& row : cloth_fields())
        if (row.needed(about) && (layout_.is_alone(index) || !lies_together(row)))
            state[row.field] = declare_row(graph, resource_name(about.cloth, row, set_), row, about, state.buffered);
    cloths_.push_back(state);
}

void ClothSolver::declare_together(graph::Graph& graph, Together& together, const FrameNeeds& needs) {
    std::shared_ptr<ClothConstants>& constants = together.constants[run_->scene.solver.substeps];
    if (!constants) constants = std::make_shared<ClothConstants>();
    ClothState& whole = together_.emplace_back(state_of(together.cloths.front()));
    whole.name = together.name;
    whole.cloths = together.cloths;
    whole.unlike = together.unlike;
    whole.constants = constants;
    for (const std::size_t cloth : together.cloths) {
        whole.pinned_count += cloths_[cloth].pinned_count;
        whole.pin_count += cloths_[cloth].pin_count;
    }
    for (const FieldRow& row : cloth_fields()) {
        if (!lies_together(row)) continue;
        std::vector<std::string> slices;
        for (const std::size_t cloth : together.cloths)
            slices.push_back(resource_name(model_.cloths[cloth], row, set_));
        graph::Handle& image = whole[row.field];
        for (const std::size_t cloth : together.cloths) {
            const FieldContext about = layout_.context(cloth, needs, *run_);
            if (!row.needed(about)) continue;
            if (!image.valid())
                image = declare_row(graph, resource_name(whole.name, row, set_), row, about, whole.buffered, slices);
            cloths_[cloth][row.field] = {image.resource, image.version, layout_.place_of(cloth)};
        }
    }
    declare_lists(graph, layout_, *run_, needs, whole);
    if (in_part_) declare_present(graph, together, whole);
}

void ClothSolver::take(std::size_t cloth) {
    if (layout_.is_alone(cloth)) return;
    const ClothState& whole = together_[layout_.list_of(cloth)];
    const std::uint32_t place = layout_.place_of(cloth);
    ClothState& state = cloths_[cloth];
    state.away = whole.away;
    for (const FieldRow& row : cloth_fields()) {
        const graph::Handle image = whole[row.field];
        if (lies_together(row) && state[row.field].valid()) state[row.field] = {image.resource, image.version, place};
    }
}

void ClothSolver::give(std::size_t cloth) {
    if (layout_.is_alone(cloth)) return;
    ClothState& whole = together_[layout_.list_of(cloth)];
    const ClothState& state = cloths_[cloth];
    if (state.away != whole.away) throw std::logic_error("a cloth left those that it is together with");
    for (const FieldRow& row : cloth_fields())
        if (lies_together(row) && state[row.field].valid())
            whole[row.field] = {state[row.field].resource, state[row.field].version};
}

template <class Add>
void ClothSolver::for_each_dispatch(const Add& add) {
    for (ClothState& whole : together_) add(whole);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        if (layout_.is_alone(cloth)) add(cloths_[cloth]);
        take(cloth);
    }
}

template <class Add>
void ClothSolver::for_each_cloth(const Add& add) {
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        take(cloth);
        add(cloths_[cloth]);
        give(cloth);
    }
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) take(cloth);
}

void ClothSolver::add_cuts(graph::Graph& graph) {
    const std::size_t count = model_.scene.cutters.size();
    const graph::Handle cutters = declare_cutters(graph, count);
    for_each_cloth([&](ClothState& state) { add_cut(graph, pipelines_, state, cutters, count); });
}

void ClothSolver::add_tears(graph::Graph& graph) {
    for_each_cloth([&](ClothState& state) {
        if (!state.model->tear_limits.empty()) add_tear(graph, pipelines_, state);
    });
}

void ClothSolver::add_positions(graph::Graph& graph) {
    for_each_cloth([&](ClothState& state) { add_position_upload(graph, state); });
}

void ClothSolver::add_simulation(graph::Graph& graph) {
    for (const KernelVerdict& each : verdicts_)
        graph.choose(fmt::format("{} is {}used", name_of(each.kernel), each.is_used ? "" : "not "), each.reason);
    add_forms(graph);
    for (const Step& step : steps()) add_dispatches(graph, step);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) take(cloth);
    if (run_->self_contact) add_contact_readback(graph, contact_, *run_->self_contact);
}

void ClothSolver::add_forms(graph::Graph& graph) { drape::add_forms(graph, pipelines_, *run_, inputs_); }

void ClothSolver::add_step(graph::Graph& graph, const Step& step) {
    add_dispatches(graph, step);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) take(cloth);
}

void ClothSolver::add_dispatches(graph::Graph& graph, const Step& step) {
    if (step.is_of_bodies()) {
        add_step_of_bodies(graph, step);
    } else if (step.cloth == between_cloths) {
        add_step(graph, nullptr, step);
    } else if (step.together) {
        add_step(graph, &together_[layout_.list_of(step.cloth)], step);
    } else if (step.cloth != all_cloths) {
        take(step.cloth);
        add_step(graph, &cloths_[step.cloth], step);
        give(step.cloth);
    } else {
        for_each_dispatch([&](ClothState& state) { add_step(graph, &state, step); });
    }
}

void ClothSolver::add_step_of_bodies(graph::Graph& graph, const Step& step) {
    const std::size_t each = model_.cloths.size() / model_.member_count, bearer = step.cloth / each * each;
    take(step.cloth);
    take(bearer);
    add_step_pass(graph, pipelines_, &cloths_[step.cloth], nullptr, inputs_, *run_, step, &cloths_[bearer]);
    give_field(bearer, Field::bodies);
    give_field(step.cloth, Field::struck);
}

void ClothSolver::give_field(std::size_t cloth, Field field) {
    const graph::Handle own = cloths_[cloth][field];
    if (!layout_.is_alone(cloth) && own.valid()) together_[layout_.list_of(cloth)][field] = {own.resource, own.version};
}

std::vector<Step> ClothSolver::steps() const {
    const std::vector<Step> steps = kernel_steps(*run_, layout_.kernels);
    std::vector<std::vector<std::size_t>> lists;
    for (const Together& together : layout_.together) lists.push_back(together.cloths);
    return lists.empty() ? steps : steps_together(steps, lists);
}

void ClothSolver::add_step(graph::Graph& graph, ClothState* state, const Step& step) {
    add_step_pass(graph, pipelines_, state, run_->self_contact ? &contact_ : nullptr, inputs_, *run_, step);
    const ClothModel& cloth = state ? *state->model : run_->cloths.front();
    if (const double flops = step_flops(step, cloth); flops > 0)
        graph.add_flops(flops * step.count * (state ? state->count() : 1));
}

void ClothSolver::add_normals(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) {
        const vulkan::ComputePipeline& pipeline =
            pipelines_.get("normal.comp", [&](std::string_view) { return state.masked() ? 1u : 0u; });
        const Grid& grid = state.model->grid;
        add_compute_pass(graph, state.pass_name("normals", "normals"), pipeline, glsl::GridPush{grid.size()},
                         {grid.columns(), grid.rows(), state.count()}, {&state});
    });
    for (const Step& step : normal_steps(*run_)) add_dispatches(graph, step);
}

void ClothSolver::add_readback(graph::Graph& graph, Field image, std::string_view what) {
    for_each_dispatch([&](ClothState& state) { drape::add_readback(graph, state, state[image], what); });
}

void ClothSolver::add_field_readback(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) {
        if (state[Field::contact_impulses].valid())
            drape::add_readback(graph, state, state[Field::contact_impulses], contact_readback);
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
            if (keeps_tension(*state.model, direction))
                drape::add_readback(graph, state, state[tension_of(direction)], tension_readbacks[direction]);
    });
}

void ClothSolver::add_body_readback(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) {
        if (state[Field::bodies].valid()) drape::add_readback(graph, state, state[Field::bodies], bodies_readback);
    });
}

void ClothSolver::add_attempt(graph::Graph& graph, StateStep step) {
    std::size_t first = 0;
    for_each_dispatch([&](ClothState& state) {
        drape::add_attempt(graph, pipelines_, state, inputs_, *run_, step, first);
        first += state.cloths.size();
    });
    if (run_->self_contact) add_contact_attempt(graph, contact_, step);
}

void ClothSolver::add_statistics(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) { drape::add_statistics(graph, pipelines_, state, inputs_, *run_); });
    if (model_.scene.colliders.empty()) graph.skip("statistics: penetration", "no colliders in the scene");
}

}  // namespace drape
