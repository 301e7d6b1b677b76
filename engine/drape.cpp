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
#include "output/kept_frames.h"
#include "output/manifest.h"
#include "output/npy.h"
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
    parts.push_back(request.draw ? fmt::format("picture {}x{} {}", image.size[0], image.size[1], image.samples)
                                 : "arrays");
    return run_key(parts);
}

/// Where finished frames go: PNG files, position arrays, times.
class Sink {
  public:
    Sink(OutputFolder& folder, const SimulationModel& model, const RunRequest& request, const FrameRange& range,
         const std::string& key)
        : folder_(folder), export_faces_(request.export_npy), model_(model), scene_(model.scene) {
        if (request.draw) {
            const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
            pictures_ = std::make_unique<PngSequence>(folder, frame_digits(range.end), std::min(cores, 4u), key);
        }
        if (!request.export_npy) return;
        for (std::size_t cloth = 0; !model.scene.cutters.empty() && cloth < model.cloths.size(); ++cloth)
            write_face_list(0, cloth, model.cloths[cloth].grid.triangle_indices());
        for (const ClothModel& cloth : model.cloths) {
            const std::string name =
                model.cloths.size() == 1 ? "positions.npy" : fmt::format("positions_{}.npy", cloth.name);
            arrays_.push_back(
                std::make_unique<NpyWriter>(folder, name, range.count(), cloth.grid.rows(), cloth.grid.columns()));
        }
    }

    /// Throws Diverged or ToleranceMissed before anything of the frame is kept.
    void add(const FinishedFrame& frame) {
        if (const auto why = divergence(model_, frame.frame, frame.statistics)) throw Diverged(*why);
        if (const auto why = missed_tolerance(model_, frame.frame, frame.statistics)) throw ToleranceMissed(*why);
        FrameValues values = frame_values(model_, frame.statistics);
        statistics_.add(frame.frame, values);
        if (pictures_) {
            std::vector<std::uint8_t> rgba = pictures_->take_buffer(frame.rgba.size());
            std::ranges::copy(frame.rgba, rgba.begin());
            pictures_->submit(frame.frame, scene_.image.size[0], scene_.image.size[1], std::move(rgba),
                              std::move(values));
        }
        for (std::size_t cloth = 0; cloth < arrays_.size(); ++cloth)
            arrays_[cloth]->append_frame_xyzw(frame.positions[cloth]);
        for (const graph::Timing& timing : frame.timings) stages_[timing.name].push_back(timing.milliseconds);
        const auto now = std::chrono::steady_clock::now();
        frame_ms_.push_back(std::chrono::duration<double, std::milli>(now - last_).count());
        last_ = now;
    }

    /// The face list after a cut is named for the first frame that it holds for.
    void add_cut(const CutEvent& event, const ClothModel& cloth, const CutTopology& topology) {
        cuts_.push_back({event.frame, cloth.name, event.counts.springs, event.counts.triangles});
        if (export_faces_) write_face_list(event.frame + 1, event.cloth, topology.whole_triangles(cloth));
    }

    const std::vector<Manifest::Cut>& cuts() const { return cuts_; }

    /// Of the frames added, and of those that a resumed run keeps.
    RunStatistics& statistics() { return statistics_; }

    std::vector<FileRecord> finish() {
        std::vector<FileRecord> files = std::move(face_files_);
        if (pictures_) {
            const std::vector<FileRecord> pictures = pictures_->finish();
            files.insert(files.end(), pictures.begin(), pictures.end());
        }
        for (const auto& array : arrays_) files.push_back(array->finish());
        return files;
    }

    void add_timings(Manifest& manifest) const {
        manifest.frame_time = summarize_frame_times(frame_ms_);
        for (const auto& [stage, times] : stages_)
            if (const auto summary = summarize_frame_times(times)) manifest.stage_median_ms[stage] = summary->median;
    }

  private:
    void write_face_list(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) {
        const std::string own = model_.cloths.size() == 1 ? "" : model_.cloths[cloth].name + "_";
        face_files_.push_back(write_faces(folder_, fmt::format("faces_{}{:04}.npy", own, frame), faces));
    }

