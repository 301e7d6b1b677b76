#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "output/kept_frames.h"
#include "output/manifest.h"
#include "output/png_sequence.h"
#include "output/progress.h"
#include "run/checkpoints.h"
#include "run/contact_proof.h"
#include "run/frame_sink.h"
#include "run/reproducer.h"
#include "run/run.h"
#include "run/run_description.h"
#include "run/written_colliders.h"
#include "simulation/frame_checks.h"
#include "world/start_crossings.h"

namespace drape {

namespace {

void check_stream(const RunRequest& request) {
    const auto formats = output_formats(request.formats);
    if (formats.size() != 1 || !formats[0]->stream)
        throw UsageError(fmt::format("a stream takes one format, of {}", stream_format_names()));
    if (request.existing != ExistingFiles::refuse) throw UsageError("a stream cannot be overwritten or resumed");
}

/// Throws UsageError when a format cannot be written so, or cannot hold what the scene does.
void check_formats(const RunRequest& request, const SceneDescription& scene) {
    if (request.stream) check_stream(request);
    if (request.deflates && std::ranges::none_of(output_formats(request.formats), &OutputFormat::is_archive))
        throw UsageError("--compress: no format that is written is an archive: npz is one");
    for (const OutputFormat* format : output_formats(request.formats))
        if (!format->follows_cuts && scene.comes_apart())
            throw UsageError(fmt::format("--export {}: its faces cannot change, but the scene has {}", format->name,
                                         scene.tears() ? "cloth that tears" : "cutters"));
}

bool needs_positions(const RunRequest& request) {
    return std::ranges::any_of(output_formats(request.formats),
                               [](const OutputFormat* format) { return !format->draws; });
}

SimulationOptions run_options(const RunRequest& request) {
    SimulationOptions options =
        simulation_options(request.scene, request.draws(), needs_positions(request), request.details());
    options.keep_promises = !request.keep_failed;
    if (request.shared) options.member = request.shared->member;
    return options;
}

/// Returns whether some format needs every picture, those of kept frames too.
bool needs_every_picture(const RunRequest& request) {
    return std::ranges::any_of(output_formats(request.formats),
                               [](const OutputFormat* format) { return format->draws && !format->resumes; });
}

/// Some frames of the range have to be handed out; the pictures of others are there already.
struct MissingFrames {
    std::set<std::uint32_t> frames;
    std::map<std::uint32_t, KeptFrame> kept;
};

MissingFrames missing_frames(const std::optional<OutputFolder>& folder, const RunRequest& request,
                             const FrameRange& range, const std::string& key) {
    std::map<std::string, KeptFrame> there;
    if (folder && request.existing == ExistingFiles::resume) there = kept_frames(*folder, key);
    const bool only_pictures = !needs_positions(request) && !needs_every_picture(request);
    MissingFrames missing;
    for (std::uint64_t number = range.start; number <= range.end; number += range.step) {
        const auto frame = static_cast<std::uint32_t>(number);
        const auto kept = there.find(frame_file_name(frame, frame_digits(range.end)));
        const bool is_kept = request.draws() && kept != there.end();
        if (is_kept) missing.kept.emplace(frame, kept->second);
        if (!is_kept || !only_pictures) missing.frames.insert(frame);
    }
    return missing;
}

/// Throws OutputError where the disk has not what all frames take at least.
void expect_room(const OutputFolder& folder, const RunRequest& request, const SceneDescription& scene,
                 const FrameRange& range) {
    FrameSize size{.pixels = std::uint64_t{scene.image.size[0]} * scene.image.size[1]};
    bool whole = !scene.comes_apart();
    for (const Cloth& cloth : scene.cloths) {
        const std::uint64_t columns = cloth.grid[0], rows = cloth.grid[1];
        size.particles += columns * rows;
        size.triangles += 2 * (columns - 1) * (rows - 1);
        whole = whole && cloth.holes.empty();
    }
    if (!whole) size.triangles = 0;
    for (const WrittenCollider& collider : written_colliders(scene)) {
        size.moving_vertices += collider.moves ? collider.vertices.size() : 0;
        size.moving_triangles += collider.moves ? collider.faces.size() / 3 : 0;
    }
    for (const WrittenCollider& obstacle : written_obstacles(scene)) size.obstacle_nodes += obstacle.vertices.size();
    size.packed = request.deflates;
    std::uint64_t frame_bytes = 0;
    for (const OutputFormat* format : output_formats(request.formats))
        if (format->frame_bytes) frame_bytes += format->frame_bytes(size);
    folder.expect_room(frame_bytes * range.count());
}

/// How a run ended before its end that would end there again, or with frames that are no result.
struct RunFailure {
    std::string status, reason;
    std::optional<FrameFailure> frame;
    std::exception_ptr error;
};

/// Returns the failure of a frame, to be told as its reason and `consequence`.
RunFailure frame_run_failure(const FrameError& error, bool of_tolerance, const std::string& consequence) {
    const std::string text = error.what() + consequence;
    return {of_tolerance ? "tolerance missed" : "diverged", error.what(), error.failure(),
            of_tolerance ? std::make_exception_ptr(ToleranceMissed(text, error.failure()))
                         : std::make_exception_ptr(Diverged(text, error.failure()))};
}

/// Returns what is said at the end of a run that went on.
RunFailure kept_failure(const FrameFailure& failure) {
    return frame_run_failure(FrameError(failure.reason, failure), failure.kind == FrameFailure::Kind::tolerance,
                             "; it and what came after are kept, as --on-failure keep asks");
}

constexpr const char* output_failed = "output failed";

/// Returns the failure of the exception being handled, which did not come from a frame's numbers.
RunFailure broken_run(const std::exception& error) {
    const char* status = dynamic_cast<const OutputError*>(&error)      ? output_failed
                         : dynamic_cast<const DeviceError*>(&error)    ? "device failed"
                         : dynamic_cast<const std::bad_alloc*>(&error) ? "out of memory"
                                                                       : "internal error";
    return {status, error.what(), std::nullopt, std::current_exception()};
}

struct RunParts {
    const RunRequest& request;
    const MissingFrames& missing;
    Simulation& simulation;
    Sink& sink;
    Checkpoints* checkpoints;  ///< nothing for a stream
    RunSummary& summary;
    std::optional<RunFailure>& failure;
    std::uint64_t earlier_validation;  ///< messages of a run that this one goes on
    const Device& device;
    Progress*& progress;  ///< while frames are written
};

void write_checkpoint(const RunParts& run) {
    if (run.request.saving) run.request.saving();
    RunCheckpoint checkpoint;
    checkpoint.next_frame = run.simulation.next_frame();
    checkpoint.validation_count = run.earlier_validation + run.device.validation_count();
    checkpoint.failure = run.failure ? run.failure->frame : run.simulation.verdict().failure;
    run.sink.flush();
    checkpoint.state = run.simulation.save();
    run.checkpoints->write(std::move(checkpoint));
}

/// Runs to `last`, with checkpoints when they are due and where it is stopped. Returns whether it came to `last`.
bool run_with_checkpoints(const RunParts& run, std::uint32_t last,
                          const std::function<void(const FinishedFrame&)>& finished) {
    const auto wanted = [&](std::uint32_t frame) { return run.missing.frames.contains(frame); };
    const auto stopped = [&] { return run.request.stop && run.request.stop(); };
    if (!run.checkpoints || !run.checkpoints->enabled()) return run.simulation.run(last, wanted, finished, stopped);
    std::uint32_t saved = run.simulation.next_frame();
    std::optional<std::uint32_t> begun;
    for (bool due = true; due;) {
        due = false;
        const auto pause = [&] {
            // Frames that method auto has simulated ahead are handed out first, which takes no time.
            if (!run.simulation.can_save()) return false;
            const std::uint32_t frame = run.simulation.next_frame();
            due = begun != frame && frame > saved && run.checkpoints->due();  // for none is an attempt given up
            begun = frame;
            return due || stopped();
        };
        if (run.simulation.run(last, wanted, finished, pause)) return true;
        if (run.simulation.next_frame() > saved) write_checkpoint(run);
        saved = run.simulation.next_frame();
        due = due && !stopped();
    }
    if (saved > 0) run.summary.checkpoint = saved;
    return false;
}

/// Simulates up to the last missing frame and writes the missing ones. Returns whether it came to its end; where it
/// failed it says how.
bool write_frames(const RunParts& run, std::uint32_t last) {
    RunSummary& summary = run.summary;
    const auto& frames = run.missing.frames;
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(frames, [&](std::uint32_t frame) { return frame >= run.simulation.next_frame(); }));
    // A run again would fail again at the same frame: what came before it is the result.
    const auto kept = [&] {
        const std::uint64_t written = summary.frame_count + summary.kept_count;
        if (written == 0) return std::string("; nothing was written");
        return fmt::format("; what was written before it is kept ({} of {} frames)", written,
                           summary.kept_count + count);
    };
    Progress progress(count, Progress::standard_options(run.request.quiet));
    run.progress = &progress;
    try {
        const bool complete = run_with_checkpoints(run, last, [&](const FinishedFrame& frame) {
            if (frame.failure && frame.failure->kind == FrameFailure::Kind::not_finite) raise(*frame.failure);
            run.sink.add(frame);
            progress.frame_done(frame.frame, run.sink.note());
            if (!run.missing.kept.contains(frame.frame)) ++summary.frame_count;
        });
        if (const auto failure = run.simulation.verdict().failure; failure && !run.failure)
            run.failure = kept_failure(*failure);
        return complete;
    } catch (const Diverged& error) {
        run.failure = frame_run_failure(error, false, kept());
    } catch (const ToleranceMissed& error) {
        run.failure = frame_run_failure(error, true, kept());
    } catch (const std::exception& error) {
        run.failure = broken_run(error);
    }
    return false;
}

/// Throws Error for a record of other cloths: the writer of the file may have made its checksum as well.
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
               std::ranges::all_of(record.faces, [&, count = particles(scene.cloths[record.cloth])](
                                                     std::uint32_t particle) { return particle < count; });
    };
    if (!(record.kind == JournalRecord::Kind::cut ? cuts() : fits(record.positions) && fits(record.velocities)))
        throw Error("a record of another scene");
}

