// Shaders and C++ share these constants of lines that are solved in parts.
#ifndef DRAPE_PARTS_TYPES_H
#define DRAPE_PARTS_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Particles of a line that an invocation has.
const int part_particles = 8;
/// Lines that a subgroup has parts of, side by side, as texels beside each other are read at once.
const int part_lines = 2;
/// Most particles of lines that cyclic reduction with an invocation each is left with, where a device does both.
const int parts_least_particles = 256;

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
