// A scene's own refined runs on the device: what its coarser runs are compared with.
#pragma once

#include <functional>
#include <string>

#include "drape/device.h"
#include "drape/scene.h"
#include "reference/reference_run.h"

namespace drape::bench {

struct RefinementOptions {
    double wanted_error = 1e-5;          ///< m: refine until the estimate is below
    std::uint32_t most_substeps = 1280;  ///< per frame, of the finest run
    std::function<void(const std::string&)> say;
    ReferenceProgress progress;  ///< of one run; may throw to stop
};

/// The scene's frames after the first, by the method that converges best and with so many substeps that the estimate of
/// its error is below what is wanted, or the most. Two methods are refined, `line` and `explicit` (where it can follow
/// the stiffness), three runs each at doubled substeps; the better one goes on. The estimate of a frame is Richardson's
/// from the last three runs, raised to what the other method's finest run is off beyond its own estimate. Velocities
/// are zero. Throws Diverged when no method stays finite, DeviceError, and what `progress` throws.
ReferenceRun refined_scene(const Device& device, const SceneDescription& scene, const RefinementOptions& options);

/// Index behind the last time until which the two finest runs agree within `distance` (m, RMS): later positions of a
/// chaotic motion mean nothing.
std::size_t agreeing_count(const ReferenceRun& run, double distance);

/// Over the frames [0, count): the mean of the estimates, m.
double mean_error(const ReferenceRun& run, std::size_t count);

}  // namespace drape::bench
