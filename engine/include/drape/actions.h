// These are what actions may change while a scene is simulated, and the actions that a scene has of its own
// (drape/ensemble.h has those of an ensemble's steps).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "drape/spelling.h"
#include "drape/vec3.h"

namespace drape {

/// Controls that steps may be given: what is not asked for costs nothing.
struct EnsembleControls {
    bool wind = false;       ///< scenes without wind then have it: at 0 m/s
    bool pins = false;       ///< every pin may be moved
    bool colliders = false;  ///< every collider may be moved
    bool holds = false;      ///< every pin may let go and take again
    bool gravity = false;    ///< gravity may change
    bool loads = false;      ///< the loads of the scenes, which must have some, may change
    /// Hands, which no other key of a scene has, may take particles: the cloth (by number) whose particles each can
    /// take. They hold nothing at first.
    std::vector<std::size_t> hands = {};
    bool bodies = false;  ///< bodies that cloth moves may be pushed and thrown
    bool operator==(const EnsembleControls&) const = default;
};

/// The controls beside hands, by name.
inline constexpr Spelling<bool EnsembleControls::*> control_spellings[] = {
    {"wind", &EnsembleControls::wind},           {"pins", &EnsembleControls::pins},
    {"colliders", &EnsembleControls::colliders}, {"holds", &EnsembleControls::holds},
    {"gravity", &EnsembleControls::gravity},     {"loads", &EnsembleControls::loads},
    {"bodies", &EnsembleControls::bodies}};

/// m and degrees, or of what pushes a body its force and moment and so on.
using SixNumbers = std::array<double, 6>;

/// The actions of one frame, each as a member's part of the EnsembleActions of the step to it; empty: none.
struct FrameActions {
    std::uint32_t frame = 1;  ///< the one that the step ends with
    std::optional<Vec3> wind = {}, gravity = {};
    std::vector<SixNumbers> pins = {}, colliders = {}, hands = {};
    std::vector<bool> holds = {};
    std::vector<std::array<std::int32_t, 4>> grasps = {};
    std::vector<Vec3> loads = {};
    std::vector<SixNumbers> body_forces = {}, body_impulses = {}, body_velocities = {};
    std::vector<bool> body_sets = {};
    bool operator==(const FrameActions&) const = default;
};

/// A scene is told these while it is simulated.
struct SceneActions {
    EnsembleControls controls;        ///< those that it would have in an ensemble
    std::vector<FrameActions> steps;  ///< strictly increasing in their frames
    bool operator==(const SceneActions&) const = default;
};

}  // namespace drape
