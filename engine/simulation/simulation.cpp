#include "drape/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/byte_stream.h"
#include "cloth/cloth_statistics.h"
#include "cloth/members.h"
#include "cloth/momentum_causes.h"
#include "cloth/spring_tension.h"
#include "control/motion_watch.h"
#include "control/passage_watch.h"
#include "graph/dump.h"
#include "picture/frame_copy.h"
#include "picture/framing.h"
#include "picture/pictures.h"
#include "simulation/action_player.h"
#include "simulation/device_parts.h"
#include "simulation/frame_checks.h"
#include "simulation/frame_server.h"
#include "simulation/member_actions.h"
#include "simulation/member_state.h"
#include "simulation/scene_checks.h"
#include "simulation/state_checksum.h"
#include "solver/kernel_choice.h"

namespace drape {

namespace {

/// Indexed by Timings.
constexpr graph::TimestampMode timestamp_modes[] = {graph::TimestampMode::none, graph::TimestampMode::stages,
                                                    graph::TimestampMode::passes};

FrameOptions frame_options(const SceneDescription& scene, const SimulationOptions& wanted) {
    FrameOptions options;
    options.draw = wanted.draw || wanted.layers;
    options.color = wanted.draw;
    options.layers = wanted.layers;
    options.view = wanted.view;
    options.positions = wanted.positions;
    options.fields = wanted.positions && scene.force_fields;
    options.normals = wanted.normals;
    options.velocities = wanted.velocities;
    options.statistics = options.judges = wanted.statistics || wanted.velocities;
    options.kernels = wanted.kernels;
    options.timestamps = timestamp_modes[static_cast<std::size_t>(wanted.timings)];
    options.width = scene.image.size[0];
    options.height = scene.image.size[1];
    options.samples = scene.image.samples;
    // Layers alone have no picture to blur: they show the frame's own moment.
    if (options.color) options.motion_blur = scene.image.motion_blur;
    return options;
}

CutListener cut_listener(const std::function<void(const Cut&)>& on_cut) {
    if (!on_cut) return {};
    return [on_cut](const CutEvent& event, const CutTopology& topology) {
        const CutCounts& counts = event.counts;
        on_cut({event.frame, event.cloth, counts.springs, counts.triangles, counts.torn, counts.pieces, counts.crumbs,
                topology.whole_triangles(), spring_bits(topology)});
    };
}

constexpr const char* watch_part = "watch";
constexpr const char* passages_part = "passages";
constexpr const char* motion_part = "motion";
constexpr const char* told_part = "told";

/// Returns the scene with the actions, none so far, that its controls allow. Of pictures it has the camera that it
/// begins with: one that looked for what was told would jump.
SceneDescription told_scene(SceneDescription scene, const SimulationOptions& options) {
    if (!acts(options.controls)) return scene;
    if (scene.actions) throw Error("controls: the scene has actions of its own, and nothing else can be told");
    if (options.draw || options.layers) scene.camera = picture_camera(scene, scene.image.size[0], scene.image.size[1]);
    scene.actions = SceneActions{options.controls, {}};
    return scene;
}

template <class Kept>
std::vector<std::byte> written(Kept& kept) {
    ByteWriter writer;
    kept.transfer(writer);
    return writer.take();
}

/// Returns the contents of a part of a saved state. Throws Error where they do not belong to this model.
template <class Kept>
ByteReader checked_part(const SimulationState& state, const char* name, const SimulationModel& model) {
    const auto part = state.find(name);
    if (part == state.end())
        throw Error(fmt::format("the saved state is not of this scene: it has no part '{}'", name));
    ByteReader reader(part->second);
    if (!Kept(model).transfer(reader) || reader.left() > 0)
        throw Error(fmt::format("the saved state is not of this scene: its part '{}' is of something else", name));
    return ByteReader(part->second);
}

}  // namespace

struct Simulation::Parts {
    Parts(const SceneDescription& scene, const SimulationOptions& options, const Device& given)
        : device(given),
          wanted(options),
          model(modelled(told_scene(scene, options), options, given)),
          player(model.scene.actions ? std::make_unique<ActionPlayer>(model, acts(options.controls)) : nullptr),
          watch(model),
          passages(model),
          motion(model),
          asked(frame_options(scene, options)) {}

