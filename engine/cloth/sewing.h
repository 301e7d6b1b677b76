// What seams make of a cloth's particles. Pure.
#pragma once

#include <vector>

#include "drape/scene.h"
#include "shared/seam_types.h"

namespace drape {

struct SimulationModel;

/// A particle of a cloth at a place where it is sewn; one that lies between two places has an entry for each.
struct Sewn {
    std::uint32_t particle;
    glsl::SewnParticle sewn;
    Vec3 start;         ///< m: where it starts
    Vec3 velocity;      ///< m/s at the start: the mean of those at the place, by their masses
    bool held;          ///< a pin holds the place at the start
    double part;        ///< what a step of it alone counts for the place
    double seam = 0;    ///< m: the length of seams that rip that is its place's; 0: it does not come apart
    glsl::vec4 kick{};  ///< m: what its cloth's loads change of its displacement before the start
};

/// Returns whether some of a cloth's sewn particles lie between two places.
bool lies_between(const std::vector<Sewn>& sewn);
/// Returns whether some of their places come apart under a load.
bool rips(const std::vector<Sewn>& sewn);
/// Returns the times, s, at which seams of the scene have closed, ascending; empty: all are closed from the start on.
std::vector<double> closing_times(const SceneDescription& scene);
/// Returns what is left of a gap at a time, s: 1 at the start, 0 from `closed` on, with a speed that begins and ends at
/// 0.
double opening_at(double time, double closed);

/// Returns the sewn particles of a cloth of the scene, those at one place one after the other; none where `cloth` is
/// not one of the scene's own. By methods that solve for springs a cloth's particles at a place have the mass of all
/// that are sewn there; by others each has its own, and the mean of their steps is that of the place.
std::vector<Sewn> sewn_particles(const SceneDescription& scene, const Cloth& cloth);

/// Returns, by station of `sewing_of`, the mass (kg) of all that is sewn there; a particle between two counts at each
/// by its weight.
std::vector<double> sewn_masses(const SceneDescription& scene);

/// Returns, by cloth, the first place of all cloths that it and others are sewn together with; -1: it is sewn to none.
std::vector<int> sewn_joints(const SimulationModel& model);

}  // namespace drape
