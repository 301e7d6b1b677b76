#include "run/folder_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "run/contact_proof.h"
#include "run/reproducer.h"
#include "scene/scene_document.h"
#include "simulation/frame_checks.h"
#include "world/start_crossings.h"

namespace drape {

namespace {

/// Throws Error for a record whose cloths are not the scene's: a journal written by others may have a correct checksum.
void expect_of_scene(const JournalRecord& record, const SceneDescription& scene) {
    const auto particles = [](const Cloth& cloth) { return std::uint64_t{cloth.grid[0]} * cloth.grid[1]; };
    const auto fits = [&](const std::vector<std::vector<float>>& arrays) {
        return arrays.empty() ||
               std::ranges::equal(arrays, scene.cloths, [&](const std::vector<float>& values, const Cloth& cloth) {
                   return values.size() == 4 * particles(cloth);
               });
    };
    const auto cuts = [&] {
        return record.cloth < scene.cloths.size() && record.faces.size() % 3 == 0 &&
               record.spring_bits.size() == particles(scene.cloths[record.cloth]) &&
               std::ranges::all_of(record.faces, [&, count = particles(scene.cloths[record.cloth])](
                                                     std::uint32_t particle) { return particle < count; });
    };
    const auto fields = [&] {
        const bool told = scene.force_fields && !record.positions.empty();
        return fits(record.tensions) && fits(record.contact_forces) && record.tensions.empty() != told &&
               record.contact_forces.empty() != told;
    };
    const auto frame = [&] { return fits(record.positions) && fits(record.velocities) && fields(); };
    if (!(record.kind == JournalRecord::Kind::cut ? cuts() : frame())) throw Error("a record of another scene");
}

/// Returns the checkpoint from which a run goes on: everything before it must be there, as pictures and, for arrays, in
/// the journal.
std::optional<RunCheckpoint> resumed_from(std::optional<Checkpoints>& checkpoints, const RunRequest& request,
                                          const SceneDescription& scene, const FrameRange& range,
                                          const MissingFrames& missing,
                                          const std::function<void(const std::string&)>& say) {
    if (!checkpoints || request.existing != ExistingFiles::resume) return std::nullopt;
    const bool arrays = needs_positions(request);
    const auto usable = [&](const RunCheckpoint& checkpoint) {
        std::set<std::uint32_t> told;
        checkpoints->journal().read(checkpoint.journal_length, [&](const JournalRecord& record) {
            expect_of_scene(record, scene);
            const bool enough = !record.positions.empty() && (!request.details() || !record.velocities.empty());
            if (record.kind == JournalRecord::Kind::frame && enough) told.insert(record.frame);
        });
        for (std::uint64_t frame = range.start; frame <= range.end && frame < checkpoint.next_frame;
             frame += range.step) {
            const auto number = static_cast<std::uint32_t>(frame);
            if (needs_every_picture(request)) return false;
            if (request.draws() && !missing.kept.contains(number)) return false;
            if (arrays && !told.contains(number)) return false;
        }
        return true;
    };
    return checkpoints->newest(usable, say);
}

/// The cuts and the proof of contact of frames that a resumed run keeps belong to its manifest too, so such scenes need
/// every frame.
bool needs_every_frame(const SceneDescription& scene) { return scene.comes_apart() || cloths_meet(scene); }

/// Returns the warning for a run that did not keep the limits of `auto`.
std::optional<std::string> missed_limits(const SimulationFacts& facts, const RunStatistics& statistics,
                                         const RunVerdict& verdict) {
    if (facts.limits_are_kept) return std::nullopt;
    const double rms = std::max(verdict.stretch_error_rms, statistics.worst_of_run("/stretch_error_rms")).value_or(0),
                 largest =
                     std::max(verdict.stretch_error_max, statistics.worst_of_run("/stretch_error_max")).value_or(0);
    if (rms <= facts.tolerance_rms && largest <= facts.tolerance_worst) return std::nullopt;
    return fmt::format(
        "the stretch error came to {:.3g} RMS and {:.3g} in a single spring; method auto would have kept {:.3g} and "
        "{:.3g}",
        rms, largest, facts.tolerance_rms, facts.tolerance_worst);
}

/// Returns the frames that were written of a run that did not reach its end. If none was written, the end precedes the
/// start.
Manifest::Frames written_frames(Manifest::Frames frames, const RunStatistics& statistics) {
    frames.count = 0;
    frames.end = frames.start - frames.step;
    statistics.for_each_frame([&](const Manifest::FrameStatistics& each) {
        ++frames.count;
        frames.end = each.frame;
    });
    return frames;
}

/// Returns the warnings about a run that has all of its frames.
std::vector<std::string> closing_warnings(const Simulation& simulation, Sink& sink) {
    std::vector<std::string> warnings;
    for (const auto& warning :
         {missed_limits(simulation.facts(), *sink.statistics(), simulation.verdict()), lost_proof(simulation),
          still_crossed(simulation), held_back(simulation), simulation.possible_passage()})
        if (warning) warnings.push_back(*warning);
    for (const std::string& warning : simulation.verdict().warnings) warnings.push_back(warning);
    return warnings;
}

}  // namespace

FolderRun::FolderRun(const RunRequest& request, const std::optional<Device>& device)
    : request_(request), device_(device) {
    planned_.scene = load(request.scene);
    summary_.warnings = planned_.scene.warnings;
    planned_.range = frame_range(request, scene(), summary_.warnings);
    for (const std::string& warning : summary_.warnings) say("warning: " + warning);
    check_formats(request, scene());
    if (!request.stream) folder_.emplace(request.output, request.existing);
    if (folder_) expect_room(*folder_, request, scene(), planned_.range);
    if (!device_) device_ = device_of(request.scene, scene(), request.draws() || request.layers());
    planned_.key = key_of(request, planned_.scene, device_->info());
    planned_.missing = missing_frames(folder_, request, planned_.range, planned_.key);
    summary_.kept_count = planned_.missing.kept.size();
    if (folder_) checkpoints_.emplace(*folder_, planned_.key, device ? std::nullopt : request.checkpoint_interval);
    from_ = resumed_from(checkpoints_, request, scene(), planned_.range, planned_.missing,
                         [this](const std::string& text) { say(text); });
}

void FolderRun::say(const std::string& text) const {
    if (request_.message) request_.message(text);
}

void FolderRun::warn(const std::string& text) {
    summary_.warnings.push_back(text);
    say("warning: " + text);
}

SimulationOptions FolderRun::options() {
    SimulationOptions options =
        simulation_options(request_.scene, request_.draws(), needs_positions(request_), request_.details());
    options.layers = request_.layers();
    options.keep_promises = !request_.keep_failed;
    options.on_cut = [this](const Cut& cut) { sink_->add_cut(cut); };
    options.on_attempt = [this](const FrameAttempt& attempt) {
        if (progress_) progress_->frame_begun(attempt.frame, attempt.substeps, attempt.number);
    };
    return options;
}

Simulation FolderRun::simulation() {
    try {
        return Simulation(scene(), options(), device());
    } catch (const SceneFailure& failure) {
        throw SceneFailure(
            with_places(failure.result(), planned_.scene.text, request_.scene.path, request_.scene.overrides));
    }
}

void FolderRun::begin(Simulation& simulation) {
    simulation_ = &simulation;
    for (const Compromise& each : simulation.facts().compromises) warn(each.what + ": " + each.reason);
    if (request_.verbose)
        for (const std::string& note : notes(*device_, simulation)) say(note);
    manifest_ = describe_run(request_, planned_.scene, simulation, device_->info(), planned_.range);
    manifest_.run_key = planned_.key;
    sink_.emplace(folder_, request_, simulation.scene(), written_run(request_, planned_.scene, simulation, manifest_),
                  planned_.missing.kept, keeps_checkpoints() ? &checkpoints_->journal() : nullptr);
}

/// Restores the simulation from the checkpoint, and repeats to the writers what they received before it.
void FolderRun::go_on() {
    const RunCheckpoint& from = *from_;
    const FrameRange& range = planned_.range;
    try {
        simulation_->restore(from.state);
        if (simulation_->next_frame() != from.next_frame) throw Error("it is of another frame than it says");
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        throw OutputError(fmt::format("cannot resume: the checkpoint of frame {}: {}", from.next_frame, error.what()));
    }
    say(fmt::format("note: goes on from the checkpoint of frame {}", from.next_frame));
    Journal& journal = checkpoints_->journal();
    journal.read(from.journal_length, [&](const JournalRecord& record) {
        if (record.kind == JournalRecord::Kind::cut) return sink_->repeat_cut(record);
        const bool wanted =
            record.frame >= range.start && record.frame <= range.end && (record.frame - range.start) % range.step == 0;
        if (!wanted || record.frame >= from.next_frame) return;
        if (!planned_.missing.kept.contains(record.frame)) ++summary_.kept_count;
        sink_->repeat(record);
    });
    journal.go_on_behind(from.journal_length);
    if (from.failure) failure_ = kept_failure(*from.failure);
}

/// Returns the last frame that has to be simulated.
std::uint32_t FolderRun::last_frame() const {
    return static_cast<std::uint32_t>(needs_every_frame(simulation_->scene()) ? planned_.range.end
                                                                              : *planned_.missing.frames.rbegin());
}

void FolderRun::begin_frames() {
    const auto& frames = planned_.missing.frames;
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(frames, [&](std::uint32_t frame) { return frame >= simulation_->next_frame(); }));
    progress_.emplace(count, Progress::standard_options(request_.quiet));
    planned_.count = count;
}

