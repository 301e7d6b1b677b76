// Structs of the passes that let a run judge its own frames and change its substeps, shared by GLSL and C++. std430.
#ifndef DRAPE_CLOSED_LOOP_TYPES_H
#define DRAPE_CLOSED_LOOP_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Rows of particles that one invocation of the comparison joins before its workgroup does.
const int difference_rows = 8;

/// From the state of one cloth's substeps to that of an attempt's: weights of changed_step (include/end_velocity.h).
struct StepChange {
    float ratio;          // of the lengths, new over old
    float motion;         // on the excess in the displacement; the ratio's square without damping
    float excess;         // on the excess in itself; likewise
    float excess_before;  // on the excess in that of the substep before; likewise
};

struct ChangeStepPush {
    ivec2 grid;
    int cloth;
};

/// Two runs to the same frame: sums over the particles that are not held.
struct DifferenceRecord {
    float moved;  // mass share x squared distance, m^2
    float mass;   // mass shares (1 = an inner particle's)
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
