// Seams: particles of several cloths, or of one, that are one (docs/physics.md 12).
#ifndef DRAPE_SEAM_H
#define DRAPE_SEAM_H

#include "include/vector.h"

/// Returns the mean of the particles up to one with this value, which has this share in it: those before have the mean
/// `mean`. A share of 1 is the value itself, 0 leaves the mean, to the bit.
SHARED vec3 sewn_mean(vec3 mean, vec3 value, float share) {
    precise vec3 further = mean + (value - mean) * share;
    return share == 1.0f ? value : share == 0.0f ? mean : further;
}

/// Returns what lies between two places of which it is so much each.
SHARED vec3 sewn_between(vec3 one, vec3 other, float of_one, float of_other) {
    precise vec3 between = one * of_one + other * of_other;
    return between;
}

/// Returns by how much something moves before a place, or this from it.
SHARED vec3 sewn_lead(vec3 moved, vec3 place) {
    precise vec3 lead = moved - place;
    return lead;
}

/// Returns where a place is after one of a cloth's particles has moved it, which has this part in its mass.
SHARED vec3 sewn_change(vec3 place, vec3 moved, vec3 before, float part) {
    precise vec3 changed = place + (moved - before) * part;
    return changed;
}

/// Returns where a particle is while so much is left of its gap to its place.
SHARED vec3 sewn_apart(vec3 place, vec3 gap, float left) {
    precise vec3 at = place + gap * left;
    return at;
}

/// Returns the place of such a particle.
SHARED vec3 sewn_together(vec3 at, vec3 gap, float left) {
    precise vec3 place = at - gap * left;
    return place;
}

/// Returns the square of the way that contact has led a particle by, in displacement and position.
SHARED float sewn_way(vec3 moved, vec3 displacement, vec3 start, vec3 position) {
    precise vec3 way = (moved - displacement) + (start - position);
    return ordered_dot(way, way);
}

/// Adds a force; its drag is in w.
SHARED vec4 sewn_force(vec4 sum, vec4 force) {
    precise vec4 more = vec4(sum.x + force.x, sum.y + force.y, sum.z + force.z, sum.w + force.w);
    return more;
}

/// Takes from a force on a particle what the change of gravity makes of mass (kg) that is others'.
SHARED vec4 without_carried(vec4 force, vec3 more_gravity, float carried, float inverse_mass) {
    precise vec4 own = vec4(force.x - more_gravity.x * carried, force.y - more_gravity.y * carried,
                            force.z - more_gravity.z * carried, force.w);
    return inverse_mass > 0.0f ? own : force;
}

/// Returns what of the forces on a place is one particle's, where several of a cloth share the mass of the place.
SHARED vec4 own_force(vec4 sum, float part) {
    precise vec4 own = vec4(sum.x * part, sum.y * part, sum.z * part, sum.w * part);
    return own;
}

/// Returns the force, N, that has moved a particle of this inverse mass by so much in a substep. `force`: of SeamPush.
SHARED vec3 sewn_pull(vec3 moved, float inverse_mass, float force) {
    precise vec3 pull = moved * (force / inverse_mass);
    return pull;
}

/// Adds a side's force to the load on a seam.
SHARED vec4 seam_load(vec4 sum, vec3 pull, float counts) {
    precise vec4 more = vec4(sum.x + pull.x * counts, sum.y + pull.y * counts, sum.z + pull.z * counts, 0.0f);
    return more;
}

/// Returns the mean of a frame's loads on a seam; w: 1 where the seam does not bear it.
SHARED vec4 seam_load_of(vec4 sum, float share, float most) {
    precise vec3 mean = vec3(sum.x * share, sum.y * share, sum.z * share);
    precise float limit = most * most;
    return vec4(mean.x, mean.y, mean.z, ordered_dot(mean, mean) > limit ? 1.0f : 0.0f);
}

/// Adds a normal to that of a seam, unless the cloths make an edge there: beyond a right angle each keeps its own.
SHARED vec3 sewn_normal(vec3 sum, vec3 normal) {
    precise vec3 more = sum + normal;
    return ordered_dot(sum, normal) > 0.0f ? more : sum;
}

SHARED bool shares_normal(vec3 sum, vec3 normal) { return ordered_dot(sum, normal) > 0.0f; }

#endif
