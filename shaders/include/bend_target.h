// The differences that bending elements have at rest, in the substep at hand (bend_targets.comp). The image is three
// times as wide as the grid: elements along rows by their middle particle, along columns, and cells by their corner.
#include "include/rest_length.h"
#ifdef MASKED
layout(set = 0, binding = 17, rgba32f) uniform readonly image2D bend_targets;
#endif

/// `part`: 0 row, 1 column, 2 twist. Flat cloth rests at zero.
vec3 bend_target(ivec2 owner, int part) {
    vec3 target = vec3(0.0f, 0.0f, 0.0f);
#ifdef MASKED
    if (own_rest) target = LOAD(bend_targets, owner + ivec2(part * push.grid.x, 0)).xyz;
#endif
    return target;
}
