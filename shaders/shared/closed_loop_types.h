// Structs of the passes that let a run judge its own frames and change its substeps, shared by GLSL and C++. std430.
#ifndef DRAPE_CLOSED_LOOP_TYPES_H
#define DRAPE_CLOSED_LOOP_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Rows of particles that one invocation of the comparison joins before its workgroup does.
const int difference_rows = 8;

/// What the host says of an attempt at a frame.
struct AttemptInput {
    float ratio;  // length of its substeps over that of the state's
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