void FolderRun::take(const FinishedFrame& frame) {
    if (frame.failure && frame.failure->kind == FrameFailure::Kind::not_finite) raise(*frame.failure);
    sink_->add(frame);
    progress_->frame_done(frame.frame, sink_->note());
    if (!planned_.missing.kept.contains(frame.frame)) ++summary_.frame_count;
}

/// Returns what the message of a run that cannot go on adds: a new run would fail at the same frame, so the frames
/// before it are the result.
std::string FolderRun::consequence() const {
    const std::uint64_t written = summary_.frame_count + summary_.kept_count;
    if (written == 0) return "; nothing was written";
    return fmt::format("; what was written before it is kept ({} of {} frames)", written,
                       summary_.kept_count + planned_.count);
}

FrameRequest FolderRun::frames() {
    begin_frames();
    return {.last = last_frame(),
            .wanted = [this](std::uint32_t frame) { return planned_.missing.frames.contains(frame); },
            .finished = [this](const FinishedFrame& frame) { take(frame); },
            .stop = [this] { return request_.stop && request_.stop(); }};
}

void FolderRun::take_end(const RequestEnd& end) {
    summary_.complete = end.complete && !end.failure;
    if (end.failure)
        failure_ = failure_of(end.failure, consequence());
    else if (const auto failure = simulation_->verdict().failure; failure && !failure_)
        failure_ = kept_failure(*failure);
    progress_.reset();
}

