#include "solver/cloth_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "cloth/step_flops.h"
#include "cloth/together.h"
#include "solver/attempt_pass.h"
#include "solver/bend_pass.h"
#include "solver/box_edge_pass.h"
#include "solver/check_pass.h"
#include "solver/collision_pass.h"
#include "solver/cut_pass.h"
#include "solver/device_schedule.h"
#include "solver/explicit_pass.h"
#include "solver/force_pass.h"
#include "solver/line_pass.h"
#include "solver/nested_pass.h"
#include "solver/normal_pass.h"
#include "solver/pin_pass.h"
#include "solver/position_upload.h"
#include "solver/self_contact_pass.h"
#include "solver/spring_pass.h"
#include "solver/statistics_pass.h"
#include "solver/sweep_pass.h"
#include "solver/tension_pass.h"
#include "solver/tether_pass.h"
#include "solver/wind_pass.h"

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

Lifetime lifetime_of(FieldLife life) {
    switch (life) {
        case FieldLife::frame:
            return Lifetime::transient;
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

VkFormat format_of(const FieldRow& row) {
    if (&row.element == &glsl::layout_of<glsl::vec4>()) return VK_FORMAT_R32G32B32A32_SFLOAT;
    return &row.element == &glsl::layout_of<float>() ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32_UINT;
}

graph::Handle declare_field(graph::Graph& graph, const FieldRow& row, const FieldContext& about, bool buffered) {
    const FieldExtent extent = row.extent(about);
    const std::string name = resource_name(about.cloth, row);
    if (!row.is_image())
        return graph.buffer({name, extent.count() * row.element.size, lifetime_of(row.life), &row.element,
                             row.view == FieldView::texel_buffer});
    return graph.image({name, format_of(row), static_cast<std::uint32_t>(extent.width),
                        static_cast<std::uint32_t>(extent.height), VK_SAMPLE_COUNT_1_BIT, lifetime_of(row.life),
                        buffered && row.view == FieldView::image_and_buffer});
}

/// The same field of several cloths of one size in one image.
graph::Handle declare_below(graph::Graph& graph, const FieldRow& row, const FieldContext& about,
                            const std::string& name, const std::vector<std::string>& slices) {
    const FieldExtent extent = row.extent(about);
    return graph.image({fmt::format("{}/{}", name, row.name), format_of(row), static_cast<std::uint32_t>(extent.width),
                        static_cast<std::uint32_t>(extent.height * slices.size()), VK_SAMPLE_COUNT_1_BIT,
                        lifetime_of(row.life), true, slices});
}

/// Which no cloth has.
std::string together_name(const SimulationModel& model, const std::vector<std::size_t>& cloths) {
    std::string name = fmt::format("{} and {} more", model.cloths[cloths.front()].name, cloths.size() - 1);
    while (std::ranges::find(model.cloths, name, &ClothModel::name) != model.cloths.end()) name += '.';
    return name;
}

}  // namespace

ClothSolver::ClothSolver(const vulkan::Device& device, const SimulationModel& model, Schedule schedule)
    : model_(model),
      run_(&model),
      schedule_(possible_schedule(device, model, schedule)),
      pipelines_(device),
      most_list_bytes_(std::min<std::uint64_t>(device.limits().maxStorageBufferRange, device.max_buffer_size())) {
    if (model.self_contact) self_room_ = limited(model.self_contact->room, most_list_bytes_);
    for (const ClothModel& cloth : model.cloths) {
        topologies_.emplace_back(cloth);
        iteration_sizes_.push_back(std::make_shared<std::vector<glsl::uvec4>>());
    }
    if (stores_through_buffers(schedule_)) find_together(device);
    together_of_.assign(model.cloths.size(), together_.size());
    for (std::size_t k = 0; k < together_.size(); ++k)
        for (const std::size_t cloth : together_[k].cloths) together_of_[cloth] = k;
}

void ClothSolver::declare(graph::Graph& graph, const FrameNeeds& needs, const SimulationModel& run) {
    cloths_.clear();
    inputs_ = {};
    run_ = &run;
    for (const SkippedWork& work : run.skipped()) graph.skip(work.what, work.reason);
    for (const Compromise& each : run.compromises()) graph.compromise(each.what, each.reason);
    if (model_.windy) inputs_.wind = graph.buffer<glsl::vec4>("wind", model_.most_substeps(), Lifetime::host_input);
    if (model_.closed_loop())
        inputs_.attempt = graph.buffer<glsl::StepChange>(attempt_name, model_.cloths.size(), Lifetime::host_input);
    if (const std::size_t count = collider_record_count(model_))
        inputs_.colliders = graph.buffer({.name = "colliders",
                                          .byte_count = count * sizeof(glsl::ColliderRecord),
                                          .lifetime = Lifetime::host_input,
                                          .element = &glsl::layout_of<glsl::ColliderRecord>(),
                                          .texels = true});
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) declare_cloth(graph, index, needs);
    for (Together& together : together_) declare_together(graph, together, needs);
}

