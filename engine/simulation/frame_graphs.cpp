#include "simulation/frame_graphs.h"

#include <fmt/format.h>

#include "solver/state_transfer.h"

namespace drape {

namespace {

void note_skipped(graph::Graph& graph, const SceneDescription& scene, const FrameOptions& options,
                  const FrameContents& contents) {
    if (!contents.cuts)
        graph.skip("cut search",
                   scene.cutters.empty() ? "no cutter in the scene" : "no cutter is active in this kind of frame");
    if (!contents.tears)
        graph.skip("tear search",
                   scene.tears() ? "nothing tears in this kind of frame" : "no cloth of the scene tears");
    if (!options.draw && !options.draws_beside)
        graph.skip(options.normals ? "raster and colour readback" : "normals, raster and colour readback",
                   "no picture is wanted");
    if (!options.positions) graph.skip("position readback", "no position export is wanted");
    if (!options.fields)
        graph.skip("readback of tensions and contact forces",
                   scene.force_fields ? "no position export is wanted" : "the scene does not ask for them");
    else if (scene.colliders.empty())
        graph.skip("sums of contact forces by particle", "no colliders in the scene");
    if (!contents.counts && !options.statistics) graph.skip("statistics", "nobody asked for them");
}

}  // namespace

FrameGraphs::FrameGraphs(const vulkan::Device& device, const std::vector<const SimulationModel*>& members,
                         const FrameOptions& options)
    : device_(device),
      members_(members),
      options_(options),
      joined_(members.size() > 1 ? std::make_unique<SimulationModel>(members) : nullptr),
      joint_(joined_ ? joined_.get() : members.front()),
      solver_(device, *joint_, options.kernels, in_part()) {}

FrameGraphs::ModelsAt& FrameGraphs::models_at(std::uint32_t substeps) {
    ModelsAt& models = models_[substeps];
    if (!models.own.empty()) return models;
    std::vector<const SimulationModel*> all;
    for (const SimulationModel* const member : members_) {
        all.push_back(models.own.emplace_back(std::make_unique<SimulationModel>(*member, substeps)).get());
        models.own.back()->take_actions(*member);
    }
    if (joined_) models.joint = std::make_unique<SimulationModel>(all);
    return models;
}

void FrameGraphs::take_actions(std::size_t number) {
    for (auto& [substeps, models] : models_) models.own[number]->take_actions(*members_[number]);
}

const SimulationModel& FrameGraphs::joint_at(std::uint32_t substeps) {
    if (substeps == 0) return *joint_;
    const ModelsAt& models = models_at(substeps);
    return joined_ ? *models.joint : *models.own.front();
}

const SimulationModel& FrameGraphs::member_at(std::size_t number, std::uint32_t substeps) {
    return substeps == 0 ? *members_[number] : *models_at(substeps).own[number];
}

FrameContents FrameGraphs::contents(bool simulates, bool hands_out, bool first) const {
    // A closed loop judges every frame that it simulates, and hands out the same statistics.
    const bool wanted = joint_->closed_loop() && !first
                            ? simulates
                            : (hands_out && options_.statistics) || (simulates && options_.judges);
    return {.simulates = simulates, .hands_out = hands_out, .counts = wanted};
}

/// Returns the contents of graphs whose resources are all that this scene and these options ever need.
std::vector<FrameContents> FrameGraphs::known_contents() const {
    const SceneDescription& scene = joint_->scene;
    const bool closed = joint_->closed_loop(), cuts = !scene.cutters.empty();
    std::vector<FrameContents> all{contents(false, true, true), contents(true, false)};
    if (!in_part()) all.push_back(contents(true, true));  // under a closed loop this graph serves as a description only
    if (closed) all.push_back(contents(false, true));
    if (scene.comes_apart())
        for (FrameContents searched : std::vector(all)) {
            searched.cuts = cuts;
            searched.tears = scene.tears();
            all.push_back(searched);
        }
    for (const StateSet set : {StateSet::companion, StateSet::disturbed})
        if (has_set(*joint_, set)) all.push_back({.set = set, .simulates = true});
    // Graphs that are submitted have the constants of a model made for their number of substeps.
    if (in_part())
        for (FrameContents& contents : all)
            if (contents.simulates) contents.substeps = scene.solver.substeps;
    return all;
}

void FrameGraphs::plan_known() {
    planned_all_ = true;
    frames_.clear();
    steps_.clear();
    fit_raster();
    for (const FrameContents& contents : known_contents()) planned(contents);
    for (std::size_t k = 0; k < state_set_count; ++k)
        for (const auto set = static_cast<StateSet>(k); const StateStep step : state_steps(*joint_, set)) {
            PlannedGraph& around = steps_[{set, step}];
            solver_.declare(around.graph, {}, *joint_, set);
            solver_.add_attempt(around.graph, step);
            around.plan = graph::make_plan(around.graph);
        }
}

const PlannedGraph& FrameGraphs::planned(const FrameContents& contents) {
    const auto found = frames_.find(contents);
    if (found != frames_.end()) return found->second;
    return frames_[contents] = plan(contents);
}

void FrameGraphs::fit_raster() {
    if (options_.draw) raster_.fit(device_, joint_->scene, options_, solver_.layout().topologies);
}

PlannedGraph FrameGraphs::plan(const FrameContents& contents) {
    if (!raster_) fit_raster();
    PlannedGraph planned;
    graph::Graph& graph = planned.graph;
    const SimulationModel& run = joint_at(contents.substeps);
    const bool draws = contents.hands_out && (options_.draw || options_.normals);
    solver_.declare(graph, {.drawing = draws, .statistics = contents.counts}, run, contents.set);
    if (contents.simulates)
        solver_.add_simulation(graph);
    else if (contents.counts)
        solver_.add_forms(graph);
    if (contents.cuts) solver_.add_cuts(graph);
    if (contents.tears) solver_.add_tears(graph);
    note_skipped(graph, joint_->scene, options_, contents);
    if (contents.hands_out) add_hand_out(graph);
    if (contents.counts) solver_.add_statistics(graph);
    planned.plan = graph::make_plan(graph);
    return planned;
}

/// Adds the passes that make pictures and arrays of the state.
void FrameGraphs::add_hand_out(graph::Graph& graph) {
    if (options_.draw || options_.normals) solver_.add_normals(graph);
    if (options_.draw) raster_.add(graph, raster_cloths(*joint_, solver_.cloths()));
    if (body_count(*joint_) > 0) solver_.add_body_readback(graph);
    if (options_.normals) solver_.add_readback(graph, Field::normal, "normal");
    if (options_.positions) solver_.add_readback(graph, Field::position, "position");
    if (options_.fields) solver_.add_field_readback(graph);
    if (!options_.velocities) return;
    solver_.add_readback(graph, Field::displacement, "displacement");
    solver_.add_readback(graph, Field::end_excess, "excess displacement");
}

std::vector<std::pair<const graph::Graph*, const graph::Plan*>> FrameGraphs::plans() const {
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> all;
    for (const auto& [contents, planned] : frames_) all.emplace_back(&planned.graph, &planned.plan);
    for (const auto& [step, planned] : steps_) all.emplace_back(&planned.graph, &planned.plan);
    return all;
}

std::uint64_t FrameGraphs::bytes() {
    if (!planned_all_) plan_known();
    return graph::planned_bytes(plans());
}

void FrameGraphs::allocate() {
    if (!planned_all_) plan_known();
    pool_.reset();
    pool_ = std::make_unique<graph::ResourcePool>(device_, plans());
    upload_start(solver_.layout(), *pool_);
    raster_.upload(*pool_);
}

void FrameGraphs::rebuild(const SimulationState& state) {
    plan_known();
    allocate();
    upload_state(solver_.layout(), *pool_, state);
}

void FrameGraphs::draw_anew() {
    if (!options_.draw) return;
    fit_raster();
    std::erase_if(frames_, [](const auto& frame) { return frame.first.hands_out; });
    for (const FrameContents& contents : known_contents()) planned(contents);
}

VkCommandBuffer FrameGraphs::commands(PlannedGraph& planned, std::uint32_t slot) const {
    if (!planned.recorded)
        planned.recorded = std::make_unique<graph::RecordedPlan>(planned.graph, planned.plan, *pool_,
                                                                 options_.timestamps, options_.barrier_filter);
    return planned.recorded->commands(slot);
}

VkCommandBuffer FrameGraphs::commands(const FrameContents& contents, std::uint32_t slot) {
    planned(contents);
    return commands(frames_.at(contents), slot);
}

VkCommandBuffer FrameGraphs::commands(StateStep step, StateSet set, std::uint32_t slot) {
    return commands(steps_.at({set, step}), slot);
}

std::vector<StageTime> FrameGraphs::timings(const FrameContents& contents, std::uint32_t slot) const {
    std::vector<StageTime> all;
    const auto found = frames_.find(contents);
    if (found == frames_.end() || !found->second.recorded) return all;
    for (graph::Timing& timing : found->second.recorded->timings(slot))
        all.push_back({std::move(timing.name), timing.milliseconds});
    return all;
}

void check_room(const vulkan::Device& device, FrameGraphs& graphs, std::size_t count) {
    const std::uint64_t each = graphs.bytes() / graphs.member_count();
    const std::uint64_t room = device.budget().limit() - device.budget().used();
    if (each * count > room)
        throw vulkan::VulkanError(fmt::format("{} members need {} MiB, and the device has {} MiB left: {} fit", count,
                                              (each * count) >> 20, room >> 20, room / each));
}

}  // namespace drape
