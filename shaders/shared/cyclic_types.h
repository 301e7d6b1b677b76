// Lines solved by cyclic reduction: constants that shaders and C++ share.
#ifndef DRAPE_CYCLIC_TYPES_H
#define DRAPE_CYCLIC_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Particles of the longest line that a workgroup solves: an invocation each, 24 bytes of shared memory each.
const int cyclic_most_particles = 1024;
/// Invocations that a workgroup has at least: short lines share one.
const int cyclic_least_invocations = 128;
/// Invocations along a line at least.
const int cyclic_least_width = 32;

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
