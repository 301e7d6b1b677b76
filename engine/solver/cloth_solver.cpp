#include "solver/cloth_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "cloth/kernel_steps.h"
#include "cloth/step_flops.h"
#include "cloth/together.h"
#include "solver/attempt_pass.h"
#include "solver/cloth_constants.h"
#include "solver/cut_pass.h"
#include "solver/form_pass.h"
#include "solver/kernel_choice.h"
#include "solver/position_upload.h"
#include "solver/readback_pass.h"
#include "solver/statistics_pass.h"
#include "solver/step_row.h"
#include "solver/tear_pass.h"

namespace drape {

using graph::Lifetime;

namespace {

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

template <class T>
void write_buffer(const graph::ResourcePool& pool, std::uint32_t slot, const std::string& name,
                  const std::vector<T>& values) {
    if (!pool.has(name)) return;
    const std::span<const std::byte> bytes = bytes_of(values);
    std::memcpy(pool.buffer(name, slot).mapped().data(), bytes.data(), bytes.size());
}

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

/// Uploads what a field starts with, where it is somewhere and starts with anything.
template <class Row, class Context>
void upload_row(const graph::ResourcePool& pool, const std::string& name, const Row& row, const Context& about) {
    if (!row.start || !pool.has(name)) return;
    const std::vector<std::byte> bytes = row.start(about);
    if (row.is_image())
        vulkan::upload(pool.device(), pool.image(name), bytes);
    else
        vulkan::upload_range(pool.device(), pool.buffer(name), 0, bytes);  // lists have more room
}

constexpr const char* contact_readback_name = "contact record on the host";
std::string iteration_readback_name(const std::string& cloth) { return cloth + "/iterations on the host"; }

/// A name that no cloth has.
std::string together_name(const SimulationModel& model, const std::vector<std::size_t>& cloths) {
    std::string name = fmt::format("{} and {} more", model.cloths[cloths.front()].name, cloths.size() - 1);
    while (std::ranges::find(model.cloths, name, &ClothModel::name) != model.cloths.end()) name += '.';
    return name;
}

constexpr const char* mesh_fields_name = "mesh fields";

}  // namespace

ClothSolver::ClothSolver(const vulkan::Device& device, const SimulationModel& model, const Kernels& kernels,
                         bool in_part)
    : model_(model),
      run_(&model),
      in_part_(in_part),
      kernels_(possible_kernels(device, model, kernels)),
      verdicts_(kernel_verdicts(device, model, kernels)),
      pipelines_(device, in_part),
      most_list_bytes_(std::min<std::uint64_t>(device.limits().maxStorageBufferRange, device.max_buffer_size())) {
    if (model.self_contact) contact_.capacity = limited(model.self_contact->capacity, most_list_bytes_);
    for (const ClothModel& cloth : model.cloths) {
        topologies_.emplace_back(cloth);
        iteration_sizes_.push_back(std::make_shared<std::vector<glsl::uvec4>>());
    }
    find_together(device);
}

void ClothSolver::declare(graph::Graph& graph, const FrameNeeds& needs, const SimulationModel& run, StateSet set) {
    cloths_.clear();
    inputs_ = {};
    run_ = &run;
    set_ = set;
    for (const SkippedWork& work : run.skipped()) graph.skip(work.what, work.reason);
    for (const Compromise& each : run.compromises()) graph.compromise(each.what, each.reason);
    if (model_.windy)
        inputs_.wind = graph.buffer<glsl::vec4>(
            "wind", model_.member_count * model_.most_substeps() * (model_.weighs ? 2 : 1), Lifetime::host_input);
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
    if (!model_.mesh_fields.empty())
        inputs_.mesh_fields =
            graph.buffer({.name = mesh_fields_name,
                          .byte_count = model_.mesh_fields.texels().size() * sizeof(glsl::vec4),
                          .lifetime = model_.mesh_fields.deform() ? Lifetime::persistent : Lifetime::constant,
                          .element = &glsl::layout_of<glsl::vec4>(),
                          .texels = true});
    declare_forms(graph, model_, inputs_);
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) declare_cloth(graph, index, needs);
    for (Together& together : together_) declare_together(graph, together, needs);
    if (run.self_contact) declare_contact(graph);
}

