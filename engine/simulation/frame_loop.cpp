#include "simulation/frame_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cloth/tear.h"
#include "simulation/contact_report.h"
#include "solver/cut_pass.h"
#include "solver/readback_pass.h"
#include "solver/tear_pass.h"
#include "world/weather.h"

namespace drape {

FrameLoop::FrameLoop(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options)
    : device_(device),
      model_(model),
      options_(options),
      solver_(device, model_, options.kernels),
      watch_(model),
      sleep_(model),
      drive_(model),
      self_contact_(starting_report(model)),
      state_substeps_(model.scene.solver.substeps),
      position_error_(model),
      sensitivity_(model),
      slots_(device) {
    beside_substeps_.assign(state_set_count, state_substeps_);
    if (model_.closed_loop())
        control_.emplace(row_of(model_.scene.solver.method), model_.scene.solver.substeps, model_.choice.least_substeps,
                         probe_length(model_));
    if (options_.plans) build_graphs();
    if (options_.lane || options_.next_elsewhere) return;
    allocate_and_record();
    upload();
}

void FrameLoop::upload() {
    solver_.upload(*pool_);
    if (raster_) raster_->upload(*pool_);
}

std::vector<FrameKind> FrameLoop::kinds() const {
    using enum FrameKind;
    std::vector<FrameKind> all{initial, simulate, simulate_and_output};
    const bool cuts = model_.scene.comes_apart(), closed = model_.closed_loop();
    if (!model_.scene.cutters.empty()) all.push_back(initial_cut);
    if (cuts && !closed) all.push_back(simulate_cut);
    if (cuts && (!closed || model_.scene.tears())) all.push_back(simulate_and_output_cut);  // `drape graph` shows it
    if (closed) all.push_back(output);
    if (cuts && closed) all.insert(all.end(), {output_cut, search_cut});
    return all;
}

void FrameLoop::build_graphs() {
    frames_ = {};
    if (options_.draw) raster_.fit(device_, model_.scene, options_, solver_.topologies());
    for (const FrameKind kind : kinds()) frames_[static_cast<std::size_t>(kind)] = build(kind, model_);
}

void FrameLoop::allocate_and_record() {
    rungs_ = {};
    build_attempts();
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans;
    for (const FrameKind kind : kinds()) {
        const Frame& frame = frames_[static_cast<std::size_t>(kind)];
        plans.emplace_back(&frame.graph, &frame.plan);
    }
    for_each_attempt([&](Frame& frame) { plans.emplace_back(&frame.graph, &frame.plan); });
    std::array<Frame, state_set_count> beside;  // their resources are those of every rung
    for (const StateSet set : {StateSet::companion, StateSet::disturbed})
        if (Frame& frame = beside[static_cast<std::size_t>(set)]; has_set(set)) {
            frame = build_beside(model_, set);
            plans.emplace_back(&frame.graph, &frame.plan);
        }
    pool_.reset();
    pool_ = std::make_unique<graph::ResourcePool>(device_, plans);
    record();
}

void FrameLoop::record() {
    for (const FrameKind kind : kinds()) {
        // The rungs record what a closed loop simulates.
        if (model_.closed_loop() && contents(kind).simulates) continue;
        Frame& frame = frames_[static_cast<std::size_t>(kind)];
        frame.recorded = recording(frame);
    }
    for_each_attempt([&](Frame& frame) {
        if (!frame.recorded) frame.recorded = recording(frame);
    });
}

std::unique_ptr<graph::RecordedPlan> FrameLoop::recording(const Frame& frame) const {
    return std::make_unique<graph::RecordedPlan>(frame.graph, frame.plan, *pool_, options_.timestamps,
                                                 options_.barrier_filter);
}

bool FrameLoop::cutters_active_in(std::uint32_t frame) const {
    const double fps = model_.scene.time.fps;
    return cutters_active(model_.scene.cutters, frame == 0 ? 0 : (frame - 1) / fps, frame / fps);
}

bool FrameLoop::searched(std::uint32_t frame) const {
    return (frame > 0 && model_.scene.tears()) || cutters_active_in(frame);
}

CutCounts FrameLoop::take_findings(std::size_t cloth, const CutFindings& cut, const std::vector<glsl::vec4>& loads) {
    CutTopology& topology = solver_.topologies()[cloth];
    CutCounts counts;
    if (!cut.fractions.empty()) counts = topology.apply(cut);
    if (loads.empty()) return counts;
    const CutCounts torn = topology.apply(torn_springs(topology, loads));
    if (torn.any()) sleep_.wake();
    return {counts.springs + torn.springs, counts.triangles + torn.triangles, torn.springs,
            torn.any() ? torn.pieces : counts.pieces, torn.any() ? torn.crumbs : counts.crumbs};
}

void FrameLoop::take_cuts(std::uint32_t slot, std::uint32_t frame) {
    struct Hit {
        std::size_t cloth;
        CutFindings cut;
        std::vector<glsl::vec4> loads;
        CutImages before;
    };
    const auto found = [&](const std::string& count_name) {
        std::uint32_t count = 0;
        if (pool_->has(count_name)) std::memcpy(&count, pool_->buffer(count_name, slot).mapped().data(), sizeof count);
        return count > 0;
    };
    std::vector<Hit> hits;  // they are fetched before any resource changes
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const ClothModel& model = model_.cloths[cloth];
        const bool crossed = found(cut_count_name(model)), overloaded = frame > 0 && found(tear_count_name(model));
        if (!crossed && !overloaded) continue;
        solver_.topologies()[cloth].set_stiffness(
            static_cast<float>(stiffness_factor(model_.scene, model_.scene.cloths[cloth], frame)));
        Hit& hit = hits.emplace_back(Hit{cloth, {}, {}, solver_.cut_images(cloth)});
        if (crossed) hit.cut = read_findings(*pool_, model);
        if (overloaded) hit.loads = read_tear_loads(*pool_, model);
    }
    bool new_resources = false;
    for (const Hit& hit : hits) {
        CutTopology& topology = solver_.topologies()[hit.cloth];
        new_resources = new_resources || !topology.masked();
        const CutCounts counts = take_findings(hit.cloth, hit.cut, hit.loads);
        new_resources = new_resources || (options_.draw && draws_outgrown(hit.before, topology));
        if (options_.on_cut) options_.on_cut({frame, hit.cloth, counts}, topology);
    }
    if (new_resources) return rebuild_resources(solver_.download_state(*pool_));
    for (const Hit& hit : hits) solver_.upload_cut(*pool_, hit.cloth, hit.before);
    if (hits.empty() || !options_.draw) return;
    build_graphs();  // the recording says how much is drawn
    record();
}