/// Returns the checkpoint that a run goes on from: what it does not simulate again has to be there, as pictures and,
/// for arrays, in the journal.
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

/// Takes the simulation to the checkpoint, and tells the writers what they were told before it.
void go_on_from(const RunCheckpoint& from, const RunParts& run, const FrameRange& range) {
    try {
        run.simulation.restore(from.state);
        if (run.simulation.next_frame() != from.next_frame) throw Error("it is of another frame than it says");
    } catch (const DeviceError&) {
        throw;
    } catch (const Error& error) {
        throw OutputError(fmt::format("cannot resume: the checkpoint of frame {}: {}", from.next_frame, error.what()));
    }
    if (run.request.message)
        run.request.message(fmt::format("note: goes on from the checkpoint of frame {}", from.next_frame));
    Journal& journal = run.checkpoints->journal();
    journal.read(from.journal_length, [&](const JournalRecord& record) {
        if (record.kind == JournalRecord::Kind::cut) return run.sink.repeat_cut(record);
        const bool wanted =
            record.frame >= range.start && record.frame <= range.end && (record.frame - range.start) % range.step == 0;
        if (!wanted || record.frame >= from.next_frame) return;
        if (!run.missing.kept.contains(record.frame)) ++run.summary.kept_count;
        run.sink.repeat(record);
    });
    journal.go_on_behind(from.journal_length);
    if (from.failure) run.failure = kept_failure(*from.failure);
}

