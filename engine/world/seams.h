// Finds the particles that seams make one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// A particle at a seam.
struct SewnMember {
    std::size_t cloth;
    std::uint32_t particle;  ///< row * columns + column
    bool operator==(const SewnMember&) const = default;
    bool operator<(const SewnMember& other) const {
        return std::tie(cloth, particle) < std::tie(other.cloth, other.particle);
    }
};

/// Particles that are one, in ascending order; the first one is the leader, the others follow it.
using SewnGroup = std::vector<SewnMember>;

/// Sewn particles may start so far from each other, as a share of the smaller spacing of their cloths.
inline constexpr double seam_tolerance = 1e-3;

/// What is wrong with a scene's seams.
struct SeamFault {
    std::string below;  ///< JSON pointer of the culprit, from /seams on
    std::string text;   ///< "expected ..."
};
/// Finds out whether the scene can be sewn: both cloths exist, the edges have as many particles, which start at one
/// place in pairs, at most one pin that moves or lets go holds a place, and nothing of the scene excludes seams.
std::vector<SeamFault> seam_faults(const SceneDescription& scene);

/// Returns the places at which particles are sewn, in the order of their leaders. Edges are joined in the order of
/// their particles, or against it, whichever has them nearer to each other at the start. Particles without a cell stay
/// alone. The scene must have no faults.
std::vector<SewnGroup> sewn_groups(const SceneDescription& scene);

/// Returns the cloth with this name.
std::optional<std::size_t> cloth_called(const SceneDescription& scene, const std::string& name);

/// Returns, by member, whether a pin holds it at the start, and the last such pin.
std::optional<std::size_t> holding_pin(const SceneDescription& scene, const SewnMember& member);

/// Returns where a sewn place starts, m: where a pin holds a member, else where its leader starts, with its jitter.
Vec3 sewn_start(const SceneDescription& scene, const SewnGroup& place);

}  // namespace drape
