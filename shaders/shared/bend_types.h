// Push constants of the pass that finds what bending elements are at rest, shared by GLSL and C++.
#ifndef DRAPE_BEND_TYPES_H
#define DRAPE_BEND_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Parts of the image of bend targets, beside the targets of elements along rows (0), along columns (1) and of cells
/// (2): what all elements of a particle pull at its tangents, and what a cell pulls at its own.
const int bend_pull_row = 3, bend_pull_column = 4, twist_pull_row = 5, twist_pull_column = 6, bend_parts = 7;

/// Vectors are over the elements along rows, along columns and of cells; w unused.
struct BendTargetPush {
    ivec2 grid;
    int gathers;  // the method moves the particles with its next substep, and wants all where they are now
    int unused;
    vec4 stiffness;       // b h^2 / m_inner, of an explicit step as the step uses it
    vec4 stiffness_bdf2;  // the same of a BDF2 step
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