void ClothSolver::declare_contact(graph::Graph& graph) {
    const ContactContext about = contact_context();
    contact_.buffered = kernels_.has(Kernel::buffer_store);
    for (const ContactRow& row : contact_fields())
        if (row.needed(about))
            contact_[row.field] = declare_row(graph, resource_name(row, set_), row, about, contact_.buffered);
}

ClothState ClothSolver::state_of(std::size_t index) const {
    ClothState state;
    state.model = &run_->cloths[index];
    state.name = state.model->name;
    state.topology = &topologies_[index];
    state.cloths = {index};
    state.pinned_count = state.model->pinned.size();
    state.pin_count = state.model->dynamic_pins.size();
    state.buffered = kernels_.has(Kernel::buffer_store);
    state.index_count = static_cast<std::uint32_t>(topologies_[index].indices().size());
    state.iteration_sizes = iteration_sizes_[index];
    return state;
}

void ClothSolver::declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs) {
    const FieldContext about = context(index, needs, *run_);
    ClothState state = state_of(index);
    for (const FieldRow& row : cloth_fields())
        if (row.needed(about) && (is_alone(index) || !lies_together(row)))
            state[row.field] = declare_row(graph, resource_name(about.cloth, row, set_), row, about, state.buffered);
    cloths_.push_back(state);
}

void ClothSolver::declare_together(graph::Graph& graph, Together& together, const FrameNeeds& needs) {
    const auto count = static_cast<std::uint32_t>(together.cloths.size());
    together.state = state_of(together.cloths.front());
    together.state.cloths = together.cloths;
    together.state.unlike = together.unlike;
    std::shared_ptr<ClothConstants>& constants = together.constants[run_->scene.solver.substeps];
    if (!constants) constants = std::make_shared<ClothConstants>();
    together.state.constants = constants;
    together.state.name = together_name(model_, together.cloths);
    for (const FieldRow& row : cloth_fields()) {
        if (!lies_together(row)) continue;
        graph::Handle whole;
        std::vector<std::string> slices;
        for (const std::size_t cloth : together.cloths)
            slices.push_back(resource_name(model_.cloths[cloth], row, set_));
        for (std::uint32_t k = 0; k < count; ++k) {
            const FieldContext about = context(together.cloths[k], needs, *run_);
            if (!row.needed(about)) continue;
            if (!whole.valid())
                whole = declare_row(graph, resource_name(together.state, row, set_), row, about,
                                    kernels_.has(Kernel::buffer_store), slices);
            cloths_[together.cloths[k]][row.field] = {whole.resource, whole.version, k};
        }
        together.state[row.field] = whole;
    }
    declare_lists(graph, together, needs);
    if (in_part_) declare_present(graph, together);
}

template <class Add>
void ClothSolver::for_each_dispatch(const Add& add) {
    for (Together& together : together_) add(together.state);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        if (is_alone(cloth)) add(cloths_[cloth]);
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
    const char* const name = "self record readback";
    if (run_->self_contact)
        add_buffer_readback(graph, {name, "simulate", name}, contact_[ContactField::record], 0,
                            run_->self_contact->member_count * sizeof(glsl::SelfRecord), contact_readback_name);
}

void ClothSolver::add_forms(graph::Graph& graph) { drape::add_forms(graph, pipelines_, *run_, inputs_); }

void ClothSolver::add_step(graph::Graph& graph, const Step& step) {
    add_dispatches(graph, step);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) take(cloth);
}

void ClothSolver::add_dispatches(graph::Graph& graph, const Step& step) {
    if (step.cloth == between_cloths) {
        add_step(graph, nullptr, step);
    } else if (step.together) {
        add_step(graph, &together_[together_of_[step.cloth]].state, step);
    } else if (step.cloth != all_cloths) {
        take(step.cloth);
        add_step(graph, &cloths_[step.cloth], step);
        give(step.cloth);
    } else {
        for_each_dispatch([&](ClothState& state) { add_step(graph, &state, step); });
    }
}

