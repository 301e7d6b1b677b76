#include "drape/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "base/byte_stream.h"
#include "cloth/cloth_statistics.h"
#include "cloth/together.h"
#include "control/passage_watch.h"
#include "graph/dump.h"
#include "picture/frame_copy.h"
#include "picture/pictures.h"
#include "simulation/device_parts.h"
#include "simulation/ensemble_run.h"
#include "simulation/frame_checks.h"
#include "simulation/frame_loop.h"
#include "simulation/scene_checks.h"
#include "solver/copy_bandwidth.h"
#include "solver/kernel_choice.h"

namespace drape {

Device::Device(const std::string& selector, Validation validation)
    : parts_(std::make_shared<Parts>(selector, validation)) {}

bool prefers_calling_thread(const SceneDescription& scene) {
    const std::uint64_t most_particles = cloths_meet(scene) ? 85 * 85 : 72 * 72;
    const auto is_small = [&](std::size_t cloth, std::size_t count) {
        const auto [columns, rows] = scene.cloths[cloth].grid;
        return std::uint64_t{columns} * rows * count <= most_particles;
    };
    bool small = true;
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) small = small && is_small(cloth, 1);
    for (const std::vector<std::size_t>& list : cloths_alike(scene)) small = small && is_small(list[0], list.size());
    return small;
}

Device Device::for_scene(const SceneDescription& scene, bool draws, const std::string& selector,
                         Validation validation) {
    constexpr const char* variable = "LP_NUM_THREADS";  // lavapipe reads it when a device is looked for
    if (std::getenv(variable)) return Device(selector, validation);
    if (prefers_calling_thread(scene)) setenv(variable, "0", 0);
    std::optional<Device> device;
    try {
        device.emplace(selector, validation);
    } catch (...) {
        unsetenv(variable);
        throw;
    }
    unsetenv(variable);
    if (draws && device_kind(device->info()) == DeviceKind::cpu)
        device->parts_->drawing = std::make_unique<Parts>(device->info().uuid_text(), validation);
    return *device;
}

std::vector<DeviceInfo> Device::list() { return vulkan::Instance({}).devices(); }
const DeviceInfo& Device::info() const { return parts_->device.info(); }

std::uint64_t Device::validation_count() const {
    const std::uint64_t own = parts_->instance.validation_log().count();
    return parts_->drawing ? own + parts_->drawing->instance.validation_log().count() : own;
}

std::uint64_t Device::memory_used() const {
    const std::uint64_t own = parts_->device.budget().used();
    return parts_->drawing ? own + parts_->drawing->device.budget().used() : own;
}

std::uint64_t Device::memory_limit() const { return parts_->device.budget().limit(); }
double Device::copy_bandwidth() const { return drape::copy_bandwidth(parts_->device, copy_ruler(parts_->device)); }

namespace {

/// Timings index this.
constexpr graph::TimestampMode timestamp_modes[] = {graph::TimestampMode::none, graph::TimestampMode::stages,
                                                    graph::TimestampMode::passes};

FrameLoopOptions loop_options(const SceneDescription& scene, const SimulationOptions& wanted) {
    FrameLoopOptions options;
    options.draw = wanted.draw;
    options.view = wanted.view;
    options.positions = wanted.positions;
    options.normals = wanted.normals;
    options.velocities = wanted.velocities;
    options.statistics = wanted.statistics || wanted.velocities;
    options.keep_promises = wanted.keep_promises;
    options.on_attempt = wanted.on_attempt;
    options.kernels = wanted.kernels;
    options.timestamps = timestamp_modes[static_cast<std::size_t>(wanted.timings)];
    options.width = scene.image.size[0];
    options.height = scene.image.size[1];
    options.samples = scene.image.samples;
    if (wanted.on_cut)
        options.on_cut = [on_cut = wanted.on_cut](const CutEvent& event, const CutTopology& topology) {
            const CutCounts& counts = event.counts;
            on_cut({event.frame, event.cloth, counts.springs, counts.triangles, counts.torn, counts.pieces,
                    counts.crumbs, topology.whole_triangles()});
        };
    return options;
}

constexpr const char* watch_part = "watch";
constexpr const char* passages_part = "passages";

template <class Kept>
std::vector<std::byte> written(Kept& kept) {
    ByteWriter writer;
    kept.transfer(writer);
    return writer.take();
}

/// Returns what a part of a saved state holds. Throws Error where it is not one of this model.
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
          member(options.member),
          keep_promises(options.keep_promises),
          model(scene, {.skip = options.skip, .device = device_kind(given.info())}),
          watch(model),
          passages(model),
          asked(taking_part(judging(loop_options(scene, options)))),
          loop(given.parts_->device, model, given.parts_->drawing && asked.draw ? beside_pictures() : asked) {
        if (given.parts_->drawing && asked.draw)
            pictures = std::make_unique<Pictures>(given.parts_->drawing->device, model, asked);
    }

    FrameLoopOptions judging(FrameLoopOptions options) {
        if (options.statistics) options.on_passed_over = [this](const FinishedFrame& frame) { judge(frame); };
        return options;
    }

    FrameLoopOptions taking_part(FrameLoopOptions options) const {
        if (member) member->run->parts_->join(member->number, options);
        return options;
    }

