#include "run/missing_frames.h"

#include <fmt/format.h>

#include <algorithm>

#include "output/png_sequence.h"
#include "run/frame_sink.h"
#include "run/written_colliders.h"

namespace drape {

namespace {

void check_stream(const RunRequest& request) {
    const auto formats = output_formats(request.formats);
    if (formats.size() != 1 || !formats[0]->stream)
        throw UsageError(fmt::format("a stream takes one format, of {}", stream_format_names()));
    if (request.existing != ExistingFiles::refuse) throw UsageError("a stream cannot be overwritten or resumed");
}

}  // namespace

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
                               [](const OutputFormat* format) { return !format->draws && !format->layers; });
}

bool needs_every_picture(const RunRequest& request) {
    return std::ranges::any_of(output_formats(request.formats), [](const OutputFormat* format) {
        return (format->draws || format->layers) && !format->resumes;
    });
}

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

}  // namespace drape
