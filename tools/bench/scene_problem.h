// A user's scene as a row of the accuracy benchmark: every method and `auto` against the scene's own refined runs.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/problem.h"
#include "bench/scene_reference.h"
#include "drape/device.h"

namespace drape::bench {

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
