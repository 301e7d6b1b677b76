// Describes a run for its manifest, its files and its messages.
#pragma once

#include <string>
#include <vector>

#include "drape/simulation.h"
#include "output/frame_writer.h"
#include "output/manifest.h"
#include "run/run.h"

namespace drape {

struct FrameRange {
    std::uint32_t start, end, step;
    std::uint32_t count() const { return (end - start) / step + 1; }
};

/// Throws UsageError.
FrameRange frame_range(const RunRequest& request, const SceneDescription& scene, std::vector<std::string>& warnings);

Manifest describe_run(const RunRequest& request, const LoadedScene& loaded, const Simulation& simulation,
                      const DeviceInfo& device, const FrameRange& range);
/// Returns the description of the run that formats need; `manifest` has the run's key.
WrittenRun written_run(const RunRequest& request, const LoadedScene& loaded, const Simulation& simulation,
                       const Manifest& manifest);
/// Returns the notes of `-v` before the first frame.
std::vector<std::string> notes(const Device& device, const Simulation& simulation);

}  // namespace drape
