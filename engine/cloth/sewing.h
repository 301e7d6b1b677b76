// What seams make of a cloth's particles. Pure.
#pragma once

#include <vector>

#include "drape/scene.h"
#include "shared/seam_types.h"

namespace drape {

/// A particle of a cloth at a seam.
struct Sewn {
    std::uint32_t particle;
    glsl::SewnParticle sewn;
    Vec3 start;         ///< m: where the place starts
    Vec3 velocity;      ///< m/s: the mean of its particles' at the start, by their masses
    bool held;          ///< a pin holds one of them at the start
    double part;        ///< what a step of it alone counts for the place
    glsl::vec4 kick{};  ///< m: what its cloth's loads change of its displacement before the start
};

/// Returns the sewn particles of a cloth of the scene, those at one place one after the other; none where `cloth` is
/// not one of the scene's own. By methods that solve for springs a cloth's particles at a place have the mass of all
/// that are sewn there; by others each has its own, and the mean of their steps is that of the place.
std::vector<Sewn> sewn_particles(const SceneDescription& scene, const Cloth& cloth);

}  // namespace drape
