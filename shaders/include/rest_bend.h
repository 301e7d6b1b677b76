// Bending of cloth that rests in the shape that it starts in. An element's energy is b/2 |d - D(x)|^2, where d is its
// difference (bend.h) and D that of the shape at rest as the cloth has turned there: with the start's D = alpha row +
// beta column + gamma row x column in the tangents of its place, D(x) has the same coordinates in those of now. This is
// polynomial, and turns with the cloth, so its gradient keeps both momenta (compare Garg et al. 2007, "Cubic Shells").
#ifndef DRAPE_REST_BEND_H
#define DRAPE_REST_BEND_H

#include "include/vector.h"

/// The directions in which column and row grow at a place of the cloth, m.
struct Tangents {
    vec3 row, column;
};

/// Returns alpha, beta, gamma and 1. Where the tangents span no plane, as in a strand one particle wide, which has no
/// side, it returns the difference's length and 0.
SHARED vec4 rest_coordinates(vec3 difference, Tangents rest) {
    vec3 normal = ordered_cross(rest.row, rest.column);
    float squared = ordered_dot(normal, normal);
    precise float least = 1.0e-8f * (ordered_dot(rest.row, rest.row) * ordered_dot(rest.column, rest.column));
    if (!(squared > least)) return vec4(sqrt(ordered_dot(difference, difference)), 0.0f, 0.0f, 0.0f);
    float per_squared = reciprocal(squared);
    precise float along_row = ordered_dot(difference, ordered_cross(rest.column, normal)) * per_squared;
    precise float along_column = ordered_dot(difference, ordered_cross(normal, rest.row)) * per_squared;
    precise float across = ordered_dot(difference, normal) * per_squared;
    return vec4(along_row, along_column, across, 1.0f);
}

/// Returns D for current tangents and difference. In a strand, D points in the direction of the current difference.
SHARED vec3 rest_difference(vec4 coordinates, Tangents now, vec3 difference) {
    float size = sqrt(ordered_dot(difference, difference));
    precise vec3 strand = difference * (coordinates.x / (size > 0.0f ? size : 1.0f));
    precise vec3 sheet =
        now.row * coordinates.x + now.column * coordinates.y + ordered_cross(now.row, now.column) * coordinates.z;
    return coordinates.w == 0.0f ? strand : sheet;
}

/// Returns the force on the tangents, (dD/dx)^T beyond, for `beyond` = b (d - D).
SHARED Tangents rest_pull(vec4 coordinates, Tangents now, vec3 beyond) {
    precise vec3 row = beyond * coordinates.x + ordered_cross(now.column, beyond) * coordinates.z;
    precise vec3 column = beyond * coordinates.y + ordered_cross(beyond, now.row) * coordinates.z;
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    if (coordinates.w == 0.0f) return Tangents(none, none);
    return Tangents(row, column);
}

SHARED Tangents sum_of_pulls(Tangents one, Tangents other) {
    precise vec3 row = one.row + other.row;
    precise vec3 column = one.column + other.column;
    return Tangents(row, column);
}

/// Adds a pull to a sum with `sign`: 1 or -1 as the particle is at the tangent's end or start, or 0.
SHARED vec3 add_pull_of(vec3 sum, vec3 pull, float sign) {
    precise vec3 total = sum + pull * sign;
    return total;
}

#endif
