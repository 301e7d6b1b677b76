// Shaders and C++ share these constants of cyclic reduction.
#ifndef DRAPE_CYCLIC_TYPES_H
#define DRAPE_CYCLIC_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Most particles of a line that a workgroup solves: an invocation and 24 bytes of shared memory each, 36 where the
/// line bends (cyclic_most in cloth/cyclic_lines.h).
const int cyclic_most_particles = 1024;
/// Least invocations of a workgroup; short lines share one.
const int cyclic_least_invocations = 128;
/// Least invocations along a line.
const int cyclic_least_width = 32;
/// Lines of stiffer bending than this (LinePush::bend) are walked, which keeps more of its digits.
const float cyclic_most_bend = 100.0f;

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
