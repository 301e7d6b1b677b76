// Finds pins that hold cloth where it cannot be. The paths of pins and colliders are known functions of time.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Particles of a pin whose path leads into a collider, or over which a collider moves.
struct HeldDeep {
    std::size_t cloth = 0, pin = 0, collider = 0;  ///< indices of the scene's lists
    double depth = 0;                              ///< m, of the deepest particle below the surface
    std::uint32_t first = 0, worst = 0;  ///< the frame in which the first particle is inside, and that of the deepest
    bool stays = false;  ///< at some examined instant a particle is inside; false: it passes through between instants
};

/// Returns for every pin the collider in which its particles come to be deepest, if they get deeper than a thousandth
/// of the shorter edge and than at their start (world/overlap.h reports starts). Every substep is examined, or, in a
/// scene with many particles, frames and colliders, some of them. Between two examined instants, a particle that passes
/// straight through counts.
std::vector<HeldDeep> held_in_colliders(const SceneDescription& scene);

/// A pin whose path does not begin where its particles start, so that they jump there in the first substep.
struct PathJump {
    std::size_t cloth = 0, pin = 0;
    double distance = 0;  ///< m, of the farthest particle
};

/// Returns the jumps of more than a hundredth of the shorter edge.
std::vector<PathJump> path_jumps(const SceneDescription& scene);

std::string held_text(const SceneDescription& scene, const HeldDeep& held);

}  // namespace drape
