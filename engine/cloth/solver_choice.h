// Resolves `auto`: chooses the method and the settings that reach a tolerance with the least work, from the laws of
// each method's stretch error and the costs of its passes.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cloth/device_costs.h"
#include "drape/scene.h"

namespace drape {

/// Returns the error of the motion that is allowed where the scene states none, m/s: 0.02 of the longer side (m) per
/// second. Cloth of less than a metre may have 0.02 m/s times the square root of its side over a metre: speeds under
/// gravity fall with size in this way (Froude), so a small model of a scene takes the same substeps in the same motion.
inline double default_motion_limit(double side) { return 0.02 * std::max(side, std::sqrt(side)); }

/// One method, with the fewest substeps that its law allows.
struct SolverCandidate {
    SolverMethod method;
    std::uint32_t substeps;
    std::uint32_t least_substeps;  ///< substeps that follow bending (MethodScheme::following_substeps)
    std::uint32_t calm_substeps;   ///< substeps that follow a swing, too
    double predicted_ms;           ///< per frame, all cloths; only for comparing methods
    bool reaches;                  ///< by its law, the method keeps the tolerance within the limits of the settings
};

struct SolverChoice {
    SolverSettings settings;                  ///< with the chosen method instead of `auto`
    std::vector<SolverCandidate> candidates;  ///< the chosen one first; empty when the scene names its method
    std::string reason;                       ///< one sentence, with the numbers of the laws
    std::uint32_t least_substeps;             ///< a closed loop takes no fewer
    std::uint32_t calm_substeps;              ///< nor fewer than these where the error is not known to be small
};

/// Returns the settings in use for a scene of method `auto`; for any other method, the scene's own.
///
/// The laws hold for a cloth that hangs L metres and n links of length l below its pins (half its size without pins)
/// under acceleration g (wind included), with substep h; F = 1.7 for a calm cloth that hangs by an edge, else 5:
///   relax     error = F 0.59 n g h^2/(2 l)
///   explicit  error = F 0.41 g L/c_s^2, c_s the wave speed that the clamped micro-step follows
///   line      cheapest at h sqrt(g L)/l = 1.3 when held by an edge, 0.45 or less otherwise; iterations do the rest
/// And no substep is longer than 0.0088 sqrt(size / gravity), which a swing needs, or than bending needs. A closed loop
/// takes longer ones than the former where it finds the error far below its limit.
SolverChoice choose_solver(const SceneDescription& scene, DeviceKind device);

}  // namespace drape
