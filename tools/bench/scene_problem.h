// A user's scene as a row of the accuracy benchmark: every method and `auto` against the scene's own refined runs.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/problem.h"
#include "drape/simulation.h"
#include "reference/reference_run.h"

namespace drape::bench {

// --- The reference: refined runs on the device

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

// --- The problem

struct UserScene {
    std::string path;  ///< for the row's name
    SceneDescription scene;
    std::string identity;  ///< hash of its text, overrides included
};

/// The scene of a file, of at most `frames` frames after the first (0: all). Throws SceneFailure, and UsageError when
/// there is no frame after the first.
UserScene read_user_scene(const std::string& path, const std::vector<std::string>& overrides, std::uint32_t frames);

/// Positions count until the two finest references are this share of the largest cloth's side apart.
inline constexpr double agreement_share = 0.01;

/// A sweep per method and `auto`. Its metrics, per setting:
///   position_rms, worst_position   m, RMS over all particles: mean over the frames until `agreement_s`, and the worst
///   position_at_end, stated_at_end m, the RMS at `agreement_s`, and what the run itself states there, if it does
///   reference_error                m, what the reference itself may be off, mean over the same frames
///   agreement_s                    s, until when the two finest references agree
///   center_error                   m, distance of the centres of mass, RMS over all frames
///   stretch_error, worst_stretch_error, worst_spring   mean over frames and worst frame of the RMS, worst spring
///   stretch_rms, stretch_rms_reference   strain, mean over all frames; the reference's only without cutters
///   tolerance, substeps_used, substeps_most   the substeps per frame: mean over frames, most
/// `options` for the reference, which is made when the first setting is evaluated; `device` is copied.
/// `errors` (m) are the targets, beside 1 % of stretch error.
Problem user_problem(const UserScene& user, const Device& device, const RefinementOptions& options,
                     std::span<const double> errors, bool is_short);

}  // namespace drape::bench
