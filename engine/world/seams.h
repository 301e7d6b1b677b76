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

/// Tells what a place bears before it comes apart.
struct SewnRip {
    double load = 0;       ///< N; 0: anything
    double length = 0;     ///< m: of the seams that is the place's
    std::size_t seam = 0;  ///< one of these
};

/// A place where particles are sewn. It may have one alone, which others lie between.
struct SewnStation {
    SewnGroup group;
    double close = 0;  ///< s: when its particles have come together; 0: they start together
    SewnRip rip{};
};

/// Particles that are one and lie on the straight line between two stations.
struct SewnBetween {
    SewnGroup group;
    std::array<std::size_t, 2> stations{};
    std::array<double, 2> weights{};  ///< what each station counts; their sum is 1
    double close = 0;                 ///< s, as a station's
    std::size_t seam = 0;             ///< the one that lays them there
};

struct Sewing {
    std::vector<SewnStation> stations;  ///< in the order of their leaders
    std::vector<SewnBetween> between;   ///< likewise
};

/// Sewn particles may start so far from each other, as a share of the smaller spacing of their cloths; those between
/// two stations so far from the straight line, since a curved seam is one of straight pieces.
inline constexpr double seam_tolerance = 1e-3, seam_tolerance_between = 0.02;

/// What is wrong with a scene's seams.
struct SeamFault {
    std::string below;  ///< JSON pointer of the culprit, from /seams on
    std::string text;   ///< "expected ..."
};
/// Finds out whether the scene can be sewn: the cloths exist and have these sides, which start at one place unless they
/// are closed later, no particle lies between others that lie between others, at most one pin that moves or lets go
/// holds a place, and nothing of the scene excludes seams.
std::vector<SeamFault> seam_faults(const SceneDescription& scene);

/// Returns what seams make of the scene. Sides of as many particles are joined in pairs, in their order or against it,
/// whichever has them nearer to each other at the start; of others the ends are, and the finer side's other particles
/// lie between the coarser one's by the length along each. Particles without a cell stay alone. The scene must have no
/// faults.
Sewing sewing_of(const SceneDescription& scene);

/// Returns the cloth with this name.
std::optional<std::size_t> cloth_called(const SceneDescription& scene, const std::string& name);

/// Returns, by member, whether a pin holds it at the start, and the last such pin.
std::optional<std::size_t> holding_pin(const SceneDescription& scene, const SewnMember& member);

/// Returns where a member would start if it were not sewn, m, with its jitter.
Vec3 unsewn_start(const SceneDescription& scene, const SewnMember& member);

}  // namespace drape
