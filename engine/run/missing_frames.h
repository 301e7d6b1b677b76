// Which frames a run has to hand out, and what must exist before it begins.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "output/kept_frames.h"
#include "output/output_folder.h"
#include "run/run.h"
#include "run/run_description.h"

namespace drape {

/// The frames of the range that have to be handed out; the pictures of the others exist already.
struct MissingFrames {
    std::set<std::uint32_t> frames;
    std::map<std::uint32_t, KeptFrame> kept;
};

/// Throws UsageError when a format cannot be written as requested, or cannot hold what the scene has.
void check_formats(const RunRequest& request, const SceneDescription& scene);
bool needs_positions(const RunRequest& request);
/// Returns whether some format needs every picture or its layers, including those of kept frames.
bool needs_every_picture(const RunRequest& request);
MissingFrames missing_frames(const std::optional<OutputFolder>& folder, const RunRequest& request,
                             const FrameRange& range, const std::string& key);
/// Throws OutputError where the disk lacks the space that all frames need at least.
void expect_room(const OutputFolder& folder, const RunRequest& request, const SceneDescription& scene,
                 const FrameRange& range);

}  // namespace drape