    static SimulationModel modelled(const SceneDescription& scene, const SimulationOptions& options,
                                    const Device& given) {
        const EnsembleControls controls = controls_of(scene);
        return SimulationModel(able_to_move(checked_scene(scene), controls),
                               controlled({.skip = options.skip, .device = device_kind(given.info())}, controls));
    }

    /// Makes the scene the only member of a server, and prepares the pictures if another device draws them.
    void serve_alone() {
        // What moves by itself is drawn once it is known where, and what is blurred once it is known how fast, on the
        // same device if there is no other.
        Device::Parts* drawing = asked.draw ? device.parts_->drawing.get() : nullptr;
        if (asked.draw && !drawing && (body_count(model) > 0 || player || asked.motion_blur > 1))
            drawing = device.parts_.get();
        server = std::make_shared<FrameServer>(device.parts_->device, model, drawing ? beside_pictures() : asked,
                                               listener(drawing != nullptr));
        if (drawing) pictures = std::make_unique<Pictures>(drawing->device, shown_model(), asked);
    }

    /// Returns the model of which pictures are drawn: where actions move things, it knows where these are in any frame.
    const SimulationModel& shown_model() {
        if (!player) return model;
        shown = std::make_unique<SimulationModel>(model);
        shown->scene = player->shown();
        return *shown;
    }

    /// Has pictures show where things are that were told to go elsewhere: pictures keep the paths that pins and
    /// colliders had when they were made.
    void show_what_was_told(const Pictures::Finished& take) {
        if (!player->is_told() || !(wanted.controls.pins || wanted.controls.colliders)) return;
        pictures->flush(take);
        const vulkan::Device& drawing = device.parts_->drawing ? device.parts_->drawing->device : device.parts_->device;
        pictures.reset();
        pictures = std::make_unique<Pictures>(drawing, shown_model(), asked);
        pictures->follow(topologies());
    }

    /// Puts into the models what the scene is told for the step to a frame.
    void act_on(std::uint32_t frame) {
        const bool told = player->put(frame);
        server->graphs().take_actions(number);
        if (told) run().pilot().wake();
    }

    RunListener listener(bool draws_beside) {
        RunListener all{.keep_promises = wanted.keep_promises,
                        .on_cut = cut_listener(wanted.on_cut),
                        .on_attempt = wanted.on_attempt};
        if (player) all.on_begin = [this](std::uint32_t frame) { act_on(frame); };
        if (asked.judges) all.on_passed_over = [this](const FinishedFrame& frame) { judge(frame); };
        if (draws_beside)
            all.on_cut = [this, own = all.on_cut](const CutEvent& event, const CutTopology& topology) {
                pictures->follow(topologies());
                if (own) own(event, topology);
            };
        return all;
    }

    /// Returns the options of the server whose frames are drawn by `pictures`.
    FrameOptions beside_pictures() {
        FrameOptions options = asked;
        options.draw = false;
        options.draws_beside = options.positions = true;
        if (options.motion_blur > 1) options.velocities = options.statistics = options.judges = true;
        options.meanwhile = [this] {
            if (give) pictures->go_on(give);
        };
        return options;
    }

    /// Returns the frame's failure, or throws it, as the options say.
    std::optional<FrameFailure> judge(const FinishedFrame& frame) {
        motion.look(frame.frame, frame.effort);
        const std::uint32_t substeps = frame.effort.substeps;
        if (!frame.statistics.empty())
            passages.look(frame.frame, substeps > 0 ? substeps : model.scene.solver.substeps, frame.statistics);
        std::optional<FrameFailure> found = frame_failure(model, watch, frame);
        if (!found) return found;
        if (wanted.keep_promises) raise(*found);
        const auto diverged = [](const FrameFailure& each) { return each.kind == FrameFailure::Kind::not_finite; };
        if (!failure || (diverged(*found) && !diverged(*failure))) failure = found;
        return diverged(*found) ? failure : found;
    }

    /// Returns a request whose frames are judged before `take` receives them.
    FrameRequest judged(const FrameRequest& request, const std::function<void(const FinishedFrame&)>& take) {
        FrameRequest all = request;
        all.finished = [this, take](const FinishedFrame& frame) {
            const auto found = judge(frame);
            if (!found) return take(frame);
            FinishedFrame failed = frame;
            failed.failure = found;
            take(failed);
        };
        return all;
    }