/// Frames that a resumed run keeps still cut, and still have to be proved: the manifest speaks of all of them.
bool needs_every_frame(const SceneDescription& scene) { return scene.comes_apart() || cloths_meet(scene); }

/// Simulates what is missing. Returns whether all is there.
bool run_missing(const RunParts& run, const std::optional<RunCheckpoint>& from, const FrameRange& range) {
    const bool to_the_end = needs_every_frame(run.simulation.scene());
    const std::set<std::uint32_t>& frames = run.missing.frames;
    if (frames.empty() && !to_the_end) return true;
    if (from) go_on_from(*from, run, range);
    if (run.checkpoints) run.checkpoints->keep_until(from ? from->next_frame : 0);
    return write_frames(run, to_the_end ? range.end : *frames.rbegin());
}

/// Returns what to tell a run that did not keep what `auto` aims at.
std::optional<std::string> missed_limits(const SimulationFacts& facts, const RunStatistics& statistics,
                                         const RunVerdict& verdict) {
    if (facts.limits_are_kept) return statistics.inexact_motion();
    const double rms = std::max(verdict.stretch_error_rms, statistics.worst_of_run("/stretch_error_rms")).value_or(0),
                 largest =
                     std::max(verdict.stretch_error_max, statistics.worst_of_run("/stretch_error_max")).value_or(0);
    if (rms <= facts.tolerance_rms && largest <= facts.tolerance_worst) return std::nullopt;
    return fmt::format(
        "the stretch error came to {:.3g} RMS and {:.3g} in a single spring; method auto would have kept {:.3g} and "
        "{:.3g}",
        rms, largest, facts.tolerance_rms, facts.tolerance_worst);
}

