// A particle and the six particles that share triangles with it. Passes load each of them once, not once for each
// triangle, and have no loops over them, since an array that no loop indexes is held in registers on every device
// (docs/devices.md). [[unroll]] would not do: code that spirv-opt unrolls is no longer precise. The includer has
// `push`, and where `masked` its image of `cells`.
#include "include/triangles.h"

const int neighbourhood_count = 7;

/// Returns the index of an offset, row by row; the particle itself has index 3. (-1, -1) and (1, 1) share no triangle
/// with it.
int place_in_neighbourhood(ivec2 offset) { return offset.y * 3 + offset.x + 3; }

/// Returns the index of corner (0..2) of a triangle of triangle_around.
int corner_in_neighbourhood(ivec4 around, int corner) {
    return place_in_neighbourhood(around.xy + triangle_corner(around.z, corner));
}

/// Returns the texel of the neighbour at `offset`; past the border, that of some other particle.
ivec2 neighbourhood_texel(ivec2 particle, ivec2 offset) {
    return max(min(particle + offset, push.grid - 1), ivec2(0, 0));
}

/// Calls `load(index, texel)` for every member.
#define FOR_NEIGHBOURHOOD(particle, load)                 \
    load(0, neighbourhood_texel(particle, ivec2(0, -1))); \
    load(1, neighbourhood_texel(particle, ivec2(1, -1))); \
    load(2, neighbourhood_texel(particle, ivec2(-1, 0))); \
    load(3, particle);                                    \
    load(4, neighbourhood_texel(particle, ivec2(1, 0)));  \
    load(5, neighbourhood_texel(particle, ivec2(-1, 1))); \
    load(6, neighbourhood_texel(particle, ivec2(0, 1)));

bool triangle_exists(ivec2 particle, ivec4 around) {
    ivec2 cell = particle + around.xy;
    if (!cell_inside(cell, push.grid)) return false;
    if (masked) return (imageLoad(cells, placed_cell(cell)).x & uint(around.z)) != 0u;
    return true;
}

/// Calls `add(k)` for every triangle around a particle, in the order of all sums over them.
#define FOR_TRIANGLES(add) \
    add(0);                \
    add(1);                \
    add(2);                \
    add(3);                \
    add(4);                \
    add(5);
