#include "drape.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "frame_loop.h"
#include "graph/dump.h"
#include "output/frame_writer.h"
#include "output/kept_frames.h"
#include "output/manifest.h"
#include "output/png_sequence.h"
#include "output/progress.h"
#include "run_statistics.h"
#include "spirv_modules.h"

namespace drape {

namespace {

std::string failure_text(const SceneResult& result) {
    std::string text;
    for (const SceneError& error : result.errors) {
        if (!text.empty()) text += '\n';
        text += error.text();
    }
    return text;
}

struct FrameRange {
    std::uint32_t start, end, step;
    bool wants(std::uint32_t frame) const { return frame >= start && frame <= end && (frame - start) % step == 0; }
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
    std::string hash;  ///< of the text and the overrides: what decides the result besides program and device
    std::vector<std::string> warnings;
};

LoadedScene load(const SceneRequest& request) {
    // Read once: what is hashed is what is run, also when the file changes meanwhile or is a pipe.
    SceneResult result = read_scene(request.path, request.overrides);
    if (!result.scene) throw SceneFailure(std::move(result));
    LoadedScene loaded{std::move(*result.scene), {}, {}};
    for (const SceneError& warning : result.warnings) loaded.warnings.push_back(warning.text());
    std::vector<std::string> hashed{std::move(result.text)};
    hashed.insert(hashed.end(), request.overrides.begin(), request.overrides.end());
    loaded.hash = run_key(hashed);
    if (request.image_size) loaded.description.image.size = *request.image_size;
    if (request.samples) loaded.description.image.samples = *request.samples;
    return loaded;
}

/// Two runs with the same key give the same bytes for the same frame.
std::string key_of(const RunRequest& request, const LoadedScene& scene, const vulkan::DeviceInfo& device) {
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

WrittenRun written_run(const SimulationModel& model, const FrameRange& range, const std::string& key) {
    const SceneDescription& scene = model.scene;
    WrittenRun run;
    run.start = range.start, run.end = range.end, run.step = range.step, run.fps = scene.time.fps;
    run.cuts = !scene.cutters.empty();
    run.width = scene.image.size[0], run.height = scene.image.size[1];
    run.key = key;
    for (const ClothModel& cloth : model.cloths)
        run.cloths.push_back({model.cloths.size() == 1 ? "" : cloth.name, cloth.grid.columns(), cloth.grid.rows(),
                              cloth.grid.triangle_indices()});
    return run;
}

/// Where finished frames go: the writers of the formats, statistics, times.
class Sink {
  public:
    /// `kept`: frames whose pictures are there already.
    Sink(OutputFolder& folder, const RunRequest& request, const SimulationModel& model, const WrittenRun& run,
         const std::map<std::uint32_t, KeptFrame>& kept)
        : model_(model), kept_(kept) {
        for (const OutputFormat* format : asked_formats(request))
            writers_.push_back({format, format->open(folder, run)});
        for (const auto& [frame, picture] : kept) statistics_.add(frame, picture.values);
    }

    /// Throws Diverged or ToleranceMissed before anything of the frame is kept.
    void add(const FinishedFrame& frame) {
        if (const auto why = divergence(model_, frame.frame, frame.statistics)) throw Diverged(*why);
        if (const auto why = missed_tolerance(model_, frame.frame, frame.statistics)) throw ToleranceMissed(*why);
        const WrittenFrame written{frame.frame, frame.rgba, frame.positions, frame_values(model_, frame.statistics)};
        statistics_.add(frame.frame, written.values);
        for (const Writer& writer : writers_)
            if (!writer.format->draws || !kept_.contains(frame.frame)) writer.files->add(written);
        for (const graph::Timing& timing : frame.timings) stages_[timing.name].push_back(timing.milliseconds);
        const auto now = std::chrono::steady_clock::now();
        frame_ms_.push_back(std::chrono::duration<double, std::milli>(now - last_).count());
        last_ = now;
    }

    void add_cut(const CutEvent& event, const CutTopology& topology) {
        cuts_.push_back({event.frame, topology.cloth().name, event.counts.springs, event.counts.triangles});
        const std::vector<std::uint32_t> faces = topology.whole_triangles();
        for (const Writer& writer : writers_) writer.files->set_faces(event.frame + 1, event.cloth, faces);
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

    const SimulationModel& model_;
    const std::map<std::uint32_t, KeptFrame>& kept_;
    std::vector<Writer> writers_;
    std::vector<Manifest::Cut> cuts_;
    RunStatistics statistics_;
    std::map<std::string, std::vector<double>> stages_;
    std::vector<double> frame_ms_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Manifest describe_run(const RunRequest& request, const LoadedScene& loaded, const SimulationModel& model,
                      const vulkan::Device& device, const FrameLoop& loop, const FrameRange& range) {
    const SceneDescription& scene = model.scene;
    const vulkan::DeviceInfo& info = device.info();
    Manifest manifest;
    manifest.program_version = program_version();
    manifest.scene = {request.scene.path, scene.name, loaded.hash, request.scene.overrides};
    manifest.device = {info.name, info.driver, info.driver_version, info.api_version, info.uuid_text()};
    manifest.frames = {range.start, range.end, range.step, range.count(), scene.time.fps};
    if (request.draws())
        manifest.picture = Manifest::Picture{scene.image.size[0], scene.image.size[1], scene.image.samples};
    const bool chosen = model.asked_method == SolverMethod::automatic;
    manifest.solver = {std::string(model.method().name),
                       scene.solver.substeps,
                       scene.solver.iterations,
                       scene.solver.tethers,
                       chosen ? std::string(named(model.asked_method).name) : "",
                       model.choice.reason,
                       scene.solver.tolerance,
                       {}};
    for (const graph::Skipped& skipped : loop.plan(FrameKind::simulate_and_output).skipped)
        manifest.skipped.push_back({skipped.what, skipped.reason});
    for (const Compromise& each : model.compromises())
        manifest.compromises.push_back({each.what, each.reason, each.enough_substeps});
    manifest.created = utc_timestamp();
    manifest.command_line = request.command_line;
    return manifest;
}

ModelOptions model_options(const SceneRequest& request, const vulkan::Device& device) {
    return {.skip = request.skip, .device = device_kind(device.info())};
}

FrameLoopOptions loop_options(const SceneDescription& scene, bool draw, bool positions) {
    FrameLoopOptions options;
    options.draw = draw;
    options.positions = positions;
    options.statistics = true;
    options.width = scene.image.size[0];
    options.height = scene.image.size[1];
    options.samples = scene.image.samples;
    return options;
}

/// What `-v` says before the first frame.
std::vector<std::string> notes(const vulkan::Device& device, const SimulationModel& model, const FrameLoop& loop) {
    const vulkan::DeviceInfo& info = device.info();
    std::uint64_t particle_count = 0;
    for (const ClothModel& cloth : model.cloths) particle_count += cloth.grid.particle_count();
    const auto plan_text = [&](FrameKind kind) {
        const graph::Plan& plan = loop.plan(kind);
        return fmt::format("{} passes, {} barriers", plan.passes.size(), graph::barrier_count(plan));
    };
    const vulkan::MemoryBudget& budget = device.budget();
    return {fmt::format("device {}: {} ({}), driver {} {}, Vulkan {}, UUID {}", info.index, info.name, info.type,
                        info.driver, info.driver_version, info.api_version, info.uuid_text()),
            fmt::format("scene: {} cloth{}, {} particles, {} substeps x {} iterations", model.cloths.size(),
                        model.cloths.size() == 1 ? "" : "s", particle_count, model.scene.solver.substeps,
                        model.scene.solver.iterations),
            fmt::format("solver: {}{}", model.method().name,
                        model.asked_method == SolverMethod::automatic ? ": " + model.choice.reason : ""),
            fmt::format("plan: {} in a frame that is written, {} in one that is only simulated; `drape graph` "
                        "lists them, and what was skipped",
                        plan_text(FrameKind::simulate_and_output), plan_text(FrameKind::simulate)),
            fmt::format("device memory: {} of at most {}", graph::size_text(budget.used()),
                        graph::size_text(budget.limit()))};
}

/// Frames of the range that have to be handed out, and those whose pictures are there already.
struct MissingFrames {
    std::set<std::uint32_t> frames;
    std::map<std::uint32_t, KeptFrame> kept;
};

MissingFrames missing_frames(const OutputFolder& folder, const RunRequest& request, const FrameRange& range,
                             const std::string& key) {
    std::map<std::string, KeptFrame> there;
    if (request.existing == ExistingFiles::resume) there = kept_frames(folder, key);
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

/// Simulates up to the last missing frame and writes the missing ones. Returns whether it was not stopped.
bool write_frames(FrameLoop& loop, Sink& sink, const MissingFrames& missing, std::uint32_t last,
                  const RunRequest& request, RunSummary& summary) {
    // A run again would fail again at the same frame: what came before it is the result.
    const auto keep_the_rest = [&](const std::runtime_error& error) {
        if (summary.frame_count > 0) sink.finish(true, summary.dropped);
        const std::string kept = fmt::format("; what was written before it is kept ({} of {} frames)",
                                             summary.frame_count, missing.frames.size());
        return error.what() + (summary.frame_count > 0 ? kept : std::string());
    };
    Progress progress(missing.frames.size(), Progress::standard_options(request.quiet));
    try {
        return loop.run(
            last, [&](std::uint32_t frame) { return missing.frames.contains(frame); },
            [&](const FinishedFrame& frame) {
                sink.add(frame);
                progress.frame_done(frame.frame, sink.statistics().note(frame.frame));
                if (!missing.kept.contains(frame.frame)) ++summary.frame_count;
            },
            request.stop);
    } catch (const Diverged& error) {
        throw Diverged(keep_the_rest(error));
    } catch (const ToleranceMissed& error) {
        throw ToleranceMissed(keep_the_rest(error));
    }
}

}  // namespace

SceneFailure::SceneFailure(SceneResult result) : std::runtime_error(failure_text(result)), result_(std::move(result)) {}

const char* program_version() { return DRAPE_VERSION; }

bool RunRequest::draws() const {
    return std::ranges::any_of(asked_formats(*this), [](const OutputFormat* format) { return format->draws; });
}

SceneDescription load_scene(const SceneRequest& request, std::vector<std::string>* warnings) {
    LoadedScene loaded = load(request);
    if (warnings) warnings->insert(warnings->end(), loaded.warnings.begin(), loaded.warnings.end());
    return std::move(loaded.description);
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
    OutputFolder folder(request.output, request.existing);

    const vulkan::Instance instance({.validation = request.scene.validate});
    const vulkan::Device device(instance, request.scene.device);
    const std::string key = key_of(request, scene, device.info());
    const MissingFrames missing = missing_frames(folder, request, range, key);
    summary.kept_count = missing.kept.size();
    const SimulationModel model(scene.description, model_options(request.scene, device));
    for (const Compromise& each : model.compromises()) {
        summary.warnings.push_back(each.what + ": " + each.reason);
        say("warning: " + summary.warnings.back());
    }
    Manifest manifest;
    {
        Sink* cut_sink = nullptr;
        FrameLoopOptions options = loop_options(
            scene.description, request.draws(),
            std::ranges::any_of(asked_formats(request), [](const OutputFormat* format) { return !format->draws; }));
        options.on_cut = [&](const CutEvent& event, const CutTopology& topology) {
            if (cut_sink) cut_sink->add_cut(event, topology);
        };
        FrameLoop loop(device, model, options);
        if (request.verbose) std::ranges::for_each(notes(device, model, loop), say);
        manifest = describe_run(request, scene, model, device, loop, range);
        manifest.run_key = key;
        Sink sink(folder, request, model, written_run(model, range, key), missing.kept);
        cut_sink = &sink;
        // Frames that a resumed run keeps still cut: the manifest lists every cut.
        const bool to_the_end = !scene.description.cutters.empty();
        const std::uint32_t last = to_the_end || missing.frames.empty() ? range.end : *missing.frames.rbegin();
        summary.complete =
            (missing.frames.empty() && !to_the_end) || write_frames(loop, sink, missing, last, request, summary);
        manifest.cuts = sink.cuts();
        manifest.statistics = sink.statistics().frames();
        manifest.solver.stretch_error = sink.statistics().worst_stretch_error();
        manifest.files = sink.finish(summary.complete, summary.dropped);
        sink.add_timings(manifest);
    }
    summary.validation_count = instance.validation_log().count();
    manifest.validation = {request.scene.validate, summary.validation_count};
    if (summary.complete) write_manifest(folder, manifest);
    return summary;
}

std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format) {
    const SceneDescription scene = load_scene(request);
    const vulkan::Instance instance({.validation = request.validate});
    const vulkan::Device device(instance, request.device);
    const SimulationModel model(scene, model_options(request, device));
    const FrameLoop loop(device, model, loop_options(scene, draw, !draw));
    return graph::dump(loop.graph(FrameKind::simulate_and_output), loop.plan(FrameKind::simulate_and_output), format);
}

}  // namespace drape