/// While there is one.
std::function<void(const FrameAttempt&)> told_to(Progress*& progress) {
    return [&progress](const FrameAttempt& attempt) {
        if (progress) progress->frame_begun(attempt.frame, attempt.substeps, attempt.number);
    };
}

/// Returns the frames of a run that did not come to its end, as far as they were written. Where none was, the end lies
/// before the start.
Manifest::Frames written_frames(Manifest::Frames frames, const RunStatistics& statistics) {
    frames.count = 0;
    frames.end = frames.start - frames.step;
    statistics.for_each_frame([&](const Manifest::FrameStatistics& each) {
        ++frames.count;
        frames.end = each.frame;
    });
    return frames;
}

/// The files of a run that is done, or of one that failed as far as it came.
void finish_files(Sink& sink, Manifest& manifest, RunSummary& summary, std::optional<RunFailure>& failure) {
    manifest.cuts = sink.cuts();
    const std::shared_ptr<const RunStatistics> statistics = sink.statistics();
    manifest.statistics = [statistics](const Manifest::FrameVisitor& take) { statistics->for_each_frame(take); };
    // Frames that were kept may not have been simulated again.
    manifest.solver.stretch_error =
        std::max(manifest.solver.stretch_error, statistics->worst_of_run("/stretch_error_rms"));
    try {
        if (!summary.complete) manifest.frames = written_frames(manifest.frames, *statistics);
        sink.add_timings(manifest);
        // Arrays of a run that something broke are no result; those before a frame that fails again are one.
        const bool whole =
            summary.complete || (failure && failure->frame && summary.frame_count + summary.kept_count > 0);
        manifest.files = sink.finish(whole, summary.dropped);
    } catch (const std::exception& error) {
        summary.complete = false;
        if (!failure) failure = broken_run(error);
    }
}

/// Leaves a reproducer to be replayed. What keeps it from being written has been told, or is told of the manifest.
void leave_reproducer(OutputFolder& folder, const RunRequest& request, const LoadedScene& scene,
                      const FrameRange& range, const Checkpoints& checkpoints, const RunFailure& failure,
                      Manifest& manifest) {
    if (failure.status == output_failed) return;
    Reproducer reproducer{.scene = request.scene, .scene_text = scene.text, .keep_failed = request.keep_failed};
    reproducer.start = range.start, reproducer.end = range.end, reproducer.step = range.step;
    reproducer.program_version = program_version();
    reproducer.run_key = manifest.run_key;
    reproducer.device = manifest.device;
    reproducer.status = failure.status;
    reproducer.reason = failure.reason;
    reproducer.failed = failure.frame;
    reproducer.checkpoint = checkpoints.last();
    // Later checkpoints are of no use in a run that went on.
    if (reproducer.checkpoint && failure.frame && reproducer.checkpoint->next_frame > failure.frame->frame)
        reproducer.checkpoint.reset();
    try {
        manifest.statistics([&](const Manifest::FrameStatistics& each) {
            if (!failure.frame || each.frame < failure.frame->frame) reproducer.last_frame = each;
        });
        write_reproducer(folder, reproducer);
        manifest.reproducer = reproducer_file_name;
        if (request.message)
            request.message(fmt::format("note: `drape replay {}` goes to this failure again",
                                        folder.path_of(reproducer_file_name)));
    } catch (const OutputError&) {  // the run's own failure is told
    }
}

