// Structs of the cut and tear passes and of the drawing of cut edges, shared by GLSL and C++, in std430.
#ifndef DRAPE_CUT_TYPES_H
#define DRAPE_CUT_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A triangle of the surface that a cutter sweeps in one frame.
struct CutterTriangle {
    vec4 a, b, c;  // xyz: corners, metres; a.w: 1 when it cuts in this frame; the first with 0 ends the list
};

/// A cutter at rest is its triangle; a moving one is the surface of the prism that it sweeps: both caps and two
/// triangles per side.
const int cutter_triangle_count = 8;

struct CutPush {
    ivec2 grid;          // columns, rows
    int triangle_count;  // in the cutter buffer
    int unused;
};

struct TearPush {
    ivec2 grid;           // columns, rows
    float rest_row;       // m, of springs along a row
    float rest_column;    // m
    float rest_diagonal;  // m
    float compression;    // share of a diagonal's force where it is pushed together
};

/// A vertex on a cut spring (or inside a shattered triangle), drawn with the side it belongs to. Its position is
/// `anchor` + alpha (first - anchor) + beta (second - anchor) + offset, which is affine in particles of its own side
/// alone and exact where the cloth is flat.
struct CutVertex {
    uvec4 particles;  // anchor, first, second particle; w unused
    vec4 weights;     // alpha, beta; z, w unused
    vec4 offset;      // m, in the world frame of the rest pose: the part that no pair of own particles spans
    vec4 material;    // m along columns, rows of the undeformed cloth; z, w unused
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
