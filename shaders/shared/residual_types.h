// Structs of the passes that decide whether a substep needs another iteration, shared by GLSL and C++, in std430.
#ifndef DRAPE_RESIDUAL_TYPES_H
#define DRAPE_RESIDUAL_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Rows of particles that one invocation joins before its workgroup does.
const int residual_rows = 8;

/// Different sizes that the dispatches of one cloth's iterations may have. The iteration state is an array of uvec4: so
/// many VkDispatchIndirectCommands (w unused), then x: the iterations that the frame has run.
const int iteration_size_count = 16;

struct ResidualPush {
    ivec2 grid;         // columns, rows
    vec2 rest_length;   // m, along a row, along a column; 0: no such springs
    float compression;  // share of a spring's stiffness where it is pushed together
};

struct IterationPush {
    int partial_count;
    float squared_tolerance;  // square of the tolerance of the RMS stretch error
    int first_check;          // 1: the frame's first check
    int substep_count;
};

/// Squared stretch errors of some springs.
struct ResidualRecord {
    float squares;
    uint count;
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