/// The manifest says how a run ended, also where it failed. Checkpoints go where it would end there again.
void end_with_manifest(OutputFolder& folder, Manifest& manifest, const std::optional<RunFailure>& failure,
                       Checkpoints& checkpoints) {
    if (failure) {
        manifest.status = failure->status;
        manifest.failure = failure->reason;
        manifest.failed_frame = failure->frame;
    } else if (manifest.validation.message_count > 0) {
        manifest.status = "validation messages";
        manifest.failure = fmt::format("{} validation messages", manifest.validation.message_count);
    }
    try {
        write_manifest(folder, manifest);
    } catch (const OutputError&) {
        if (!failure) throw;  // else the first failure is told, which keeps this file from being written too
    }
    if (!failure || failure->frame) checkpoints.remove_all();
}

/// Returns what a run is warned of when all of its frames are there.
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

RunSummary run_scene(const RunRequest& request) {
    RunSummary summary;
    const LoadedScene scene = load(request.scene);
    summary.warnings = scene.warnings;
    const FrameRange range = frame_range(request, scene.description, summary.warnings);
    const auto say = [&](const std::string& text) {
        if (request.message) request.message(text);
    };
    const auto warn = [&](const std::string& text) {
        summary.warnings.push_back(text);
        say("warning: " + text);
    };
    for (const std::string& warning : summary.warnings) say("warning: " + warning);
    std::optional<OutputFolder> folder;
    check_formats(request, scene.description);
    if (!request.stream) folder.emplace(request.output, request.existing);
    if (folder) expect_room(*folder, request, scene.description, range);
    const Device device =
        request.shared ? request.shared->device : device_of(request.scene, scene.description, request.draws());
    const std::string key = key_of(request, scene, device.info());
    const MissingFrames missing = missing_frames(folder, request, range, key);
    summary.kept_count = missing.kept.size();
    std::optional<Checkpoints> checkpoints;
    if (folder) checkpoints.emplace(*folder, key, request.shared ? std::nullopt : request.checkpoint_interval);
    const auto from = resumed_from(checkpoints, request, scene.description, range, missing, say);
    const std::uint64_t earlier_validation = from ? from->validation_count : 0;
    Manifest manifest;
    std::optional<RunFailure> failure;
    {
        Sink* cut_sink = nullptr;
        SimulationOptions options = run_options(request);
        options.on_cut = [&](const Cut& cut) { cut_sink->add_cut(cut); };
        Progress* progress = nullptr;
        options.on_attempt = told_to(progress);
        Simulation simulation(scene.description, options, device);
        for (const Compromise& each : simulation.facts().compromises) warn(each.what + ": " + each.reason);
        if (request.verbose) std::ranges::for_each(notes(device, simulation), say);
        manifest = describe_run(request, scene, simulation, device.info(), range);
        manifest.run_key = key;
        Sink sink(folder, request, simulation.scene(), written_run(request, scene, simulation, manifest), missing.kept,
                  checkpoints && checkpoints->enabled() ? &checkpoints->journal() : nullptr);
        cut_sink = &sink;
        const RunParts run{request, missing, simulation,         sink,   checkpoints ? &*checkpoints : nullptr,
                           summary, failure, earlier_validation, device, progress};
        summary.complete = run_missing(run, from, range);
        std::ranges::for_each(closing_warnings(simulation, sink), warn);
        manifest.warnings = summary.warnings;
        manifest.solver.stretch_error = simulation.verdict().stretch_error_rms;
        describe_contact(manifest, simulation, sink.cuts());
        for (const auto& note : {left_out_triangles(manifest), sink.statistics()->sensitive_motion()})
            if (note && !request.quiet) say("note: " + *note);
        finish_files(sink, manifest, summary, failure);
    }
    summary.validation_count = earlier_validation + device.validation_count();
    manifest.validation = {request.scene.validate, summary.validation_count};
    if (folder && failure) leave_reproducer(*folder, request, scene, range, *checkpoints, *failure, manifest);
    if (folder && (summary.complete || failure)) end_with_manifest(*folder, manifest, failure, *checkpoints);
    if (failure) std::rethrow_exception(failure->error);
    return summary;
}

}  // namespace drape
