#include "passes/cloth_solver.h"

#include <cstring>

#include "passes/bend_pass.h"
#include "passes/check_pass.h"
#include "passes/collision_pass.h"
#include "passes/cut_pass.h"
#include "passes/explicit_pass.h"
#include "passes/force_pass.h"
#include "passes/line_pass.h"
#include "passes/normal_pass.h"
#include "passes/pin_pass.h"
#include "passes/spring_pass.h"
#include "passes/statistics_pass.h"
#include "passes/tension_pass.h"
#include "passes/tether_pass.h"
#include "passes/wind_pass.h"

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

}  // namespace

DeviceKind device_kind(const vulkan::DeviceInfo& device) {
    return device.type == "cpu" ? DeviceKind::cpu : DeviceKind::gpu;
}

ClothSolver::ClothSolver(const vulkan::Device& device, const SimulationModel& model)
    : model_(model), pipelines_(device) {
    for (const ClothModel& cloth : model.cloths) {
        topologies_.emplace_back(cloth);
        iteration_sizes_.push_back(std::make_shared<std::vector<glsl::uvec4>>());
    }
}

void ClothSolver::declare(graph::Graph& graph, const FrameNeeds& needs) {
    cloths_.clear();
    inputs_ = {};
    for (const SkippedWork& work : model_.skipped()) graph.skip(work.what, work.reason);
    for (const Compromise& each : model_.compromises()) graph.compromise(each.what, each.reason);
    const SceneDescription& scene = model_.scene;
    if (model_.windy) inputs_.wind = graph.buffer<glsl::vec4>("wind", scene.solver.substeps, Lifetime::host_input);
    for (std::size_t kind = 0; kind < collider_kind_count; ++kind)
        if (const std::size_t count = collider_record_count(scene, static_cast<ColliderKind>(kind)))
            inputs_.colliders[kind] = graph.buffer<glsl::Collider>("colliders/" + std::string(collider_kind_name(kind)),
                                                                   count, Lifetime::host_input);
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) declare_cloth(graph, index, needs);
}

void ClothSolver::declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs) {
    const ClothModel& model = model_.cloths[index];
    const auto image = [&](const std::string& part, Lifetime lifetime, VkFormat format, std::uint32_t smaller = 0) {
        return graph.image({model.name + "/" + part, format, model.grid.columns() - smaller,
                            model.grid.rows() - smaller, VK_SAMPLE_COUNT_1_BIT, lifetime});
    };
    constexpr VkFormat vec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    ClothState state;
    state.model = &model;
    state.topology = &topologies_[index];
    state.index = index;
    state.position = image("position", Lifetime::persistent, vec4);
    state.displacement = image("displacement", Lifetime::persistent, vec4);
    state.position_rest = image("position rest", Lifetime::persistent, vec4);
    state.displacement_rest = image("displacement rest", Lifetime::persistent, vec4);
    if (model.plan.spare_state) {
        state.position_spare = image("position spare", Lifetime::transient, vec4);
        state.displacement_spare = image("displacement spare", Lifetime::transient, vec4);
    }
    declare_line(graph, state);
    if (model_.windy) state.wind_force = image("wind force", Lifetime::transient, vec4);
    if (needs.drawing) state.normal = image("normal", Lifetime::transient, vec4);
    if (state.masked()) {
        state.stiffness = image("stiffness", Lifetime::constant, vec4);
        state.mass = image("mass share", Lifetime::constant, VK_FORMAT_R32_SFLOAT);
        state.cells = image("cells", Lifetime::constant, VK_FORMAT_R32_UINT, 1);
    }
    for (std::size_t direction = 0; direction < 4; ++direction)
        if (model.plan.carries_tension[direction] ||
            ((needs.statistics || model_.adaptive()) && direction < stretch_direction_count))
            state.tension[direction] = image("tension " + std::string(spring_directions[direction].name),
                                             Lifetime::persistent, VK_FORMAT_R32_SFLOAT);
    if (model_.adaptive()) declare_iterations(graph, state);
    if (needs.drawing) declare_drawing(graph, state);
    if (!model.tethers.empty())
        state.tethers =
            graph.buffer<glsl::ParticleTethers>(model.name + "/tethers", model.tethers.size(), Lifetime::constant);
    if (!model.pinned.empty()) {
        state.pinned = graph.buffer<glsl::PinnedParticle>(model.name + "/pinned particles", model.pinned.size(),
                                                          Lifetime::constant);
        state.pin_motions = graph.buffer<glsl::PinMotion>(model.name + "/pin motions",
                                                          model.dynamic_pins.size() * model_.scene.solver.substeps,
                                                          Lifetime::host_input);
    }
    cloths_.push_back(state);
}

void ClothSolver::declare_iterations(graph::Graph& graph, ClothState& state) {
    const std::string& name = state.model->name;
    constexpr std::uint64_t list = glsl::iteration_size_count;
    state.residuals =
        graph.buffer<glsl::ResidualRecord>(name + "/residuals", residual_count(state.model->grid), Lifetime::transient);
    state.iterations = graph.buffer<glsl::uvec4>(name + "/iterations", list + 1, Lifetime::persistent);
    state.iteration_size_list = graph.buffer<glsl::uvec4>(name + "/iteration sizes", list, Lifetime::constant);
    state.iteration_sizes = iteration_sizes_[state.index];
}

