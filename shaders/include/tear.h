// How hard a cloth is pulled along its rows and columns, over what it bears (docs/physics.md 8).
#ifndef DRAPE_TEAR_H
#define DRAPE_TEAR_H

#include "include/spring.h"

/// Strain of a spring, of which one pushed together has `compression` of.
SHARED float balancing_strain(vec3 first, vec3 second, float rest_length, float compression) {
    precise vec3 edge = second - first;
    precise float strain = (sqrt(ordered_dot(edge, edge)) - rest_length) / rest_length;
    return balancing_tension(strain, compression);
}

/// Strains of the diagonals of a cell with the corners a b over c d, by their shares: a d and b c, whose lengths at
/// rest are `rest`, m.
SHARED float diagonal_strains(vec3 a, vec3 b, vec3 c, vec3 d, float share_down_right, float share_down_left, vec2 rest,
                              float compression) {
    precise float sum = share_down_right * balancing_strain(a, d, rest.x, compression) +
                        share_down_left * balancing_strain(b, c, rest.y, compression);
    return sum;
}

/// Load of a spring over its limit: a strain (m/m) that `diagonals`, the summed strains of those in the two cells
/// beside it, add to by `weight`.
SHARED float tear_load(float strain, float diagonals, float weight, float limit) {
    precise float load = (strain + weight * diagonals) / limit;
    return load;
}

#endif
