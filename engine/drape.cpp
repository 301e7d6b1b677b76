#include "drape.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "contacts.h"
#include "drape/simulation.h"
#include "frame_checks.h"
#include "graph/dump.h"
#include "output/frame_writer.h"
#include "output/json_text.h"
#include "output/kept_frames.h"
#include "output/manifest.h"
#include "output/png_sequence.h"
#include "output/progress.h"
#include "run_statistics.h"
#include "spirv_modules.h"

namespace drape {

namespace {

struct FrameRange {
    std::uint32_t start, end, step;
    std::uint32_t count() const { return (end - start) / step + 1; }
};

FrameRange frame_range(const RunRequest& request, const SceneDescription& scene, std::vector<std::string>& warnings) {
    const std::uint32_t last = scene.time.frame_count - 1;
    FrameRange range{request.start.value_or(0), request.end.value_or(last), request.step};
    if (range.step == 0) throw UsageError("--step must be at least 1");
    if (range.end > last) {
        warnings.push_back(fmt::format("the scene ends at frame {}: --end {} is clamped", last, range.end));
        range.end = last;
    }
    if (range.start > range.end)
        throw UsageError(
            fmt::format("no frame to write: --start {} is after the last frame {}", range.start, range.end));
    return range;
}

struct LoadedScene {
    SceneDescription description;
    std::string text;  ///< of the file
    std::string hash;  ///< of the text and the overrides: what decides the result besides program and device
    std::vector<std::string> warnings;
};

LoadedScene load(const SceneRequest& request) {
    // Read once: what is hashed is what is run, also when the file changes meanwhile or is a pipe.
    SceneResult result = read_scene(request.path, request.overrides);
    if (!result.scene) throw SceneFailure(std::move(result));
    LoadedScene loaded{std::move(*result.scene), {}, {}, {}};
    for (const SceneError& warning : result.warnings) loaded.warnings.push_back(warning.text());
    std::vector<std::string> hashed{std::move(result.text)};
    hashed.insert(hashed.end(), request.overrides.begin(), request.overrides.end());
    loaded.hash = run_key(hashed);
    if (request.image_size) loaded.description.image.size = *request.image_size;
    if (request.samples) loaded.description.image.samples = *request.samples;
    loaded.text = std::move(hashed.front());
    return loaded;
}

/// The scene as it is run, on one line of JSON.
std::string resolved_text(const SceneRequest& request, const LoadedScene& loaded) {
    std::vector<std::string> overrides = request.overrides;
    const ImageSettings& image = loaded.description.image;
    if (request.image_size) overrides.push_back(fmt::format("/image/size=[{},{}]", image.size[0], image.size[1]));
    if (request.samples) overrides.push_back(fmt::format("/image/samples={}", image.samples));
    std::istringstream text(resolved_scene(loaded.text, overrides));
    Json::Value value;
    text >> value;
    return json_line(value);
}

/// Two runs with the same key give the same bytes for the same frame.
std::string key_of(const RunRequest& request, const LoadedScene& scene, const DeviceInfo& device) {
    std::vector<std::string> parts{program_version(), scene.hash, device.uuid_text(), device.driver,
                                   device.driver_version};
    for (const SpirvModule& module : spirv_modules()) parts.push_back(xxh3_128_hex(std::as_bytes(module.words)));
    const ImageSettings& image = scene.description.image;
    parts.push_back(request.draws() ? fmt::format("picture {}x{} {}", image.size[0], image.size[1], image.samples)
                                    : "arrays");
    return run_key(parts);
}

std::vector<const OutputFormat*> asked_formats(const RunRequest& request) {
    std::vector<const OutputFormat*> formats;
    for (const std::string& name : request.formats) {
        const OutputFormat* format = find_output_format(name);
        if (!format) throw UsageError(fmt::format("there is no output format '{}'", name));
        if (std::ranges::find(formats, format) == formats.end()) formats.push_back(format);
    }
    return formats;
}

void check_stream(const RunRequest& request) {
    const auto formats = asked_formats(request);
    if (formats.size() != 1 || !formats[0]->stream)
        throw UsageError(fmt::format("a stream takes one format, of {}", stream_format_names()));
    if (request.existing != ExistingFiles::refuse) throw UsageError("a stream cannot be overwritten or resumed");
}

/// Where finished frames go: the writers of the formats, statistics, times.
class Sink {
  public:
    /// `folder`: nothing for a stream; `kept`: frames whose pictures are there already.
    Sink(std::optional<OutputFolder>& folder, const RunRequest& request, const SceneDescription& scene,
         const WrittenRun& run, const std::map<std::uint32_t, KeptFrame>& kept)
        : scene_(scene), kept_(kept), details_(request.details()) {
        for (const OutputFormat* format : asked_formats(request))
            writers_.push_back({format, folder ? format->open(*folder, run) : format->stream(request.stream, run)});
        for (const auto& [frame, picture] : kept) statistics_.add(frame, picture.values);
    }