    OutputFolder& folder_;
    bool export_faces_;
    std::vector<FileRecord> face_files_;
    std::vector<Manifest::Cut> cuts_;
    RunStatistics statistics_;
    const SimulationModel& model_;
    const SceneDescription& scene_;
    std::unique_ptr<PngSequence> pictures_;
    std::vector<std::unique_ptr<NpyWriter>> arrays_;
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
    if (request.draw)
        manifest.picture = Manifest::Picture{scene.image.size[0], scene.image.size[1], scene.image.samples};
    const bool chosen = model.asked_method == SolverMethod::automatic;
    manifest.solver = {model.method_name(),  scene.solver.substeps, scene.solver.iterations, scene.solver.tethers,
                       chosen ? "auto" : "", model.choice.reason,   scene.solver.tolerance,  {}};
    for (const graph::Skipped& skipped : loop.plan(FrameKind::simulate_and_output).skipped)
        manifest.skipped.push_back({skipped.what, skipped.reason});
    manifest.created = utc_timestamp();
    manifest.command_line = request.command_line;
    return manifest;
}

ModelOptions model_options(const SceneRequest& request, const vulkan::Device& device) {
    return {.skip = request.skip, .device = device.info().type == "cpu" ? DeviceKind::cpu : DeviceKind::gpu};
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
            fmt::format("solver: {}{}", model.method_name(),
                        model.asked_method == SolverMethod::automatic ? ": " + model.choice.reason : ""),
            fmt::format("plan: {} in a frame that is written, {} in one that is only simulated; `drape graph` "
                        "lists them, and what was skipped",
                        plan_text(FrameKind::simulate_and_output), plan_text(FrameKind::simulate)),
            fmt::format("device memory: {} of at most {}", graph::size_text(budget.used()),
                        graph::size_text(budget.limit()))};
}

/// The frames of the range whose pictures are not there yet, and those that are.
struct MissingFrames {
    std::set<std::uint32_t> frames;
    std::map<std::uint32_t, KeptFrame> kept;
};

MissingFrames missing_frames(const OutputFolder& folder, const RunRequest& request, const FrameRange& range,
                             const std::string& key) {
    std::map<std::string, KeptFrame> there;
    if (request.existing == ExistingFiles::resume) there = kept_frames(folder, key);
    MissingFrames missing;
    for (std::uint64_t frame = range.start; frame <= range.end; frame += range.step) {
        const auto kept = there.find(frame_file_name(frame, frame_digits(range.end)));
        if (request.draw && kept != there.end())
            missing.kept.emplace(static_cast<std::uint32_t>(frame), kept->second);
        else
            missing.frames.insert(static_cast<std::uint32_t>(frame));
    }
    return missing;
}

/// Simulates up to the last missing frame and writes the missing ones. Returns whether it was not stopped.
bool write_frames(FrameLoop& loop, Sink& sink, const MissingFrames& missing, std::uint32_t last,
                  const RunRequest& request, RunSummary& summary) {
    // A run again would fail again at the same frame: what came before it is the result.
    const auto keep_the_rest = [&](const std::runtime_error& error) {
        if (summary.frame_count > 0) sink.finish();
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
                ++summary.frame_count;
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
    Manifest manifest;
    {
        Sink* cut_sink = nullptr;
        FrameLoopOptions options = loop_options(scene.description, request.draw, request.export_npy);
        options.on_cut = [&](const CutEvent& event, const ClothModel& cloth, const CutTopology& topology) {
            if (cut_sink) cut_sink->add_cut(event, cloth, topology);
        };
        FrameLoop loop(device, model, options);
        if (request.verbose) std::ranges::for_each(notes(device, model, loop), say);
        manifest = describe_run(request, scene, model, device, loop, range);
        manifest.run_key = key;
        Sink sink(folder, model, request, range, key);
        cut_sink = &sink;
        for (const auto& [frame, kept] : missing.kept) sink.statistics().add(frame, kept.values);
        // Frames that a resumed run keeps still cut: the manifest lists every cut.
        const bool to_the_end = !scene.description.cutters.empty();
        const std::uint32_t last = to_the_end || missing.frames.empty() ? range.end : *missing.frames.rbegin();
        summary.complete =
            (missing.frames.empty() && !to_the_end) || write_frames(loop, sink, missing, last, request, summary);
        manifest.cuts = sink.cuts();
        manifest.statistics = sink.statistics().frames();
        manifest.solver.stretch_error = sink.statistics().worst_stretch_error();
        // Arrays of a stopped run would look complete; its pictures each are.
        if (summary.complete || request.draw) manifest.files = sink.finish();
        for (const auto& [frame, kept] : missing.kept) manifest.files.push_back(kept.file);
        std::ranges::sort(manifest.files, {}, &FileRecord::name);
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
