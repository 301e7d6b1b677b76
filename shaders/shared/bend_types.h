// Push constants of the pass that finds what bending elements are at rest, shared by GLSL and C++.
#ifndef DRAPE_BEND_TYPES_H
#define DRAPE_BEND_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

struct BendTargetPush {
    ivec2 grid;
    int moved;  // 0: the particles are at their positions, without their displacements
    int unused;
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