std::vector<std::size_t> ClothSolver::cloths_of(const Step& step) const {
    if (step.together) return together_[together_of_[step.cloth]].cloths;
    if (step.cloth < model_.cloths.size()) return {step.cloth};
    std::vector<std::size_t> all(model_.cloths.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

std::vector<Step> ClothSolver::steps() const {
    const std::vector<Step> steps = kernel_steps(*run_, kernels_);
    std::vector<std::vector<std::size_t>> lists;
    for (const Together& together : together_) lists.push_back(together.cloths);
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
}

void ClothSolver::add_readback(graph::Graph& graph, Field image, std::string_view what) {
    for_each_dispatch([&](ClothState& state) { drape::add_readback(graph, state, state[image], what); });
}

std::vector<std::span<const float>> ClothSolver::readback(const graph::ResourcePool& pool, std::uint32_t slot,
                                                          std::string_view what) const {
    std::vector<std::span<const float>> views;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const auto bytes = part_of(cloth, pool.buffer(readback_name(state_name(cloth), what), slot));
        views.push_back({reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)});
    }
    return views;
}

void ClothSolver::add_attempt(graph::Graph& graph, StateStep step) {
    std::size_t first = 0;
    for_each_dispatch([&](ClothState& state) {
        drape::add_attempt(graph, pipelines_, state, inputs_, *run_, step, first);
        first += state.cloths.size();
    });
    if (run_->self_contact) add_contact_attempt(graph, contact_, step);
}

std::vector<double> ClothSolver::differences(const graph::ResourcePool& pool, std::uint32_t slot) const {
    std::vector<double> all;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const auto bytes = part_of(cloth, pool.buffer(difference_readback_name(state_name(cloth)), slot));
        std::vector<glsl::DifferenceRecord> partials(bytes.size() / sizeof(glsl::DifferenceRecord));
        std::memcpy(partials.data(), bytes.data(), bytes.size());
        all.push_back(difference_of(partials));
    }
    return all;
}

void ClothSolver::add_tension(graph::Graph& graph, ClothState& state) {
    const Grid& grid = state.model->grid;
    const std::vector<graph::PushConstants> each =
        pushes_of(state, *run_, [](const ClothModel& cloth) { return *cloth.scheme.gathered_tension; });
    const std::string module = "tension.comp";
    graph::Handle own = own_constants(graph, state, module, "tension", each);
    const auto value = [&](std::string_view) { return state.own_rest(); };
    add_compute_pass(graph, state.pass_name("tension", "statistics"), pipelines_.get(module, value, own.valid()),
                     each.front(), {grid.columns(), grid.rows(), state.count()},
                     {&state, nullptr, {}, {{"constants", &own}}});
}

void ClothSolver::add_statistics(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) {
        if (state.model->scheme.gathered_tension) add_tension(graph, state);
        drape::add_statistics(graph, pipelines_, state, inputs_, *run_);
        if (model_.adaptive())
            add_buffer_readback(graph, state.pass_name("iteration readback", "statistics"), state[Field::iterations],
                                glsl::iteration_size_count * sizeof(glsl::uvec4), sizeof(glsl::uvec4),
                                iteration_readback_name(state.name));
    });
    if (model_.scene.colliders.empty()) graph.skip("statistics: penetration", "no colliders in the scene");
}

std::vector<std::span<const std::byte>> ClothSolver::statistics_records(const graph::ResourcePool& pool,
                                                                        std::uint32_t slot) const {
    std::vector<std::span<const std::byte>> records;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
        records.push_back(part_of(cloth, pool.buffer(statistics_readback_name(state_name(cloth)), slot)));
    return records;
}

