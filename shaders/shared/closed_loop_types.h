// Structs of the passes that let a run judge its own frames and change its substeps, shared by GLSL and C++. std430.
#ifndef DRAPE_CLOSED_LOOP_TYPES_H
#define DRAPE_CLOSED_LOOP_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Rows of particles that one invocation of the comparison joins before its workgroup does.
const int difference_rows = 8;

/// Weights of changed_substep (include/end_velocity.h) from a cloth's substeps to those of an attempt.
struct SubstepChange {
    float ratio;          // new length over old
    float excess;         // on the excess in the new excess; without damping the ratio's square
    float before;         // on the excess in the last change of displacement; without damping twice the ratio's square
    float excess_before;  // on the excess in that of the substep before; without damping the ratio's square
};

struct ChangeSubstepPush {
    ivec2 grid;
    int cloth;  // place of its change, or that of the first of cloths together
};

struct DisturbPush {
    ivec2 grid;
    float amplitude;  // m, along each axis
    float unused;
};

/// Difference of two runs of the same frame, summed over the particles that are not held.
struct DifferenceRecord {
    float moved;  // mass share x squared distance, m^2
    float mass;   // mass shares (1 = an inner particle's)
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