void FolderRun::simulate() {
    if (planned_.missing.frames.empty() && !needs_every_frame(simulation_->scene())) return;
    if (from_) go_on();
    if (checkpoints_) checkpoints_->keep_until(from_ ? from_->next_frame : 0);
    RequestEnd end;
    const FrameRequest request = frames();
    try {
        end.complete = run_with_checkpoints(request);
    } catch (...) {
        end.failure = std::current_exception();
    }
    take_end(end);
}

void FolderRun::write_checkpoint() {
    if (request_.saving) request_.saving();
    RunCheckpoint checkpoint;
    checkpoint.next_frame = simulation_->next_frame();
    checkpoint.validation_count = (from_ ? from_->validation_count : 0) + device_->validation_count();
    checkpoint.failure = failure_ ? failure_->frame : simulation_->verdict().failure;
    sink_->flush();
    checkpoint.state = simulation_->save();
    checkpoints_->write(std::move(checkpoint));
}

/// Simulates to the last frame, with checkpoints when they are due and when the run is stopped. Returns whether it
/// reached the last frame.
bool FolderRun::run_with_checkpoints(const FrameRequest& request) {
    const auto run = [&](const auto& stopped) {
        return simulation_->run(request.last, request.wanted, request.finished, stopped);
    };
    if (!keeps_checkpoints()) return run(request.stop);
    std::uint32_t saved = simulation_->next_frame();
    std::optional<std::uint32_t> begun;
    for (bool due = true; due;) {
        due = false;
        const auto pause = [&] {
            // Frames that method auto has simulated ahead are handed out first, which takes no time.
            if (!simulation_->can_save()) return false;
            const std::uint32_t frame = simulation_->next_frame();
            due = begun != frame && frame > saved && checkpoints_->due();  // no attempt is given up for a checkpoint
            begun = frame;
            return due || request.stop();
        };
        if (run(pause)) return true;
        if (simulation_->next_frame() > saved) write_checkpoint();
        saved = simulation_->next_frame();
        due = due && !request.stop();
    }
    if (saved > 0) summary_.checkpoint = saved;
    return false;
}