    /// Returns the frame's failure, or throws it.
    std::optional<FrameFailure> judge(const FinishedFrame& frame) {
        const std::uint32_t substeps = frame.effort.substeps;
        if (!frame.statistics.empty())
            passages.look(frame.frame, substeps > 0 ? substeps : model.scene.solver.substeps, frame.statistics);
        std::optional<FrameFailure> found = frame_failure(model, watch, frame);
        if (!found) return found;
        if (keep_promises) raise(*found);
        const auto diverged = [](const FrameFailure& each) { return each.kind == FrameFailure::Kind::not_finite; };
        if (!failure || (diverged(*found) && !diverged(*failure))) failure = found;
        return diverged(*found) ? failure : found;
    }

    /// Returns the options of the loop whose frames `pictures` draws.
    FrameLoopOptions beside_pictures() {
        FrameLoopOptions options = asked;
        options.draw = false;
        options.draws_beside = options.positions = true;
        options.meanwhile = [this] {
            if (give) pictures->go_on(give);
        };
        options.on_cut = [this](const CutEvent& event, const CutTopology& topology) {
            pictures->follow(loop.topologies());
            if (asked.on_cut) asked.on_cut(event, topology);
        };
        return options;
    }

    struct Planned {
        const graph::Graph& graph;
        const graph::Plan& plan;
    };
    /// Returns what a frame takes that is handed out: one graph, or two, one per device.
    std::vector<Planned> output() const {
        const FrameKind kind =
            model.scene.tears() ? FrameKind::simulate_and_output_cut : FrameKind::simulate_and_output;
        std::vector<Planned> all{{loop.graph(kind), loop.plan(kind)}};
        if (pictures) all.push_back({pictures->graph(), pictures->plan()});
        return all;
    }

    Device device;
    std::optional<EnsembleMember> member;  ///< outlives the loop, whose frames it shares
    bool keep_promises;
    SimulationModel model;
    Watch watch;
    std::optional<FrameFailure> failure;  ///< the first of any frame, handed out or not
    PassageWatch passages;
    FrameLoopOptions asked;
    FrameLoop loop;
    std::unique_ptr<Pictures> pictures;  ///< draws pictures where they have a device of their own
    Pictures::Finished give;             ///< gives to the caller, while one runs the simulation
    FrameCopy kept;
};

Simulation::Simulation(const SceneDescription& scene, const SimulationOptions& options, const Device& device)
    : parts_(std::make_unique<Parts>(checked_scene(scene), options, device)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

bool Simulation::step() {
    const std::uint32_t next = parts_->loop.next_frame();
    if (next >= parts_->model.scene.time.frame_count) return false;
    return run(
        next, [](std::uint32_t) { return true; }, [this](const FinishedFrame& frame) { parts_->kept.keep(frame); });
}

const FinishedFrame& Simulation::frame() const { return parts_->kept.frame(); }

bool Simulation::run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
                     const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop) {
    Pictures* const pictures = parts_->pictures.get();
    bool giving = false;  // a throw is then the caller's own
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
        return pictures ? pictures->draw(frame, give) : finished(frame);
    };
    const auto checked = [&](const FinishedFrame& frame) {
        const auto failure = parts_->judge(frame);
        if (!failure) return hand_out(frame);
        FinishedFrame failed = frame;
        failed.failure = failure;
        hand_out(failed);
    };
    try {
        const bool complete = parts_->loop.run(last, wanted, checked, stop);
        if (pictures) pictures->flush(give);
        return complete;
    } catch (const FrameError&) {  // frames before it are handed out
        if (pictures && !giving) pictures->flush(give);
        throw;
    }
}

std::uint32_t Simulation::next_frame() const { return parts_->loop.next_frame(); }
bool Simulation::can_save() const { return parts_->loop.can_save(); }

SimulationState Simulation::save() const {
    if (!can_save())
        throw Error(
            fmt::format("frame {} cannot be saved: method auto has begun a probe, whose frames are kept or done "
                        "again together (can_save)",
                        next_frame() - 1));
    SimulationState state = parts_->loop.save();
    state[watch_part] = written(parts_->watch);
    state[passages_part] = written(parts_->passages);
    return state;
}

void Simulation::restore(const SimulationState& state) {
    ByteReader watch = checked_part<Watch>(state, watch_part, parts_->model);
    ByteReader passages = checked_part<PassageWatch>(state, passages_part, parts_->model);
    parts_->loop.restore(state);
    parts_->watch.transfer(watch);
    parts_->passages.transfer(passages);
    if (parts_->pictures) parts_->pictures->follow(parts_->loop.topologies());
}

const SceneDescription& Simulation::scene() const { return parts_->model.scene; }

std::vector<std::uint32_t> Simulation::triangles(std::size_t cloth) const {
    return parts_->loop.whole_triangles(cloth);
}

SimulationFacts Simulation::facts() const {
    const SimulationModel& model = parts_->model;
    const graph::Plan& simulate = parts_->loop.plan(FrameKind::simulate);
    SimulationFacts facts{.method = std::string(model.method().name),
                          .kernels = used_kernels(model, parts_->loop.kernels()).text(),
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
    for (const Parts::Planned& output : parts_->output()) {
        facts.pass_count += output.plan.passes.size();
        facts.barrier_count += graph::barrier_count(output.plan);
        const std::vector<SimulationFacts::Skipped> before = facts.skipped;  // both graphs say what the scene lacks
        for (const graph::Remark& skipped : output.plan.skipped)
            if (std::ranges::find(before, skipped.what, &SimulationFacts::Skipped::what) == before.end())
                facts.skipped.push_back({skipped.what, skipped.reason});
    }
    return facts;
}

std::optional<SelfContactReport> Simulation::self_contact() const { return parts_->loop.self_contact(); }

RunVerdict Simulation::verdict() const {
    return {parts_->failure, parts_->watch.worst_rms(), parts_->watch.worst_max(), parts_->watch.warnings()};
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