void ClothSolver::declare_drawing(graph::Graph& graph, ClothState& state) const {
    const std::string& name = state.model->name;
    const std::size_t index_count = state.topology->indices().size(), vertex_count = state.topology->vertices().size();
    state.index_count = static_cast<std::uint32_t>(index_count);
    const std::size_t room = model_.scene.cutters.empty() ? index_count : draw_list_capacity(index_count);
    state.triangles = graph.buffer({name + "/triangles", room * sizeof(std::uint32_t), Lifetime::constant});
    if (vertex_count == 0) return;
    const std::size_t vertex_room = draw_list_capacity(vertex_count);
    state.cut_vertices = graph.buffer<glsl::CutVertex>(name + "/cut vertices", vertex_room, Lifetime::constant);
}

void ClothSolver::add_cuts(graph::Graph& graph) {
    const std::size_t count = model_.scene.cutters.size();
    const graph::Handle cutters = declare_cutters(graph, count);
    for (ClothState& state : cloths_) add_cut(graph, pipelines_, state, cutters, count);
}

void ClothSolver::add_simulation(graph::Graph& graph) {
    for (const Step& step : frame_steps(model_)) {
        if (step.cloth != all_cloths)
            add_step(graph, cloths_[step.cloth], step);
        else
            for (ClothState& state : cloths_) add_step(graph, state, step);
    }
}

void ClothSolver::add_step(graph::Graph& graph, ClothState& state, const Step& step) {
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
        case StepKind::spring:
            return add_spring(graph, pipelines_, state, step);
        case StepKind::line:
            return add_line(graph, pipelines_, state, step);
        case StepKind::tether:
            return add_tether(graph, pipelines_, state, step);
        case StepKind::collide:
            return add_collision(graph, pipelines_, state, inputs_, model_, step);
        case StepKind::check:
            return add_check(graph, pipelines_, state, model_, step);
        case StepKind::advance:
            return add_advance(graph, pipelines_, state);
    }
}

void ClothSolver::add_normals(graph::Graph& graph) {
    for (ClothState& state : cloths_) drape::add_normals(graph, pipelines_, state);
}

void ClothSolver::add_statistics(graph::Graph& graph) {
    for (ClothState& state : cloths_) {
        if (state.model->plan.gathered_tension) add_tension(graph, pipelines_, state);
        drape::add_statistics(graph, pipelines_, state, inputs_, model_);
        if (model_.adaptive()) add_iteration_readback(graph, state);
    }
    if (model_.collider_count == 0) graph.skip("statistics: penetration", "no colliders in the scene");
}

std::vector<ClothStatistics> ClothSolver::statistics(const graph::ResourcePool& pool, std::uint32_t slot) const {
    std::vector<ClothStatistics> all;
    for (const ClothModel& cloth : model_.cloths) {
        glsl::StatisticsRecord record;
        std::memcpy(&record, pool.buffer(statistics_readback_name(cloth), slot).mapped().data(), sizeof record);
        all.push_back(cloth_statistics(model_, cloth, record));
        if (!model_.adaptive()) continue;
        glsl::uvec4 used;
        std::memcpy(&used, pool.buffer(iteration_readback_name(cloth), slot).mapped().data(), sizeof used);
        all.back().iteration_count = used.x;
    }
    return all;
}

void ClothSolver::upload(const graph::ResourcePool& pool) const {
    const auto image = [&](const ClothModel& cloth, const char* part, auto bytes) {
        const std::string name = cloth.name + "/" + part;
        if (pool.has(name)) vulkan::upload(pool.device(), pool.image(name), bytes);
    };
    const auto buffer = [&](const ClothModel& cloth, const char* part, auto bytes) {
        const std::string name = cloth.name + "/" + part;
        if (pool.has(name)) vulkan::upload_range(pool.device(), pool.buffer(name), 0, bytes);  // lists have more room
    };
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) {
        const ClothModel& cloth = model_.cloths[index];
        const std::vector<glsl::vec4> zero(cloth.grid.particle_count());
        image(cloth, "position", bytes_of(cloth.position));
        image(cloth, "displacement", bytes_of(cloth.start_displacement()));
        image(cloth, "position rest", bytes_of(zero));
        image(cloth, "displacement rest", bytes_of(zero));
        image(cloth, "displacement before", bytes_of(zero));
        image(cloth, "velocity excess", bytes_of(zero));
        const std::vector<float> slack(cloth.grid.particle_count());
        for (const SpringDirection& direction : spring_directions)
            image(cloth, ("tension " + std::string(direction.name)).c_str(), bytes_of(slack));
        const CutTopology& topology = topologies_[index];
        if (topology.masked()) {
            image(cloth, "stiffness", bytes_of(topology.spring_shares()));
            image(cloth, "mass share", bytes_of(mass_shares(cloth)));
            image(cloth, "cells", bytes_of(topology.grid().cells()));
        }
        buffer(cloth, "triangles", bytes_of(topology.indices()));
        buffer(cloth, "cut vertices", bytes_of(topology.vertices()));
        buffer(cloth, "tethers", bytes_of(topology.tethers()));
        buffer(cloth, "pinned particles", bytes_of(cloth.pinned));
        if (model_.adaptive()) {
            std::vector<glsl::uvec4> sizes = *iteration_sizes_[index];
            sizes.resize(glsl::iteration_size_count);
            buffer(cloth, "iteration sizes", bytes_of(sizes));
        }
    }
}

void ClothSolver::write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame) const {
    const FrameInputs inputs = frame_inputs(model_, frame);
    if (model_.windy) write_buffer(pool, slot, "wind", inputs.wind);
    for (std::size_t kind = 0; kind < collider_kind_count; ++kind)
        if (!inputs.colliders[kind].empty())
            write_buffer(pool, slot, std::string("colliders/") + std::string(collider_kind_name(kind)),
                         inputs.colliders[kind]);
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
        if (!inputs.pins[cloth].empty())
            write_buffer(pool, slot, model_.cloths[cloth].name + "/pin motions", inputs.pins[cloth]);
}

}  // namespace drape