/// Completes the files of a run that is done, or the files of a failed run as far as it came.
void FolderRun::finish_files() {
    manifest_.cuts = sink_->cuts();
    const std::shared_ptr<const RunStatistics> statistics = sink_->statistics();
    manifest_.statistics = [statistics](const Manifest::FrameVisitor& take) { statistics->for_each_frame(take); };
    // This run may not have simulated the frames that it kept, so the statistics decide.
    manifest_.solver.stretch_error =
        std::max(manifest_.solver.stretch_error, statistics->worst_of_run("/stretch_error_rms"));
    try {
        if (!summary_.complete) manifest_.frames = written_frames(manifest_.frames, *statistics);
        sink_->add_timings(manifest_);
        // Arrays of a run that was broken off are no result; those before a frame that would fail again are one.
        const bool whole =
            summary_.complete || (failure_ && failure_->frame && summary_.frame_count + summary_.kept_count > 0);
        manifest_.files = sink_->finish(whole, summary_.dropped);
    } catch (const std::exception&) {
        summary_.complete = false;
        if (!failure_) failure_ = failure_of(std::current_exception(), {});
    }
}

/// Writes a reproducer for replay. A failure to write it has been reported, or is reported about the manifest.
void FolderRun::leave_reproducer() {
    if (failure_->status == output_failed) return;
    Reproducer reproducer{
        .scene = request_.scene, .scene_text = planned_.scene.text, .keep_failed = request_.keep_failed};
    reproducer.start = planned_.range.start, reproducer.end = planned_.range.end, reproducer.step = planned_.range.step;
    reproducer.program_version = program_version();
    reproducer.run_key = manifest_.run_key;
    reproducer.device = manifest_.device;
    reproducer.status = failure_->status;
    reproducer.reason = failure_->reason;
    reproducer.failed = failure_->frame;
    reproducer.checkpoint = checkpoints_->last();
    // Later checkpoints of a run that went on after the failure are of no use.
    if (reproducer.checkpoint && failure_->frame && reproducer.checkpoint->next_frame > failure_->frame->frame)
        reproducer.checkpoint.reset();
    try {
        manifest_.statistics([&](const Manifest::FrameStatistics& each) {
            if (!failure_->frame || each.frame < failure_->frame->frame) reproducer.last_frame = each;
        });
        write_reproducer(*folder_, reproducer);
        manifest_.reproducer = reproducer_file_name;
        if (request_.message)
            request_.message(fmt::format("note: `drape replay {}` goes to this failure again",
                                         folder_->path_of(reproducer_file_name)));
    } catch (const OutputError&) {  // the run's own failure is reported instead
    }
}

/// Writes the manifest, which says how the run ended even if it failed. Removes checkpoints if a resumed run would end
/// the same way.
void FolderRun::end_with_manifest() {
    if (failure_) {
        manifest_.status = failure_->status;
        manifest_.failure = failure_->reason;
        manifest_.failed_frame = failure_->frame;
    } else if (manifest_.validation.message_count > 0) {
        manifest_.status = "validation messages";
        manifest_.failure = fmt::format("{} validation messages", manifest_.validation.message_count);
    }
    try {
        write_manifest(*folder_, manifest_);
    } catch (const OutputError&) {
        if (!failure_) throw;  // otherwise the first failure is reported, which also prevented this file
    }
    if (!failure_ || failure_->frame) checkpoints_->remove_all();
}

void FolderRun::finish() {
    for (const std::string& warning : closing_warnings(*simulation_, *sink_)) warn(warning);
    manifest_.warnings = summary_.warnings;
    manifest_.solver.stretch_error = simulation_->verdict().stretch_error_rms;
    describe_contact(manifest_, *simulation_, sink_->cuts());
    std::vector<std::string> notes = simulation_->verdict().notes;
    if (const auto note = left_out_triangles(manifest_)) notes.push_back(*note);
    for (const std::string& note : notes)
        if (!request_.quiet) say("note: " + note);
    finish_files();
    sink_.reset();
    simulation_ = nullptr;
}

RunSummary FolderRun::end() {
    summary_.validation_count = (from_ ? from_->validation_count : 0) + device_->validation_count();
    manifest_.validation = {request_.scene.validate, summary_.validation_count};
    if (folder_ && failure_) leave_reproducer();
    if (folder_ && (summary_.complete || failure_)) end_with_manifest();
    if (failure_) std::rethrow_exception(failure_->error);
    return summary_;
}

}  // namespace drape
