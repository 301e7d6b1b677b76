// Finds pins that hold cloth where it cannot be: their paths and those of colliders are known functions of time.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Particles of a pin that it leads into a collider, or that a collider is led over.
struct HeldDeep {
    std::size_t cloth = 0, pin = 0, collider = 0;  ///< indices of the scene's lists
    double depth = 0;                              ///< m: the deepest particle's, below the surface
    std::uint32_t first = 0, worst = 0;            ///< frames of the first particle inside, and of the deepest
    bool stays = false;                            ///< at some instant looked at it is inside, else it is led through
};

/// Returns for every pin the collider that its particles come to be deepest in, where that is by more than a thousandth
/// of the shorter edge and than they start (world/overlap.h tells of that). Every substep is looked at, of a scene with
/// many particles, frames and colliders a part of them; on the way between two, what is led straight through counts.
std::vector<HeldDeep> held_in_colliders(const SceneDescription& scene);

/// A pin whose path does not begin where its particles start: they get there in the first substep.
struct PathJump {
    std::size_t cloth = 0, pin = 0;
    double distance = 0;  ///< m, the farthest particle's
};

/// Returns those of more than a hundredth of the shorter edge.
std::vector<PathJump> path_jumps(const SceneDescription& scene);

std::string held_text(const SceneDescription& scene, const HeldDeep& held);

}  // namespace drape