    void add(const FinishedFrame& frame) {
        const std::vector<std::vector<std::int16_t>> contacts = touched(frame);
        const WrittenFrame written{frame.frame,
                                   frame.rgba,
                                   frame.positions,
                                   frame.velocities,
                                   {contacts.begin(), contacts.end()},
                                   frame_values(scene_, frame)};
        statistics_.add(frame.frame, written.values);
        for (const Writer& writer : writers_)
            if (!writer.format->draws || !kept_.contains(frame.frame)) writer.files->add(written);
        for (const StageTime& timing : frame.timings) stages_[timing.name].push_back(timing.milliseconds);
        const auto now = std::chrono::steady_clock::now();
        frame_ms_.push_back(std::chrono::duration<double, std::milli>(now - last_).count());
        last_ = now;
    }

    void add_cut(const Cut& cut) {
        cuts_.push_back({cut.frame, scene_.cloths[cut.cloth].name, cut.springs, cut.triangles});
        for (const Writer& writer : writers_) writer.files->set_faces(cut.frame + 1, cut.cloth, cut.faces);
    }

    const std::vector<Manifest::Cut>& cuts() const { return cuts_; }

    /// Of the frames added, and of those that a resumed run keeps.
    const RunStatistics& statistics() const { return statistics_; }

    /// The files of all formats, those kept included; of a run that was stopped only the files of single frames, as
    /// the others would look complete: `dropped` says which.
    std::vector<FileRecord> finish(bool complete, std::vector<std::string>& dropped) {
        std::vector<FileRecord> files;
        for (const Writer& writer : writers_) {
            if (complete || writer.format->frame_files)
                std::ranges::move(writer.files->finish(), std::back_inserter(files));
            else
                dropped.emplace_back(writer.format->name);
        }
        for (const auto& [frame, picture] : kept_) files.push_back(picture.file);
        std::ranges::sort(files, {}, &FileRecord::name);
        return files;
    }

    void add_timings(Manifest& manifest) const {
        manifest.frame_time = summarize_frame_times(frame_ms_);
        for (const auto& [stage, times] : stages_)
            if (const auto summary = summarize_frame_times(times)) manifest.stage_median_ms[stage] = summary->median;
    }

  private:
    struct Writer {
        const OutputFormat* format;
        std::unique_ptr<FrameWriter> files;
    };

    std::vector<std::vector<std::int16_t>> touched(const FinishedFrame& frame) const {
        std::vector<std::vector<std::int16_t>> all;
        for (std::size_t cloth = 0; details_ && cloth < frame.positions.size(); ++cloth)
            all.push_back(touched_colliders(scene_, cloth, frame.frame / scene_.time.fps, frame.positions[cloth]));
        return all;
    }

