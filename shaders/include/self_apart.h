// Cloths that started through each other are led apart (docs/physics.md 5): while a cell of one crosses a cell of the
// other, the two have no contact, and each is moved as a whole, along the direction that was shortest at the start.
#ifndef DRAPE_SELF_APART_H
#define DRAPE_SELF_APART_H

#include "include/self_gap.h"
#include "shared/self_contact_types.h"

/// The corners of a cell, for its two triangles and three edges, with a bit for each that exists: triangles in bits 0
/// and 1, edges from bit 2 on (self_edge).
struct SelfCell {
    vec3 first, right, below, last;
    uint bits;
};

/// Returns whether the edge p-q meets the triangle a-b-c, or meets its plane at most `doubt` (m) beside the triangle,
/// which rounding cannot exclude. The answer means nothing for a triangle without area.
SHARED bool self_pierces(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c, float doubt) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 ap = p - a;
    precise vec3 aq = q - a;
    vec3 square = ordered_cross(ab, ac);
    precise float area = sqrt(ordered_dot(square, square));
    precise vec3 normal = square / area;
    float height_p = ordered_dot(normal, ap), height_q = ordered_dot(normal, aq);
    precise float whole = abs(height_p) + abs(height_q);
    precise vec3 edge = q - p;
    // The edge meets the plane there. An edge that does not reach the plane gives a point that is not on it, which is
    // farther off than rounding could explain.
    precise vec3 at = ap + edge * self_ratio(abs(height_p), whole);
    vec3 nothing = vec3(0.0f, 0.0f, 0.0f);
    vec3 weights = nearest_in_triangle(at, nothing, ab, ac);
    precise vec3 off = (ab * weights.y + ac * weights.z) - at;
    // Along an edge that is nearly parallel to the plane the point may be farther off, up to a limit; without one,
    // anything beside a triangle in its plane would count.
    precise float loose = doubt * self_least(1.0f + self_ratio(sqrt(ordered_dot(edge, edge)), whole), 16.0f);
    precise float within = loose * loose;
    return ordered_dot(off, off) <= within;
}

/// Returns whether edge k of a cell meets a triangle of another cell.
SHARED bool self_edge_pierces(SelfCell one, int k, SelfCell other, float doubt) {
    vec3 p = k == 2 ? one.right : one.first, q = k == 0 ? one.right : one.below;
    bool upper = (other.bits & 1u) != 0u && self_pierces(p, q, other.first, other.right, other.below, doubt);
    bool lower = (other.bits & 2u) != 0u && self_pierces(p, q, other.right, other.last, other.below, doubt);
    return (one.bits & (4u << k)) != 0u && (upper || lower);
}

/// Returns whether two cells cross: an edge of one goes through a triangle of the other.
SHARED bool self_cells_cross(SelfCell one, SelfCell other) {
    float doubt = self_doubt(self_largest(self_largest_coordinate(one.first), self_largest_coordinate(other.first)));
    precise float touching = doubt * 4.0f;
    bool crosses = false;
    for (int k = 0; k < 3; ++k)
        crosses = crosses || self_edge_pierces(one, k, other, touching) || self_edge_pierces(other, k, one, touching);
    return crosses;
}

/// Returns by how much (m) cloths that started through each other should separate in a substep, and how much more at
/// most than in the previous one.
SHARED vec2 self_parting(float step) {
    precise float moves = self_parting_speed * step;
    precise float change = (self_parting_acceleration * step) * step;
    return vec2(moves, change);
}

/// Returns how fast two cells that cross separate along the direction, in units of self_parting_units, limited to the
/// wanted speed.
SHARED int self_parting_of(vec3 way, vec3 moved_first, vec3 moved_second, vec2 parting) {
    precise vec3 relative = moved_second - moved_first;
    precise float share = ordered_dot(way, relative) / parting.x;
    float most = share < 1.0f ? share : 1.0f;
    precise float units = (share > -1.0f ? most : -1.0f) * float(self_parting_units);
    return int(units);
}

/// Returns by how much (m) two cloths should separate more than they do.
SHARED float self_lacking(SelfCrossings found, vec2 parting) {
    precise float mean = float(found.sum) / (float(found.count) * float(self_parting_units));
    precise float lacking = parting.x - parting.x * mean;
    float wanted = self_least(self_largest(lacking, 0.0f), parting.y);
    return found.count > 0 ? wanted : 0.0f;
}

/// Returns `led`, the displacement by earlier pairs, plus that of one pair of cloths if `cloth` belongs to it.
SHARED vec3 self_led_apart(vec3 led, SelfCrossed pair, int cloth, float lacking) {
    float part = cloth == pair.cloths.x ? -pair.parts.x : cloth == pair.cloths.y ? pair.parts.y : 0.0f;
    precise vec3 sum = led + vec3(pair.way.x, pair.way.y, pair.way.z) * (part * lacking);
    return sum;
}

SHARED vec3 self_led(vec3 displacement, vec3 led) {
    precise vec3 moved = displacement + led;
    return moved;
}

#endif