std::vector<ClothStatistics> ClothSolver::statistics(const graph::ResourcePool& pool, std::uint32_t slot,
                                                     std::uint32_t frame, const SimulationModel& run) const {
    std::vector<ClothStatistics> all;
    const std::vector<std::span<const std::byte>> records = statistics_records(pool, slot);
    for (const ClothModel& cloth : run.cloths) {
        glsl::StatisticsRecord record;
        std::memcpy(&record, records[all.size()].data(), sizeof record);
        all.push_back(cloth_statistics(run, cloth, record, frame));
        if (!run.adaptive()) continue;
        glsl::uvec4 used;
        std::memcpy(&used, pool.buffer(iteration_readback_name(cloth.name), slot).mapped().data(), sizeof used);
        all.back().iteration_count = used.x;
    }
    return all;
}

glsl::SelfRecord ClothSolver::self_record(const graph::ResourcePool& pool, std::uint32_t slot) const {
    glsl::SelfRecord record{};
    if (model_.self_contact)
        std::memcpy(&record, pool.buffer(contact_readback_name, slot).mapped().data(), sizeof record);
    return record;
}

glsl::SelfRecord ClothSolver::self_record_of(const graph::ResourcePool& pool, std::uint32_t slot,
                                             std::size_t member) const {
    if (model_.member_count == 1) return self_record(pool, slot);
    glsl::SelfRecord record{};
    const auto records = pool.buffer(contact_readback_name, slot).mapped();
    std::memcpy(&record, records.subspan(member * sizeof record, sizeof record).data(), sizeof record);
    record.most_pairs = record.most_own_pairs;
    return record;
}

double ClothSolver::self_list_use(const glsl::SelfRecord& record) const {
    return model_.self_contact ? drape::self_list_use(contact_.capacity, record) : 0;
}

bool ClothSolver::grow_lists(const glsl::SelfRecord& record) {
    const ContactCapacity before = contact_.capacity;
    contact_.capacity = limited(grown_capacity(before, record), most_list_bytes_);
    return contact_.capacity != before;
}

void ClothSolver::upload(const graph::ResourcePool& pool) const {
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) {
        const FieldContext about = context(index);
        for (const FieldRow& row : cloth_fields())
            if (is_alone(index) || !lies_together(row))
                for (const std::string& name :
                     names_in_sets([&](StateSet set) { return resource_name(about.cloth, row, set); }))
                    upload_row(pool, name, row, about);
        const std::string name = resource_name(about.cloth, row_of(Field::iteration_sizes));
        if (!pool.has(name)) continue;
        std::vector<glsl::uvec4> sizes = *iteration_sizes_[index];
        sizes.resize(glsl::iteration_size_count);
        vulkan::upload(pool.device(), pool.buffer(name), bytes_of(sizes));
    }
    if (!model_.mesh_fields.empty() && pool.has(mesh_fields_name))
        vulkan::upload(pool.device(), pool.buffer(mesh_fields_name), bytes_of(model_.mesh_fields.texels()));
    if (model_.self_contact)
        for (const ContactRow& row : contact_fields())
            for (const std::string& name : names_in_sets([&](StateSet set) { return resource_name(row, set); }))
                upload_row(pool, name, row, ContactContext{*model_.self_contact, contact_.capacity});
    upload_together(pool);
}

void ClothSolver::write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                               const SimulationModel& run) const {
    write_inputs(pool, slot, frame_inputs(run, frame), run.scene.solver.substeps);
    write_constants(pool, slot, run.scene.solver.substeps);
}

void ClothSolver::write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, const FrameInputs& inputs,
                               std::uint32_t substeps) const {
    if (model_.windy) write_buffer(pool, slot, "wind", inputs.wind);
    if (!inputs.stiffness.empty()) write_buffer(pool, slot, "stiffness", inputs.stiffness);
    if (!inputs.colliders.empty()) write_buffer(pool, slot, "colliders", inputs.colliders);
    if (inputs.forms) write_forms(pool, slot, *inputs.forms);
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
        if (is_alone(cloth) && !inputs.pins[cloth].empty())
            write_buffer(pool, slot, resource_name(model_.cloths[cloth], row_of(Field::pin_motions)),
                         inputs.pins[cloth]);
    write_together(pool, slot, inputs, substeps);
}

}  // namespace drape