ClothState ClothSolver::state_of(std::size_t index) const {
    ClothState state;
    state.model = &run_->cloths[index];
    state.name = state.model->name;
    state.topology = &topologies_[index];
    state.index = index;
    state.pinned_count = state.model->pinned.size();
    state.pin_count = state.model->dynamic_pins.size();
    state.buffered = stores_through_buffers(schedule_);
    state.index_count = static_cast<std::uint32_t>(topologies_[index].indices().size());
    state.iteration_sizes = iteration_sizes_[index];
    return state;
}

void ClothSolver::declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs) {
    const FieldContext about = context(index, needs, *run_);
    ClothState state = state_of(index);
    const bool alone = together_of_[index] == together_.size();
    for (const FieldRow& row : cloth_fields())
        if (row.needed(about) && (alone || !row.lies_together()))
            state[row.field] = declare_field(graph, row, about, state.buffered);
    cloths_.push_back(state);
}

void ClothSolver::declare_together(graph::Graph& graph, Together& together, const FrameNeeds& needs) {
    const auto count = static_cast<std::uint32_t>(together.cloths.size());
    together.state = state_of(together.cloths.front());
    together.state.count = count;
    together.state.name = together_name(model_, together.cloths);
    for (const FieldRow& row : cloth_fields()) {
        if (!row.lies_together()) continue;
        graph::Handle whole;
        std::vector<std::string> slices;
        for (const std::size_t cloth : together.cloths) slices.push_back(resource_name(model_.cloths[cloth], row));
        for (std::uint32_t k = 0; k < count; ++k) {
            const FieldContext about = context(together.cloths[k], needs, *run_);
            if (!row.needed(about)) continue;
            if (!whole.valid()) whole = declare_below(graph, row, about, together.state.name, slices);
            cloths_[together.cloths[k]][row.field] = {whole.resource, whole.version, k};
        }
        together.state[row.field] = whole;
    }
    declare_pins(graph, together, needs);
}

template <class Add>
void ClothSolver::for_each_dispatch(const Add& add) {
    for (Together& together : together_) add(together.state);
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) {
        if (together_of_[cloth] == together_.size()) add(cloths_[cloth]);
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

void ClothSolver::add_positions(graph::Graph& graph) {
    for_each_cloth([&](ClothState& state) { add_position_upload(graph, state); });
}

void ClothSolver::add_simulation(graph::Graph& graph) {
    const auto add = [&](ClothState& state, const Step& step) {
        add_step(graph, state, step);
        if (const double flops = step_flops(step, *state.model); flops > 0)
            graph.add_flops(flops * step.count * state.count);
    };
    for (const Step& step : steps()) {
        if (step.cloth == between_cloths) {
            add(cloths_.front(), step);
        } else if (step.together) {
            add(together_[together_of_[step.cloth]].state, step);
        } else if (step.cloth != all_cloths) {
            take(step.cloth);
            add(cloths_[step.cloth], step);
            give(step.cloth);
        } else {
            for_each_dispatch([&](ClothState& state) { add(state, step); });
        }
    }
    for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) take(cloth);
    if (run_->self_contact) add_self_readback(graph, cloths_.front());
}

std::vector<Step> ClothSolver::steps() const {
    const std::vector<Step> steps = scheduled_steps(*run_, schedule_);
    std::vector<std::vector<std::size_t>> lists;
    for (const Together& together : together_) lists.push_back(together.cloths);
    return lists.empty() ? steps : steps_together(steps, lists);
}

