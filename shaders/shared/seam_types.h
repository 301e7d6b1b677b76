// Shaders and C++ share these structs of the steps that keep sewn particles together (include/seam.h), in std430.
#ifndef DRAPE_SEAM_TYPES_H
#define DRAPE_SEAM_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// What a cloth's sewn particles hand on: how the prediction or the pins moved them, whether pins hold them, how the
/// springs moved them, how contact with colliders did, the force on them, their normals, how they moved before a
/// substep, how contact between cloths moved them, as a frame ends, where they come apart, and the areas that gas
/// presses on. Cloths by the line method also hand on which order of step they may take.
const int seam_predicted = 0, seam_released = 1, seam_solved = 2, seam_touched = 3, seam_forces = 4, seam_normals = 5,
          seam_begun = 6, seam_met = 7, seam_orders = 8, seam_ripped = 9, seam_areas = 10;

struct SeamPush {
    int particle_count;  // the cloth's, at seams
    int stage;
    int opening;      // the first of the substep's openings
    int weather;      // where in `wind` the substep's change of gravity is
    vec2 force;       // N that move an inner particle by a metre in a substep, of backward Euler and of BDF2
    int joint;        // the place that has the order of steps of all cloths that are sewn together
    int begins;       // 1 = the cloth is the first of these
    uint most_wrong;  // of the cloth's lines, as in PredictPush
    int first;        // 1 = the first of the frame that adds to the loads on seams
    float share;      // of a substep in a frame
    int unused;
};

/// A particle of a cloth at a place where it is sewn. One that lies between two places is listed at both.
struct SewnParticle {
    ivec4 at;       // column, row; the place where it is sewn; how many of the cloth's particles are there, from this
                    // one on, in the list one after the other: 0 but for the first of them
    ivec4 between;  // x: the other place, or -1; y: 1 = what the places have goes to it from here; z: which of the
                    // openings is its seam's, or -1; w: 1 = the place's motion begins with its own
    vec4 weights;  // x: its share in the mean of those of all cloths up to it (1: it alone counts); y: its inverse mass
                   // where no pin holds the place; z: 1 = it is the first of all cloths' there; w: how much of it is
                   // this place's: 1 but between two
    vec4 parts;    // x: its share in the mean of those of its own cloth up to it; y: its mass in the place's over that
                   // of its own cloth there; z: the same in the other place's; w: 1 = some of the cloth's particles at
                   // the place lie between two
    vec4 gap;      // xyz: m from the place to where it starts; w: how much of it is the other place's
    vec4 carried;  // x: kg of others' that count as its own in its cloth; y: N at which the place comes apart, 0: it
                   // does not; z: what its cloth's force on it counts in the load on the seam; w: its own inverse mass
};

/// How much of their gaps is left of the particles at seams that close alike, when a substep begins and ends.
struct SeamOpening {
    vec2 left;
};

/// What is known of a place where particles are sewn, as the last cloth has left it.
struct SewnPlace {
    vec4 position;      // m, all gaps being closed; w: the inverse mass of the particle that leads; 0: it is held
    vec4 displacement;  // m; w: as in the cloth's field
    vec4 remainder;     // m: what rounding lost of the displacement
    vec4 before;        // m: the displacement of the substep before
    vec4 vector;        // N: the sum of the forces; w: their drag, N/m. At a frame's end the sum of the normals
    uvec4 control;      // at a joint: the LineControl of the cloths that are sewn together; w: 0
    vec4 load;          // xyz: N: what the seam has borne in the frame's substeps so far, their sum
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