    const SceneDescription& scene_;
    const std::map<std::uint32_t, KeptFrame>& kept_;
    bool details_;
    std::vector<Writer> writers_;
    std::vector<Manifest::Cut> cuts_;
    RunStatistics statistics_;
    std::map<std::string, std::vector<double>> stages_;
    std::vector<double> frame_ms_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Manifest describe_run(const RunRequest& request, const LoadedScene& loaded, const Simulation& simulation,
                      const DeviceInfo& device, const FrameRange& range) {
    const SceneDescription& scene = simulation.scene();
    const SimulationFacts facts = simulation.facts();
    Manifest manifest;
    manifest.program_version = program_version();
    manifest.scene = {request.scene.path, scene.name, loaded.hash, request.scene.overrides};
    manifest.device = {device.name, device.driver, device.driver_version, device.api_version, device.uuid_text()};
    manifest.frames = {range.start, range.end, range.step, range.count(), scene.time.fps};
    if (request.draws())
        manifest.picture = Manifest::Picture{scene.image.size[0], scene.image.size[1], scene.image.samples};
    const bool chosen = facts.asked_method != facts.method;
    manifest.solver = {facts.method,
                       facts.schedule,
                       scene.solver.substeps,
                       scene.solver.iterations,
                       scene.solver.tethers,
                       chosen ? facts.asked_method : "",
                       facts.choice_reason,
                       scene.solver.tolerance,
                       {}};
    for (const SimulationFacts::Skipped& skipped : facts.skipped)
        manifest.skipped.push_back({skipped.what, skipped.reason});
    for (const Compromise& each : facts.compromises)
        manifest.compromises.push_back({each.what, each.reason, each.enough_substeps});
    manifest.created = utc_timestamp();
    manifest.command_line = request.command_line;
    return manifest;
}

/// What the run chose, for who reads its arrays alone.
std::string run_parameters(const SceneDescription& scene, const Manifest& manifest) {
    Json::Value value(Json::objectValue);
    value["program_version"] = manifest.program_version;
    value["device"] = manifest.device.name;
    value["driver"] = manifest.device.driver + " " + manifest.device.driver_version;
    value["scene_hash"] = manifest.scene.hash;
    value["method"] = manifest.solver.method;
    value["schedule"] = manifest.solver.schedule;
    value["substeps"] = manifest.solver.substeps;
    value["iterations"] = manifest.solver.iterations;
    value["tolerance"] = manifest.solver.tolerance;
    value["fps"] = manifest.frames.fps;
    value["frame_step"] = Json::Int64(manifest.frames.step);
    value["overrides"] = value["colliders"] = Json::Value(Json::arrayValue);
    for (const std::string& each : manifest.scene.overrides) value["overrides"].append(each);
    std::map<int, int> counts;
    for (const Collider& collider : scene.colliders)
        value["colliders"].append(
            fmt::format("/colliders/{}/{}", collider_lists[collider.shape.index()], counts[collider.kind()]++));
    return json_line(value);
}

WrittenRun written_run(const RunRequest& request, const LoadedScene& loaded, const Simulation& simulation,
                       const Manifest& manifest) {
    const SceneDescription& scene = simulation.scene();
    WrittenRun run;
    run.start = static_cast<std::uint32_t>(manifest.frames.start);
    run.end = static_cast<std::uint32_t>(manifest.frames.end);
    run.step = static_cast<std::uint32_t>(manifest.frames.step);
    run.fps = scene.time.fps;
    run.cuts = !scene.cutters.empty();
    run.width = scene.image.size[0], run.height = scene.image.size[1];
    run.key = manifest.run_key;
    run.seed = scene.wind.gust.seed;
    if (request.details()) {
        run.scene = resolved_text(request.scene, loaded);
        run.parameters = run_parameters(scene, manifest);
    }
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
        const Cloth& description = scene.cloths[cloth];
        run.cloths.push_back({scene.cloths.size() == 1 ? "" : description.name, description.grid[0],
                              description.grid[1], simulation.triangles(cloth), description.name});
    }
    return run;
}

SimulationOptions simulation_options(const SceneRequest& request, bool draw, bool positions, bool velocities) {
    SimulationOptions options;
    options.draw = draw;
    options.positions = positions;
    options.velocities = velocities;
    options.skip = request.skip;
    options.schedule = request.schedule;
    return options;
}

SimulationOptions run_options(const RunRequest& request) {
    const bool positions =
        std::ranges::any_of(asked_formats(request), [](const OutputFormat* format) { return !format->draws; });
    SimulationOptions options = simulation_options(request.scene, request.draws(), positions, request.details());
    options.keep_promises = !request.keep_failed;
    return options;
}

Device device_of(const SceneRequest& request) {
    return Device(request.device, request.validate ? Validation::print : Validation::off);
}

/// What `-v` says before the first frame.
std::vector<std::string> notes(const Device& device, const Simulation& simulation) {
    const DeviceInfo& info = device.info();
    const SceneDescription& scene = simulation.scene();
    const SimulationFacts facts = simulation.facts();
    std::uint64_t particle_count = 0;
    for (const Cloth& cloth : scene.cloths) particle_count += std::uint64_t{cloth.grid[0]} * cloth.grid[1];
    return {
        fmt::format("device {}: {} ({}), driver {} {}, Vulkan {}, UUID {}", info.index, info.name, info.type,
                    info.driver, info.driver_version, info.api_version, info.uuid_text()),
        fmt::format("scene: {} cloth{}, {} particles, {} substeps x {} iterations", scene.cloths.size(),
                    scene.cloths.size() == 1 ? "" : "s", particle_count, scene.solver.substeps,
                    scene.solver.iterations),
        fmt::format("solver: {}{}", facts.method, facts.asked_method != facts.method ? ": " + facts.choice_reason : ""),
        fmt::format("plan: {} passes, {} barriers in a frame that is written, {} passes, {} barriers in one that is "
                    "only simulated; `drape graph` lists them, and what was skipped",
                    facts.pass_count, facts.barrier_count, facts.simulated_pass_count, facts.simulated_barrier_count),
        fmt::format("device memory: {} of at most {}", graph::size_text(device.memory_used()),
                    graph::size_text(device.memory_limit()))};
}

/// Frames of the range that have to be handed out, and those whose pictures are there already.
struct MissingFrames {
    std::set<std::uint32_t> frames;
    std::map<std::uint32_t, KeptFrame> kept;
};

MissingFrames missing_frames(const std::optional<OutputFolder>& folder, const RunRequest& request,
                             const FrameRange& range, const std::string& key) {
    std::map<std::string, KeptFrame> there;
    if (folder && request.existing == ExistingFiles::resume) there = kept_frames(*folder, key);
    const bool only_pictures =
        std::ranges::all_of(asked_formats(request), [](const OutputFormat* format) { return format->draws; });
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

/// How a run ended before its end that would end there again.
struct RunFailure {
    std::string status, reason;
    std::exception_ptr error;
};

/// What is said at the end of a run that went on.
RunFailure kept_failure(const FrameFailure& failure) {
    const std::string text = failure.reason + "; it and what came after are kept, as --on-failure keep asks";
    if (failure.kind == FrameFailure::Kind::tolerance)
        return {"tolerance missed", failure.reason, std::make_exception_ptr(ToleranceMissed(text))};
    return {"diverged", failure.reason, std::make_exception_ptr(Diverged(text))};
}

/// Simulates up to the last missing frame and writes the missing ones. Returns whether it was not stopped.
bool write_frames(Simulation& simulation, Sink& sink, const MissingFrames& missing, std::uint32_t last,
                  const RunRequest& request, RunSummary& summary, std::optional<RunFailure>& failure) {
    // A run again would fail again at the same frame: what came before it is the result.
    const auto fail = [&]<class Error>(const char* status, const Error& error) {
        const std::string kept = summary.frame_count > 0
                                     ? fmt::format("; what was written before it is kept ({} of {} frames)",
                                                   summary.frame_count, missing.frames.size())
                                     : std::string("; nothing was written");
        failure = {status, error.what(), std::make_exception_ptr(Error(error.what() + kept))};
        return false;
    };
    Progress progress(missing.frames.size(), Progress::standard_options(request.quiet));
    try {
        return simulation.run(
            last, [&](std::uint32_t frame) { return missing.frames.contains(frame); },
            [&](const FinishedFrame& frame) {
                if (frame.failure && frame.failure->kind == FrameFailure::Kind::not_finite) raise(*frame.failure);
                if (frame.failure && !failure) failure = kept_failure(*frame.failure);
                sink.add(frame);
                progress.frame_done(frame.frame, sink.statistics().note(frame.frame));
                if (!missing.kept.contains(frame.frame)) ++summary.frame_count;
            },
            request.stop);
    } catch (const Diverged& error) {
        return fail("diverged", error);
    } catch (const ToleranceMissed& error) {
        return fail("tolerance missed", error);
    }
}

/// What a run that names its method is told where it misses what `auto` keeps.
std::optional<std::string> missed_limits(const SimulationFacts& facts, const RunStatistics& statistics) {
    if (facts.limits_are_kept) return std::nullopt;
    const double rms = statistics.worst_of_run("/stretch_error_rms").value_or(0),
                 largest = statistics.worst_of_run("/stretch_error_max").value_or(0);
    if (rms <= facts.tolerance_rms && largest <= facts.tolerance_worst) return std::nullopt;
    return fmt::format(
        "the stretch error came to {:.3g} RMS and {:.3g} in a single spring; method auto would have kept {:.3g} and "
        "{:.3g}",
        rms, largest, facts.tolerance_rms, facts.tolerance_worst);
}

}  // namespace

const char* program_version() { return DRAPE_VERSION; }

bool RunRequest::draws() const {
    return std::ranges::any_of(asked_formats(*this), [](const OutputFormat* format) { return format->draws; });
}

bool RunRequest::details() const {
    return std::ranges::any_of(asked_formats(*this), [](const OutputFormat* format) { return format->details; });
}

RunSummary run_scene(const RunRequest& request) {
    RunSummary summary;
    const LoadedScene scene = load(request.scene);
    summary.warnings = scene.warnings;
    const FrameRange range = frame_range(request, scene.description, summary.warnings);
    const auto say = [&](const std::string& text) {
        if (request.message) request.message(text);
    };
    for (const std::string& warning : summary.warnings) say("warning: " + warning);
    std::optional<OutputFolder> folder;
    if (request.stream) check_stream(request);
    if (!request.stream) folder.emplace(request.output, request.existing);

    prefer_calling_thread(scene.description, request.draws());
    const Device device = device_of(request.scene);
    const std::string key = key_of(request, scene, device.info());
    const MissingFrames missing = missing_frames(folder, request, range, key);
    summary.kept_count = missing.kept.size();
    Manifest manifest;
    std::optional<RunFailure> failure;
    {
        Sink* cut_sink = nullptr;
        SimulationOptions options = run_options(request);
        options.on_cut = [&](const Cut& cut) { cut_sink->add_cut(cut); };
        Simulation simulation(scene.description, options, device);
        for (const Compromise& each : simulation.facts().compromises) {
            summary.warnings.push_back(each.what + ": " + each.reason);
            say("warning: " + summary.warnings.back());
        }
        if (request.verbose) std::ranges::for_each(notes(device, simulation), say);
        manifest = describe_run(request, scene, simulation, device.info(), range);
        manifest.run_key = key;
        Sink sink(folder, request, simulation.scene(), written_run(request, scene, simulation, manifest), missing.kept);
        cut_sink = &sink;
        // Frames that a resumed run keeps still cut: the manifest lists every cut.
        const bool to_the_end = !scene.description.cutters.empty();
        const std::uint32_t last = to_the_end || missing.frames.empty() ? range.end : *missing.frames.rbegin();
        summary.complete = (missing.frames.empty() && !to_the_end) ||
                           write_frames(simulation, sink, missing, last, request, summary, failure);
        if (const auto warning = missed_limits(simulation.facts(), sink.statistics())) {
            summary.warnings.push_back(*warning);
            say("warning: " + *warning);
        }
        manifest.cuts = sink.cuts();
        manifest.statistics = sink.statistics().frames();
        manifest.solver.stretch_error = sink.statistics().worst_of_run("/stretch_error_rms");
        manifest.files = sink.finish(summary.complete || (failure && summary.frame_count > 0), summary.dropped);
        sink.add_timings(manifest);
    }
    summary.validation_count = device.validation_count();
    manifest.validation = {request.scene.validate, summary.validation_count};
    if (failure) {
        manifest.status = failure->status;
        manifest.failure = failure->reason;
    }
    if (folder && (summary.complete || (failure && summary.frame_count > 0))) write_manifest(*folder, manifest);
    if (failure) std::rethrow_exception(failure->error);
    return summary;
}

SceneDescription asked_scene(const SceneRequest& request) { return load(request).description; }

std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format) {
    const SceneDescription scene = load(request).description;
    return Simulation(scene, simulation_options(request, draw, !draw, !draw), device_of(request)).describe_plan(format);
}

}  // namespace drape
