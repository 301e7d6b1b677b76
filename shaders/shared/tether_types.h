// Tethers of the particles, shared by shaders and C++, in std430.
#ifndef DRAPE_TETHER_TYPES_H
#define DRAPE_TETHER_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Two held particles (row * columns + column, -1 = none), and the lengths (m) that one particle cannot be farther from
/// them.
struct ParticleTethers {
    int anchor_a, anchor_b;
    float length_a, length_b;
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
