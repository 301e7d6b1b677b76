// The host tells this of a mesh that deforms, and passes make the frame's field from it (mesh_form.comp), in std430.
#ifndef DRAPE_FORM_TYPES_H
#define DRAPE_FORM_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A box of a tree over the triangles, in depth-first order: its children follow it.
struct FormNode {
    vec4 lower, upper;  // xyz: m, in the mesh's frame
    uvec4 triangles;    // numbers of those of a leaf, no_triangle for none
    uvec4 links;        // x: the node behind its last descendant, counted from the tree's first; yzw unused
};
const uint no_triangle = 0xffffffffu;
const int most_leaf_triangles = 4;

/// Push constants of the passes that make a field. The mesh has two forms, those of the frame's begin and end: their
/// trees, corners (three for each triangle), guesses and sides follow each other.
struct FormPush {
    vec4 lower;          // xyz: the first sample's place, m; w: spacing, m
    ivec4 size;          // samples along x, y, z; w: the first one's texel in the fields
    ivec4 first;         // of this mesh: node, corner, guess, word of sides
    ivec4 count;         // of one form: nodes, triangles, guesses, words of sides
    float exact;         // square of the distance beyond which it may be told up to 2 % too far, m^2
    float half_shell;    // m; 0: the surface is closed
    float substep;       // share of the frame
    int first_distance;  // of this mesh, in the distances that the first pass leaves to the second
};

/// A guess of the nearest triangle serves so many samples along each axis. With this bit it has to do: contact does not
/// ask for distances there.
const int guess_block = 4;
const uint guess_does = 0x80000000u;

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