    bool is_alone() const { return server->size() == 1; }
    MemberRun& run() { return server->member(number); }
    std::vector<CutTopology>& topologies() { return server->graphs().layout().topologies; }
    /// Returns the graphs of this scene alone.
    FrameGraphs& graphs() {
        if (is_alone()) return server->graphs();
        if (!own_graphs)
            own_graphs = std::make_unique<FrameGraphs>(device.parts_->device,
                                                       std::vector<const SimulationModel*>{&model}, asked);
        return *own_graphs;
    }

    struct Planned {
        const graph::Graph& graph;
        const graph::Plan& plan;
    };
    /// Returns the graphs of a frame that is handed out: one, or one on each of two devices.
    std::vector<Planned> output() {
        FrameContents contents = graphs().contents(true, true);
        contents.tears = model.scene.tears();
        contents.cuts = contents.tears && !model.scene.cutters.empty();
        const PlannedGraph& own = graphs().planned(contents);
        std::vector<Planned> all{{own.graph, own.plan}};
        if (pictures) all.push_back({pictures->graph(), pictures->plan()});
        return all;
    }

    Device device;
    SimulationOptions wanted;
    SimulationModel model;
    std::unique_ptr<ActionPlayer> player;    ///< null: the scene has no actions
    std::unique_ptr<SimulationModel> shown;  ///< of pictures, beside a player
    Watch watch;
    std::optional<FrameFailure> failure;  ///< of the first frame that failed, whether it was handed out or not
    PassageWatch passages;
    MotionWatch motion;
    FrameOptions asked;
    std::shared_ptr<FrameServer> server;
    std::size_t number = 0;                   ///< among the members of the server
    std::unique_ptr<FrameGraphs> own_graphs;  ///< describes the scene alone, if the server has other members too
    std::unique_ptr<Pictures> pictures;       ///< draws pictures if another device does so
    Pictures::Finished give;                  ///< passes finished pictures to the caller during `run`
    FrameCopy kept;
};

Simulation::Simulation(const SceneDescription& scene, const SimulationOptions& options, const Device& device)
    : Simulation(std::make_unique<Parts>(scene, options, device)) {
    parts_->serve_alone();
}
Simulation::Simulation(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

std::vector<Simulation> Simulation::together(const std::vector<SceneDescription>& scenes,
                                             const std::vector<SimulationOptions>& options, const Device& device) {
    std::vector<Simulation> all;
    std::vector<const SimulationModel*> models;
    std::vector<RunListener> listeners;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        if (const auto found = shape_difference(scenes.front(), scenes[k]))
            throw Error("scenes of unlike shape cannot go on together: " + *found);
        Parts& parts = *all.emplace_back(Simulation(std::make_unique<Parts>(scenes[k], options[k], device))).parts_;
        if (const auto obstacle = sharing_obstacle(parts.model))
            throw Error("these scenes cannot go on together: " + *obstacle);
        models.push_back(&parts.model);
        if (parts.model.scene.solver.method != models.front()->scene.solver.method)
            throw Error("scenes for which method auto chooses unlike methods cannot go on together");
        parts.number = k;
        listeners.push_back(parts.listener(false));
    }
    FrameOptions asked = all.front().parts_->asked;
    asked.draw = false;
    asked.timestamps = graph::TimestampMode::none;
    const auto server = std::make_shared<FrameServer>(device.parts_->device, models, asked, listeners);
    check_room(device.parts_->device, server->graphs(), scenes.size());
    server->graphs().allocate();
    for (Simulation& each : all) each.parts_->server = server;
    return all;
}

std::vector<RequestEnd> Simulation::run_together(std::span<Simulation> simulations,
                                                 std::span<const FrameRequest> requests) {
    FrameServer& server = *simulations.front().parts_->server;
    if (simulations.size() != server.size() || requests.size() != server.size())
        throw Error("all simulations that were made together go on together");
    for (std::size_t k = 0; k < simulations.size(); ++k)
        server.ask(k, simulations[k].parts_->judged(requests[k], requests[k].finished));
    server.serve();
    std::vector<RequestEnd> ends;
    for (std::size_t k = 0; k < simulations.size(); ++k)
        ends.push_back({server.member(k).complete(), server.failure(k)});
    return ends;
}

bool Simulation::step() {
    const std::uint32_t next = next_frame();
    if (next >= parts_->model.scene.time.frame_count) return false;
    return run(
        next, [](std::uint32_t) { return true; }, [this](const FinishedFrame& frame) { parts_->kept.keep(frame); });
}

const FinishedFrame& Simulation::frame() const { return parts_->kept.frame(); }

bool Simulation::run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
                     const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop) {
    if (!parts_->is_alone()) throw Error("all simulations that were made together go on together");
    const std::unique_ptr<Pictures>& pictures = parts_->pictures;
    bool giving = false;  // while true, an exception comes from the caller's own function
    const auto give = [&](const FinishedFrame& frame) {
        giving = true;
        finished(frame);
        giving = false;
    };
    struct Given {
        Pictures::Finished& give;
        ~Given() { give = nullptr; }
    } const given{parts_->give};
    given.give = give;
    const auto hand_out = [&](const FinishedFrame& frame) {
        if (!pictures) return finished(frame);
        if (parts_->player) parts_->show_what_was_told(give);
        pictures->draw(frame, give);
    };
    try {
        parts_->server->ask(0, parts_->judged({last, wanted, finished, stop}, hand_out));
        parts_->server->serve();
        if (pictures) pictures->flush(give);
        return parts_->run().complete();
    } catch (const FrameError&) {  // the frames before the failed one are handed out
        if (pictures && !giving) pictures->flush(give);
        throw;
    }
}

