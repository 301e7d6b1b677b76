#include "drape.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include "frame_loop.h"
#include "output/manifest.h"
#include "output/npy.h"
#include "output/png_sequence.h"
#include "output/progress.h"

namespace drape {

namespace {

std::string failure_text(const SceneResult& result) {
    std::string text;
    for (const SceneError& error : result.errors) text += (text.empty() ? "" : "\n") + error.text();
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
        throw UsageError(fmt::format("no frame to write: --start {} is after the last frame {}", range.start, range.end));
    return range;
}

/// Hash of the file's bytes and the overrides: what decides the result besides program and device.
std::string scene_hash(const SceneRequest& request) {
    std::ifstream file(request.path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const std::string& value : request.overrides) text += '\0' + value;
    return xxh3_128_hex(std::as_bytes(std::span(text)));
}

/// Where finished frames go: PNG files, position arrays, times.
class Sink {
  public:
    Sink(OutputFolder& folder, const SimulationModel& model, const RunRequest& request, const FrameRange& range)
        : scene_(model.scene) {
        if (request.draw) {
            const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
            pictures_ = std::make_unique<PngSequence>(folder, frame_digits(range.end), std::min(cores, 4u));
        }
        if (!request.export_npy) return;
        for (const ClothModel& cloth : model.cloths) {
            const std::string name =
                model.cloths.size() == 1 ? "positions.npy" : fmt::format("positions_{}.npy", cloth.name);
            arrays_.push_back(std::make_unique<NpyWriter>(folder, name, range.count(), cloth.grid.rows(),
                                                          cloth.grid.columns()));
        }
    }

    void add(const FinishedFrame& frame) {
        if (pictures_) {
            std::vector<std::uint8_t> rgba = pictures_->take_buffer(frame.rgba.size());
            std::ranges::copy(frame.rgba, rgba.begin());
            pictures_->submit(frame.frame, scene_.image.size[0], scene_.image.size[1], std::move(rgba));
        }
        for (std::size_t cloth = 0; cloth < arrays_.size(); ++cloth)
            arrays_[cloth]->append_frame_xyzw(frame.positions[cloth]);
        for (const graph::Timing& timing : frame.timings) stages_[timing.name].push_back(timing.milliseconds);
        const auto now = std::chrono::steady_clock::now();
        frame_ms_.push_back(std::chrono::duration<double, std::milli>(now - last_).count());
        last_ = now;
    }

    std::vector<FileRecord> finish() {
        std::vector<FileRecord> files;
        if (pictures_) files = pictures_->finish();
        for (const auto& array : arrays_) files.push_back(array->finish());
        return files;
    }

    void add_timings(Manifest& manifest) const {
        manifest.frame_time = summarize_frame_times(frame_ms_);
        for (const auto& [stage, times] : stages_)
            if (const auto summary = summarize_frame_times(times)) manifest.stage_median_ms[stage] = summary->median;
    }

  private:
    const SceneDescription& scene_;
    std::unique_ptr<PngSequence> pictures_;
    std::vector<std::unique_ptr<NpyWriter>> arrays_;
    std::map<std::string, std::vector<double>> stages_;
    std::vector<double> frame_ms_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Manifest describe_run(const RunRequest& request, const SimulationModel& model, const vulkan::Device& device,
                      const FrameLoop& loop, const FrameRange& range) {
    const SceneDescription& scene = model.scene;
    const vulkan::DeviceInfo& info = device.info();
    Manifest manifest;
    manifest.program_version = program_version();
    manifest.scene = {request.scene.path, scene.name, scene_hash(request.scene), request.scene.overrides};
    manifest.device = {info.name, info.driver, info.driver_version, info.api_version, info.uuid_text()};
    manifest.frames = {range.start, range.end, range.step, range.count(), scene.time.fps};
    manifest.solver = {"relax", scene.solver.substeps, scene.solver.iterations};
    for (const graph::Skipped& skipped : loop.plan(FrameKind::simulate_and_output).skipped)
        manifest.skipped.push_back({skipped.what, skipped.reason});
    manifest.created = utc_timestamp();
    manifest.command_line = request.command_line;
    return manifest;
}

FrameLoopOptions loop_options(const SceneDescription& scene, bool draw, bool positions) {
    FrameLoopOptions options;
    options.draw = draw;
    options.positions = positions;
    options.width = scene.image.size[0];
    options.height = scene.image.size[1];
    options.samples = scene.image.samples;
    return options;
}

}  // namespace

SceneFailure::SceneFailure(SceneResult result) : std::runtime_error(failure_text(result)), result_(std::move(result)) {}

const char* program_version() { return DRAPE_VERSION; }

SceneDescription load_scene(const SceneRequest& request, std::vector<std::string>* warnings) {
    SceneResult result = read_scene(request.path, request.overrides);
    if (!result.scene) throw SceneFailure(std::move(result));
    if (warnings)
        for (const SceneError& warning : result.warnings) warnings->push_back(warning.text());
    SceneDescription scene = std::move(*result.scene);
    if (request.image_size) scene.image.size = *request.image_size;
    if (request.samples) scene.image.samples = *request.samples;
    return scene;
}

RunSummary run_scene(const RunRequest& request) {
    RunSummary summary;
    const SceneDescription scene = load_scene(request.scene, &summary.warnings);
    const FrameRange range = frame_range(request, scene, summary.warnings);
    OutputFolder folder(request.output, request.existing);
    Progress progress(range.count(), Progress::standard_options(request.quiet));
    for (const std::string& warning : summary.warnings) progress.message("warning: " + warning);

    const vulkan::Instance instance({.validation = request.scene.validate});
    const vulkan::Device device(instance, request.scene.device);
    const SimulationModel model(scene, {.skip = request.scene.skip});
    Manifest manifest;
    {
        FrameLoop loop(device, model, loop_options(scene, request.draw, request.export_npy));
        manifest = describe_run(request, model, device, loop, range);
        Sink sink(folder, model, request, range);
        summary.complete = loop.run(
            range.end, [&](std::uint32_t frame) { return range.wants(frame); },
            [&](const FinishedFrame& frame) {
                sink.add(frame);
                progress.frame_done(frame.frame);
                ++summary.frame_count;
            },
            request.stop);
        manifest.files = sink.finish();
        sink.add_timings(manifest);
    }
    progress.finish();
    summary.validation_count = instance.validation_log().count();
    manifest.validation = {request.scene.validate, summary.validation_count};
    if (summary.complete) write_manifest(folder, manifest);
    return summary;
}

std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format) {
    const SceneDescription scene = load_scene(request);
    const vulkan::Instance instance({.validation = request.validate});
    const vulkan::Device device(instance, request.device);
    const SimulationModel model(scene, {.skip = request.skip});
    const FrameLoop loop(device, model, loop_options(scene, draw, !draw));
    return graph::dump(loop.graph(FrameKind::simulate_and_output), loop.plan(FrameKind::simulate_and_output), format);
}

}  // namespace drape