void FrameLoop::rebuild_resources(const SimulationState& state) {
    for (Frame& frame : frames_) frame.recorded.reset();
    rungs_ = {};
    attempts_ = {};
    build_graphs();
    allocate_and_record();
    upload();
    solver_.upload_state(*pool_, state);
}

FrameNeeds FrameLoop::needs(FrameKind kind) const {
    const FrameContents& has = contents(kind);
    // A closed loop judges what it simulates, and hands that out.
    const bool judged =
        model_.closed_loop() && (has.simulates || kind == FrameKind::output || kind == FrameKind::output_cut);
    return {.drawing = has.hands_out && (options_.draw || options_.normals),
            .statistics = judged
                              ? has.simulates
                              : (has.hands_out && options_.statistics) || (has.simulates && options_.on_passed_over)};
}

FrameLoop::Frame FrameLoop::build(FrameKind kind, const SimulationModel& run) {
    Frame frame;
    const FrameContents& has = contents(kind);
    const FrameNeeds wanted = needs(kind);
    solver_.declare(frame.graph, wanted, run);
    if (has.simulates)
        solver_.add_simulation(frame.graph);
    else if (wanted.statistics)
        solver_.add_forms(frame.graph);
    const bool cuts = has.searches_cuts && !model_.scene.cutters.empty();
    const bool tears = has.searches_cuts && model_.scene.tears() && kind != FrameKind::initial_cut;
    if (cuts) solver_.add_cuts(frame.graph);
    if (tears) solver_.add_tears(frame.graph);
    if (!cuts)
        frame.graph.skip("cut search", model_.scene.cutters.empty() ? "no cutter in the scene"
                                                                    : "no cutter is active in this kind of frame");
    if (!tears)
        frame.graph.skip("tear search",
                         model_.scene.tears() ? "nothing tears in this kind of frame" : "no cloth of the scene tears");
    if (has.hands_out && (options_.draw || options_.normals)) solver_.add_normals(frame.graph);
    if (has.hands_out && options_.draw)
        raster_->add(frame.graph, raster_cloths(model_, solver_.cloths()));
    else if (!options_.draw && !options_.draws_beside)
        frame.graph.skip(options_.normals ? "raster and colour readback" : "normals, raster and colour readback",
                         "no picture is wanted");
    if (has.hands_out && options_.normals) solver_.add_readback(frame.graph, Field::normal, "normal");
    if (has.hands_out && options_.positions) {
        solver_.add_readback(frame.graph, Field::position, "position");
    } else if (!options_.positions) {
        frame.graph.skip("position readback", "no position export is wanted");
    }
    if (has.hands_out && options_.velocities) {
        solver_.add_readback(frame.graph, Field::displacement, "displacement");
        solver_.add_readback(frame.graph, Field::end_excess, "excess displacement");
    }
    if (wanted.statistics)
        solver_.add_statistics(frame.graph);
    else if (!options_.statistics)
        frame.graph.skip("statistics", "nobody asked for them");
    frame.plan = graph::make_plan(frame.graph);
    return frame;
}

