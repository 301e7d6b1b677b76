// The image of what bending elements are at rest, in the substep at hand (bend_targets.comp), is bend_parts times as
// wide as the grid; texels of elements along rows and columns are their middle particle's, those of cells their
// corner's.
#include "include/rest_length.h"
layout(set = 0, binding = 17, rgba32f) uniform readonly image2D bend_targets;

vec3 bend_part(ivec2 owner, int part) {
    vec3 found = vec3(0.0f, 0.0f, 0.0f);
    if (own_rest) found = LOAD(bend_targets, owner + ivec2(part * push.grid.x, 0)).xyz;
    return found;
}

/// The difference of an element at rest, m; `part`: 0 row, 1 column, 2 twist. Flat cloth rests at zero.
vec3 bend_target(ivec2 owner, int part) { return bend_part(owner, part); }
