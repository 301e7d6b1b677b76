// Decides by signs of volumes whether a segment crosses a triangle, and whether two triangles intersect. It uses + - *
// alone, so that shader and C++ agree bit for bit.
// positive side), so a blade exactly through a particle separates it from one side only; triangles are closed along
// their edges, so nothing slips through the seam of two.
#ifndef DRAPE_CUT_H
#define DRAPE_CUT_H

#include "include/vector.h"

/// The fraction of a spring that nothing crosses.
const float not_crossed = -1.0f;

/// Returns the fraction along p -> q at which it crosses triangle a b c, in [0, 1]; not_crossed if it does not. Nothing
/// crosses a degenerate triangle.
SHARED float crossing_fraction(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
    precise vec3 edge_ab = b - a;
    precise vec3 edge_ac = c - a;
    vec3 normal = ordered_cross(edge_ab, edge_ac);
    precise vec3 from_a_to_p = p - a;
    precise vec3 from_a_to_q = q - a;
    float height_p = ordered_dot(normal, from_a_to_p);
    float height_q = ordered_dot(normal, from_a_to_q);
    if ((height_p < 0.0f) == (height_q < 0.0f)) return not_crossed;
    // The segment crosses the triangle if the line p q passes its three edges on the same side.
    precise vec3 along = q - p;
    precise vec3 to_a = a - p;
    precise vec3 to_b = b - p;
    precise vec3 to_c = c - p;
    float ab = ordered_dot(along, ordered_cross(to_a, to_b));
    float bc = ordered_dot(along, ordered_cross(to_b, to_c));
    float ca = ordered_dot(along, ordered_cross(to_c, to_a));
    bool inside = (ab >= 0.0f && bc >= 0.0f && ca >= 0.0f) || (ab <= 0.0f && bc <= 0.0f && ca <= 0.0f);
    if (!inside) return not_crossed;
    precise float drop = height_p - height_q;
    precise float fraction = height_p / drop;
    return fraction;
}

/// Returns whether two triangles intersect: an edge of one crosses the other. Coplanar triangles do not intersect.
SHARED bool triangles_intersect(vec3 p, vec3 q, vec3 r, vec3 a, vec3 b, vec3 c) {
    return crossing_fraction(p, q, a, b, c) >= 0.0f || crossing_fraction(q, r, a, b, c) >= 0.0f ||
           crossing_fraction(r, p, a, b, c) >= 0.0f || crossing_fraction(a, b, p, q, r) >= 0.0f ||
           crossing_fraction(b, c, p, q, r) >= 0.0f || crossing_fraction(c, a, p, q, r) >= 0.0f;
}

#endif