void FrameLoop::submit(std::uint32_t slot, std::uint32_t frame, FrameKind kind, bool output) {
    if (options_.lane) return submit_in_lane(slot, frame, kind, output);
    // The initial frame simulates nothing, but its statistics need to know where the colliders are.
    const double fps = model_.scene.time.fps;
    const FrameContents& has = contents(kind);
    if (has.simulates || needs(kind).statistics) solver_.write_inputs(*pool_, slot, frame);
    if (has.searches_cuts) solver_.write_cutters(*pool_, slot, frame == 0 ? 0 : (frame - 1) / fps, frame / fps);
    if (has.hands_out && raster_) raster_->write_frame(*pool_, slot, frame / fps);
    std::vector<VkCommandBuffer> commands;
    if (has.simulates && model_.self_contact) commands.push_back(this->commands(AttemptStep::keep, slot));
    commands.push_back(frames_[static_cast<std::size_t>(kind)].recorded->commands(slot));
    if (has.simulates && model_.has_companions())
        commands.push_back(this->commands(AttemptStep::compare_companion, slot));
    slots_.submit(slot, commands);
    in_flight_[slot] = InFlight{frame, kind, output, state_substeps_, std::nullopt};
    if (has.simulates && options_.meanwhile) options_.meanwhile();
}

void FrameLoop::note_self_contact(std::uint32_t frame, const glsl::SelfRecord& record) {
    if (!self_contact_) return;
    if (const double use = solver_.self_list_use(record); use > 1)
        throw vulkan::VulkanError(fmt::format(
            "cloth meets {} in more places than a buffer of the device can list: frame {} has {:.3g} times as many "
            "pairs of triangles and edges near each other; more substeps or a smaller "
            "self_collision.thickness make them fewer",
            model_.cloths.size() > 1 ? "itself or another" : "itself", frame, use));
    note_contact(*self_contact_, model_, frame, record);
}

void FrameLoop::restore_kept() {
    const std::uint32_t slot = next_slot_;
    submit_parts(slot, {.parts = {{LanePart::Kind::attempt, StateSet::run, AttemptStep::restore}}});
    wait(slot);
}

void FrameLoop::begin_anew() {
    restore_kept();
    rebuild_resources(solver_.download_state(*pool_));
}

void FrameLoop::fit_lists(std::uint32_t slot, const Finished& finished) {
    deliver(next_slot_, finished);  // hands out the frame before while this one is simulated
    for (;;) {
        slots_.wait(slot);
        const glsl::SelfRecord record = solver_.self_record(*pool_, slot);
        // Lists that cannot grow are told of when the frame is delivered.
        if (solver_.self_list_use(record) <= 1 || !solver_.grow_lists(record)) return;
        begin_anew();
        const InFlight again = *in_flight_[slot];
        submit(slot, again.frame, again.kind, again.output);
    }
}

void FrameLoop::deliver(std::uint32_t slot, const Finished& finished) {
    wait(slot);
    if (!in_flight_[slot]) return;
    const InFlight done = std::move(*in_flight_[slot]);
    in_flight_[slot].reset();
    FinishedFrame result;
    result.frame = done.frame;
    result.effort.substeps = done.frame == 0 ? 0 : model_.scene.solver.substeps;
    if (done.judged) {
        result.statistics = done.judged->statistics;
        result.effort = done.judged->effort;
        result.timings = done.judged->timings;
    }
    if (const Frame& own = frames_[static_cast<std::size_t>(done.kind)]; own.recorded)
        for (graph::Timing& timing : own.recorded->timings(slot))
            result.timings.push_back({std::move(timing.name), timing.milliseconds});
    if (contents(done.kind).simulates && model_.has_companions()) {
        position_error_.saw(done.frame, done.substeps, differences_in(slot));
        note_motion(position_error_, sensitivity_, result.effort);
    }
    if (contents(done.kind).simulates) note_self_contact(done.frame, self_record_in(slot));
    if (done.output && options_.draw) {
        const std::span<std::byte> bytes = pool_->buffer(RasterPass::readback_name, slot).mapped();
        raster_->finish(bytes.first(raster_->readback_byte_count()));
        result.rgba = {reinterpret_cast<const std::uint8_t*>(bytes.data()), raster_->readback_byte_count()};
    }
    if (done.output && options_.positions) result.positions = array_in(slot, "position");
    if (done.output && options_.velocities)
        result.velocities = velocities(slot, result.effort.asleep ? 0 : done.substeps);
    if (done.output && options_.normals) result.normals = array_in(slot, "normal");
    if (!done.judged && needs(done.kind).statistics) result.statistics = statistics_in(slot, done.frame, model_);
    if (done.output) return finished(result);
    // A closed loop's frame may still be done again.
    if (options_.on_passed_over && (!control_ || done.frame == 0)) options_.on_passed_over(result);
}