void Simulation::act(const EnsembleActions& actions) {
    if (!acts(parts_->wanted.controls)) throw ActionError("actions: made without controls: ask for them", 0);
    parts_->player->tell(actions, std::max<std::uint32_t>(1, next_frame()));
}

SceneActions Simulation::recorded() const {
    if (!parts_->player) throw Error("nothing is recorded: the scene is told nothing");
    return *parts_->model.scene.actions;
}

std::uint32_t Simulation::next_frame() const { return parts_->run().next_frame(); }
bool Simulation::can_save() const { return parts_->is_alone() && parts_->run().can_save(); }

SimulationState Simulation::save() const {
    if (!can_save())
        throw Error(
            fmt::format("frame {} cannot be saved: method auto has begun a probe, whose frames are kept or done "
                        "again together (can_save)",
                        next_frame() - 1));
    SimulationState state = saved_state(*parts_->server, 0);
    state[watch_part] = written(parts_->watch);
    state[passages_part] = written(parts_->passages);
    state[motion_part] = written(parts_->motion);
    if (parts_->player && parts_->player->is_told()) {
        ByteWriter told;
        std::vector<FrameActions> steps = parts_->player->steps();
        transfer_actions(told, steps);
        state[told_part] = told.take();
    }
    seal(state);
    return state;
}

void Simulation::restore(const SimulationState& state) {
    expect_sealed(state);
    ByteReader watch = checked_part<Watch>(state, watch_part, parts_->model);
    ByteReader passages = checked_part<PassageWatch>(state, passages_part, parts_->model);
    ByteReader motion = checked_part<MotionWatch>(state, motion_part, parts_->model);
    if (!parts_->is_alone()) throw Error("simulations that were made together cannot be restored");
    std::vector<FrameActions> steps;
    const bool is_told = parts_->player && parts_->player->is_told();
    if (is_told) {
        const auto part = state.find(told_part);
        if (part == state.end()) throw Error("the saved state is of a simulation that was told nothing");
        ByteReader told(part->second);
        transfer_actions(told, steps);
    }
    const std::size_t only = 0;
    if (is_told) parts_->player->take(std::move(steps));
    if (parts_->player) parts_->player->put(0);
    restore_states(*parts_->server, std::span(&only, 1), std::span(&state, 1));
    parts_->watch.transfer(watch);
    parts_->passages.transfer(passages);
    parts_->motion.transfer(motion);
    if (parts_->pictures) parts_->pictures->follow(parts_->topologies());
}