void ClothSolver::add_step(graph::Graph& graph, ClothState& state, const Step& step) {
    if (step.cloth == between_cloths) return add_contact_step(graph, state, step);
    switch (step.kind) {
        case StepKind::release:
            return add_pin_release(graph, pipelines_, state, step);
        case StepKind::wind:
            return add_wind(graph, pipelines_, state, inputs_, step);
        case StepKind::control:
            return add_line_control(graph, pipelines_, state, step);
        case StepKind::predict:
            return add_predict(graph, pipelines_, state, step);
        case StepKind::force:
            return add_force(graph, pipelines_, state, step);
        case StepKind::explicit_step:
            return add_explicit_step(graph, pipelines_, state, step);
        case StepKind::pin:
            return add_pin_motion(graph, pipelines_, state, step);
        case StepKind::bend:
            return add_bend(graph, pipelines_, state, step);
        case StepKind::twist:
            return add_twist(graph, pipelines_, state, step);
        case StepKind::twist_sweep:
            return add_twist_sweep(graph, pipelines_, state, step);
        case StepKind::spring:
            return add_spring(graph, pipelines_, state, step);
        case StepKind::sweep:
            return add_sweep(graph, pipelines_, state, step);
        case StepKind::line:
            return add_line(graph, pipelines_, state, step);
        case StepKind::nested:
            return add_nested(graph, pipelines_, state, step);
        case StepKind::tether:
            return add_tether(graph, pipelines_, state, step);
        case StepKind::box_edges:
            return add_box_edges(graph, pipelines_, state, inputs_, *run_, step);
        case StepKind::collide:
            return add_collision(graph, pipelines_, state, inputs_, *run_, step);
        case StepKind::check:
            return add_check(graph, pipelines_, state, *run_, step);
        case StepKind::self_gather:
            return add_self_gather(graph, pipelines_, state, cloths_.front(), step);
        case StepKind::self_gather_again:
            return add_self_gather_again(graph, pipelines_, state, cloths_.front(), step);
        case StepKind::self_return:
            return add_self_return(graph, pipelines_, state, cloths_.front(), step);
        case StepKind::advance:
            return add_advance(graph, pipelines_, state);
        default:
            throw std::logic_error("a step of contact that is no cloth's");
    }
}

void ClothSolver::add_contact_step(graph::Graph& graph, ClothState& state, const Step& planned) {
    Step step = planned;
    auto& push = std::get<glsl::SelfContactPush>(step.constants);
    push.pair_room = static_cast<int>(self_room_.pairs);
    push.near_room = static_cast<int>(self_room_.near);
    push.cell_room = static_cast<int>(self_room_.cells);
    switch (step.kind) {
        case StepKind::self_common:
            return add_self_common(graph, pipelines_, state, step);
        case StepKind::self_boxes:
            return add_self_boxes(graph, pipelines_, state, step);
        case StepKind::self_search:
            return add_self_search(graph, pipelines_, state, step);
        case StepKind::self_kept:
            return add_self_kept(graph, pipelines_, state, step);
        case StepKind::self_levels:
            return add_self_levels(graph, pipelines_, state, step);
        case StepKind::self_blocks:
            return add_self_blocks(graph, pipelines_, state, step);
        case StepKind::self_cells:
            return add_self_cells(graph, pipelines_, state, step);
        case StepKind::self_near:
            return add_self_near(graph, pipelines_, state, step);
        case StepKind::self_bent:
            return add_self_bent(graph, pipelines_, state, run_->self_contact->largest, step);
        case StepKind::self_crossings:
            return add_self_crossings(graph, pipelines_, state, step);
        case StepKind::self_apart:
            return add_self_apart(graph, pipelines_, state, step);
        case StepKind::self_primitives:
            return add_self_primitives(graph, pipelines_, state, step);
        case StepKind::self_pairs:
            return add_self_pairs(graph, pipelines_, state, step);
        case StepKind::self_contact:
            return add_self_contact(graph, pipelines_, state, step);
        case StepKind::self_push:
            return add_self_push(graph, pipelines_, state, step);
        case StepKind::self_room:
            return add_self_room(graph, pipelines_, state, step);
        case StepKind::self_move:
            return add_self_move(graph, pipelines_, state, step);
        default:
            return;
    }
}

void ClothSolver::add_normals(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) { drape::add_normals(graph, pipelines_, state); });
}

void ClothSolver::add_attempt(graph::Graph& graph, AttemptStep step) {
    for_each_cloth(
        [&](ClothState& state) { drape::add_attempt(graph, pipelines_, state, inputs_, state.index, step); });
}

