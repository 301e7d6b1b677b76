// The load on a cloth along its rows and columns, relative to what it bears (docs/physics.md 8).
#ifndef DRAPE_TEAR_H
#define DRAPE_TEAR_H

#include "include/spring.h"

/// Returns the strain of a spring; that of a compressed one is multiplied by `compression`.
SHARED float balancing_strain(vec3 first, vec3 second, float rest_length, float compression) {
    precise vec3 edge = second - first;
    precise float strain = (sqrt(ordered_dot(edge, edge)) - rest_length) / rest_length;
    return balancing_tension(strain, compression);
}

/// Returns the summed strains of a cell's diagonals, weighted by their shares. The corners are a b over c d, the
/// diagonals a d and b c, whose rest lengths are `rest`, m.
SHARED float diagonal_strains(vec3 a, vec3 b, vec3 c, vec3 d, float share_down_right, float share_down_left, vec2 rest,
                              float compression) {
    precise float sum = share_down_right * balancing_strain(a, d, rest.x, compression) +
                        share_down_left * balancing_strain(b, c, rest.y, compression);
    return sum;
}

/// Returns the load of a spring divided by its limit: its strain (m/m) plus `weight` times `diagonals`, the summed
/// strains of the diagonals in the two cells beside it.
SHARED float tear_load(float strain, float diagonals, float weight, float limit) {
    precise float load = (strain + weight * diagonals) / limit;
    return load;
}

#endif