/// Returns what the statistics take for the velocity (end_velocity.h), over the substep; 0 where there was none.
std::vector<std::span<const float>> FrameLoop::velocities(std::uint32_t slot, std::uint32_t substeps) {
    const auto moved = array_in(slot, "displacement"), excess = array_in(slot, "excess displacement");
    const double substeps_per_second = model_.scene.time.fps * substeps;
    velocities_.resize(moved.size());
    for (std::size_t cloth = 0; cloth < moved.size(); ++cloth) {
        velocities_[cloth].assign(moved[cloth].size(), 0.0f);
        if (substeps == 0) continue;
        write_velocities(moved[cloth], excess[cloth], substeps_per_second, velocities_[cloth]);
    }
    return {velocities_.begin(), velocities_.end()};
}

void FrameLoop::deliver_all(const Finished& finished) {
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot)
        deliver((next_slot_ + slot) % vulkan::frame_slot_count, finished);
}

std::uint32_t FrameLoop::take_slot(const Finished& finished) {
    const std::uint32_t slot = next_slot_;
    deliver(slot, finished);
    next_slot_ = (next_slot_ + 1) % vulkan::frame_slot_count;
    return slot;
}

void FrameLoop::take_cuts_of(std::uint32_t slot, std::uint32_t frame, const Finished& finished) {
    // A cut acts from the next frame on, always: so that frame waits for this one's findings.
    deliver(next_slot_, finished);
    deliver(slot, finished);
    take_cuts(slot, frame);
}

FrameKind FrameLoop::kind_of(std::uint32_t frame, bool wanted, bool cutting) {
    using enum FrameKind;
    if (frame == 0) return cutting ? initial_cut : initial;
    if (wanted) return cutting ? simulate_and_output_cut : simulate_and_output;
    return cutting ? simulate_cut : simulate;
}

void FrameLoop::tell_passed_over(std::uint32_t end) {
    while (!passed_over_.empty() && passed_over_.front().frame < end) {
        const FinishedFrame frame = std::move(passed_over_.front());
        passed_over_.pop_front();
        options_.on_passed_over(frame);
    }
}

bool FrameLoop::run_elsewhere(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
                              const Finished& finished, const std::function<bool()>& stop) {
    for (; next_frame_ <= last; ++next_frame_) {
        if (stop && stop()) return false;
        const FrameElsewhere elsewhere = options_.next_elsewhere();
        const FinishedFrame& frame = elsewhere.finished;
        self_contact_ = elsewhere.self_contact;
        if (wanted(next_frame_))
            finished(frame);
        else if (options_.on_passed_over)
            options_.on_passed_over(frame);
    }
    return true;
}

bool FrameLoop::run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted, const Finished& hand_out,
                    const std::function<bool()>& stop) {
    if (options_.next_elsewhere) return run_elsewhere(last, wanted, hand_out, stop);
    bool complete = true;
    const Finished finished = [&](const FinishedFrame& frame) {
        tell_passed_over(frame.frame);
        hand_out(frame);
    };
    for (; next_frame_ <= last; ++next_frame_) {
        const std::uint32_t frame = next_frame_;
        const bool output = wanted(frame);
        const bool cutting = searched(frame);
        // The initial state is already there.
        if (frame == 0 && !output && !cutting && !options_.on_passed_over) continue;
        if (stop && stop()) {
            complete = false;
            break;
        }
        if (control_ && frame > 0) {
            complete = frame < simulated_ || simulate_unless_stopped(frame, {last, wanted, finished, stop});
            if (!complete) break;
            release_withheld(frame, output, finished);
            if (std::ranges::none_of(in_flight_, [](const auto& each) { return each.has_value(); }))
                tell_passed_over(frame + 1);
            continue;
        }
        if (model_.has_companions() && frame > 0)
            follow(StateSet::companion, frame, 1, model_.companion_substeps(state_substeps_), finished);
        const std::uint32_t slot = take_slot(finished);
        submit(slot, frame, kind_of(frame, output, cutting), output);
        if (model_.self_contact && frame > 0) fit_lists(slot, finished);
        if (cutting) take_cuts_of(slot, frame, finished);
    }
    deliver_all(finished);
    tell_passed_over(next_frame_);
    return complete;
}

std::vector<std::uint32_t> FrameLoop::whole_triangles(std::size_t cloth) const {
    return solver_.topologies()[cloth].whole_triangles();
}

}  // namespace drape