std::vector<double> ClothSolver::differences(const graph::ResourcePool& pool, std::uint32_t slot) const {
    std::vector<double> all;
    for (const ClothModel& cloth : model_.cloths) {
        std::vector<glsl::DifferenceRecord> partials(difference_count(cloth.grid));
        const std::span<const std::byte> bytes = pool.buffer(difference_readback_name(cloth), slot).mapped();
        std::memcpy(partials.data(), bytes.data(), partials.size() * sizeof(glsl::DifferenceRecord));
        all.push_back(difference_of(partials));
    }
    return all;
}

void ClothSolver::add_statistics(graph::Graph& graph) {
    for_each_dispatch([&](ClothState& state) {
        if (state.model->plan.gathered_tension) add_tension(graph, pipelines_, state);
        drape::add_statistics(graph, pipelines_, state, inputs_, *run_);
        if (model_.adaptive()) add_iteration_readback(graph, state);
    });
    if (model_.scene.colliders.empty()) graph.skip("statistics: penetration", "no colliders in the scene");
}

glsl::StatisticsRecord ClothSolver::statistics_record(const graph::ResourcePool& pool, std::uint32_t slot,
                                                      std::size_t cloth) const {
    const bool alone = together_of_[cloth] == together_.size();
    const std::string& name = alone ? model_.cloths[cloth].name : together_[together_of_[cloth]].state.name;
    glsl::StatisticsRecord record;
    const std::span<const std::byte> bytes = pool.buffer(statistics_readback_name(name), slot).mapped();
    std::memcpy(&record, bytes.data() + place_of(cloth) * sizeof record, sizeof record);
    return record;
}

std::vector<ClothStatistics> ClothSolver::statistics(const graph::ResourcePool& pool, std::uint32_t slot,
                                                     const SimulationModel& run) const {
    std::vector<ClothStatistics> all;
    for (const ClothModel& cloth : run.cloths) {
        const glsl::StatisticsRecord record = statistics_record(pool, slot, all.size());
        all.push_back(cloth_statistics(run, cloth, record));
        if (!run.adaptive()) continue;
        glsl::uvec4 used;
        std::memcpy(&used, pool.buffer(iteration_readback_name(cloth), slot).mapped().data(), sizeof used);
        all.back().iteration_count = used.x;
    }
    return all;
}

glsl::SelfRecord ClothSolver::self_record(const graph::ResourcePool& pool, std::uint32_t slot) const {
    glsl::SelfRecord record{};
    if (model_.self_contact) std::memcpy(&record, pool.buffer(self_readback_name, slot).mapped().data(), sizeof record);
    return record;
}

double ClothSolver::self_list_use(const glsl::SelfRecord& record) const {
    return model_.self_contact ? drape::self_list_use(self_room_, record) : 0;
}

bool ClothSolver::grow_lists(const glsl::SelfRecord& record) {
    const SelfRoom before = self_room_;
    self_room_ = limited(more_self_room(before, record), most_list_bytes_);
    return self_room_ != before;
}

void ClothSolver::upload(const graph::ResourcePool& pool) const {
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) {
        const FieldContext about = context(index);
        for (const FieldRow& row : cloth_fields()) {
            const std::string name = resource_name(about.cloth, row);
            if (!row.start || !pool.has(name)) continue;
            const std::vector<std::byte> bytes = row.start(about);
            if (row.is_image())
                vulkan::upload(pool.device(), pool.image(name), bytes);
            else
                vulkan::upload_range(pool.device(), pool.buffer(name), 0, bytes);  // lists have more room
        }
        const std::string name = resource_name(about.cloth, row_of(Field::iteration_sizes));
        if (!pool.has(name)) continue;
        std::vector<glsl::uvec4> sizes = *iteration_sizes_[index];
        sizes.resize(glsl::iteration_size_count);
        vulkan::upload(pool.device(), pool.buffer(name), bytes_of(sizes));
    }
    upload_pins(pool);
}

void ClothSolver::write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                               const SimulationModel& run) const {
    const FrameInputs inputs = frame_inputs(run, frame);
    if (model_.windy) write_buffer(pool, slot, "wind", inputs.wind);
    if (!inputs.colliders.empty()) write_buffer(pool, slot, "colliders", inputs.colliders);
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
        if (!inputs.pins[cloth].empty())
            write_buffer(pool, slot, resource_name(model_.cloths[cloth], row_of(Field::pin_motions)),
                         inputs.pins[cloth]);
    write_pins(pool, slot, inputs, run.scene.solver.substeps);
}

}  // namespace drape
