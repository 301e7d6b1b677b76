// Tethers of the particles, shared by shaders and C++. std430.
#ifndef DRAPE_TETHER_TYPES_H
#define DRAPE_TETHER_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Of one particle: the two held particles (row * columns + column, -1 = none) that it cannot leave farther than the
/// lengths (m) behind.
struct ParticleTethers {
    int anchor_a, anchor_b;
    float length_a, length_b;
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