const SceneDescription& Simulation::scene() const {
    return parts_->player ? parts_->player->shown() : parts_->model.scene;
}

std::vector<std::uint32_t> Simulation::triangles(std::size_t cloth) const {
    if (!parts_->is_alone()) return CutTopology(parts_->model.cloths[cloth]).whole_triangles();
    return parts_->topologies()[cloth].whole_triangles();
}

std::vector<std::uint8_t> Simulation::spring_bits(std::size_t cloth) const {
    if (!parts_->is_alone()) return drape::spring_bits(CutTopology(parts_->model.cloths[cloth]));
    return drape::spring_bits(parts_->topologies()[cloth]);
}

SimulationFacts Simulation::facts() const {
    const SimulationModel& model = parts_->model;
    FrameGraphs& graphs = parts_->graphs();
    const graph::Plan& simulate = graphs.planned(graphs.contents(true, false)).plan;
    SimulationFacts facts{.method = std::string(model.method().name),
                          .kernels = used_kernels(model, graphs.layout().kernels).text(),
                          .asked_method = std::string(named(model.asked_method).name),
                          .choice_reason = model.choice.reason,
                          .tolerance = model.asked_tolerance,
                          .tolerance_rms = model.stretch_limits().rms,
                          .tolerance_worst = model.stretch_limits().worst,
                          .limits_are_kept = model.closed_loop(),
                          .skipped = {},
                          .compromises = model.compromises(),
                          .pass_count = 0,
                          .barrier_count = 0,
                          .simulated_pass_count = simulate.passes.size(),
                          .simulated_barrier_count = graph::barrier_count(simulate)};
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        facts.momenta.push_back(momentum_causes(model, cloth));
    for (const Parts::Planned& output : parts_->output()) {
        facts.pass_count += output.plan.passes.size();
        facts.barrier_count += graph::barrier_count(output.plan);
        const std::vector<SimulationFacts::Skipped> before =
            facts.skipped;  // both graphs list the same skipped work of the scene
        for (const graph::Remark& skipped : output.plan.skipped)
            if (std::ranges::find(before, skipped.what, &SimulationFacts::Skipped::what) == before.end())
                facts.skipped.push_back({skipped.what, skipped.reason});
    }
    return facts;
}

std::optional<SelfContactReport> Simulation::self_contact() const { return parts_->run().self_contact(); }

RunVerdict Simulation::verdict() const {
    RunVerdict all{parts_->failure, parts_->watch.worst_rms(), parts_->watch.worst_max(), parts_->watch.warnings(), {}};
    std::ranges::move(parts_->motion.warnings(), std::back_inserter(all.warnings));
    if (const auto note = parts_->motion.note()) all.notes.push_back(*note);
    return all;
}

std::optional<std::string> Simulation::possible_passage() const { return parts_->passages.text(); }

std::vector<PassWork> Simulation::work() const {
    std::vector<PassWork> all;
    for (const auto& [graph, plan] : parts_->output())
        for (const graph::PlannedPass& planned : plan.passes) {
            const graph::Pass& pass = graph.passes()[planned.pass];
            auto found = std::ranges::find(all, pass.label, &PassWork::name);
            if (found == all.end()) found = all.insert(all.end(), {pass.label, pass.stage, 0, 0, 0});
            ++found->count;
            found->flops += pass.flops;
            for (const graph::Use& use : pass.uses)
                found->bytes += graph.resources()[use.handle.resource].byte_count(use.handle);
        }
    return all;
}

std::vector<ResourceMemory> Simulation::memory() const {
    std::vector<ResourceMemory> all;
    for (const auto& [graph, plan] : parts_->output())
        for (std::size_t index = 0; index < graph.resources().size(); ++index) {
            const graph::Resource& resource = graph.resources()[index];
            if (plan.lifespans[index].used())
                all.push_back({resource.name, resource.byte_count() * graph::copy_count(resource)});
        }
    std::ranges::stable_sort(all, std::ranges::greater(), &ResourceMemory::bytes);
    return all;
}

std::string Simulation::describe_plan(const std::string& format) const {
    std::string text;
    for (const auto& [graph, plan] : parts_->output()) text += graph::dump(graph, plan, format);
    return text;
}

}  // namespace drape
