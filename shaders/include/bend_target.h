// The image with the rest differences of bending elements in the current substep (bend_targets.comp). It is bend_parts
// times as wide as the grid; elements along rows and columns use the texel of their middle particle, cells that of
// their corner.
#include "include/rest_length.h"
layout(set = 0, binding = 17, rgba32f) uniform readonly image2D bend_targets;

vec3 bend_part(ivec2 owner, int part) {
    vec3 found = vec3(0.0f, 0.0f, 0.0f);
    if (own_rest) found = LOAD(bend_targets, owner + ivec2(part * push.grid.x, 0)).xyz;
    return found;
}

/// Returns an element's difference at rest, m; `part`: 0 row, 1 column, 2 twist. For flat cloth it is zero.
vec3 bend_target(ivec2 owner, int part) { return bend_part(owner, part); }
