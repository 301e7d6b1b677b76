// Contact of a cloth with itself (docs/physics.md 5). A pair is a particle and a triangle, or two edges,
// that share no corner: nothing else meets first when a surface comes to cross itself. Of every pair that a substep may
// bring together a plane between the two is known, and no corner goes more than half of its way to that plane: so
// nothing crosses, whatever the solver wants (Newton's planar truncation; the bound per particle is that of Chen et
// al. 2025, "Offset Geometric Contact"). Before that pairs nearer than the thickness are pushed apart, with friction.
#ifndef DRAPE_SELF_CONTACT_H
#define DRAPE_SELF_CONTACT_H

#include "include/triangles.h"
#include "include/vector.h"
#include "shared/self_contact_types.h"

/// Share of its room that a free particle may use; a held one, which goes where it is told.
const float self_room_share = 0.5f, self_held_share = 0.95f;
/// A correction is at most this share of the thickness: what the list of pairs reckons with.
const float self_correction_share = 0.24f, self_listed_share = 0.5f;
/// More than this many nodes visited, about the loops that the default device allows, would be broken off unseen.
const int self_visit_limit = 60000;

/// Four corners of a pair: particle and triangle, or the ends of one edge and of the other.
struct SelfCorners {
    vec3 a, b, c, d;
};

/// Where two disjoint primitives are nearest, and a plane between them.
struct SelfGap {
    vec4 weights;    // of the corners: their weighted sum leads from the first primitive's nearest point to the other's
    vec3 normal;     // that way, unit length; zero where the two touch
    float distance;  // m
    float apart;     // m between two planes with this normal that have the two on either side; not > 0: none found
    vec4 room;       // m from each corner to the plane in the middle
    float doubt;     // m: what rounding of coordinates this large leaves in doubt
};

SHARED float self_limited(float x) { return x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x; }

/// a / b, 0 where b is not positive.
SHARED float self_ratio(float a, float b) {
    precise float ratio = b > 0.0f ? a / b : 0.0f;
    return ratio;
}

/// Weights of a triangle's corners at its point nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
SHARED vec3 nearest_in_triangle(vec3 p, vec3 a, vec3 b, vec3 c) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 ap = p - a;
    precise vec3 bp = p - b;
    precise vec3 cp = p - c;
    float d1 = ordered_dot(ab, ap), d2 = ordered_dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f) return vec3(1.0f, 0.0f, 0.0f);
    float d3 = ordered_dot(ab, bp), d4 = ordered_dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3) return vec3(0.0f, 1.0f, 0.0f);
    precise float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
        precise float length = d1 - d3;
        precise float v = self_ratio(d1, length);
        precise float rest = 1.0f - v;
        return vec3(rest, v, 0.0f);
    }
    float d5 = ordered_dot(ab, cp), d6 = ordered_dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6) return vec3(0.0f, 0.0f, 1.0f);
    precise float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
        precise float length = d2 - d6;
        precise float w = self_ratio(d2, length);
        precise float rest = 1.0f - w;
        return vec3(rest, 0.0f, w);
    }
    precise float va = d3 * d6 - d5 * d4;
    precise float along = d4 - d3;
    precise float back = d5 - d6;
    if (va <= 0.0f && along >= 0.0f && back >= 0.0f) {
        precise float length = along + back;
        precise float w = self_ratio(along, length);
        precise float rest = 1.0f - w;
        return vec3(0.0f, rest, w);
    }
    precise float area = (va + vb) + vc;
    precise float v = self_ratio(vb, area);
    precise float w = self_ratio(vc, area);
    precise float u = (1.0f - v) - w;
    return vec3(u, v, w);
}

/// Where two edges a-b and c-d are nearest, as shares of their lengths (the same, 5.1.9).
SHARED vec2 nearest_on_edges(vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 first = b - a;
    precise vec3 second = d - c;
    precise vec3 between = a - c;
    float aa = ordered_dot(first, first), ee = ordered_dot(second, second), ff = ordered_dot(second, between),
          cc = ordered_dot(first, between), bb = ordered_dot(first, second);
    precise float denominator = aa * ee - bb * bb;
    precise float numerator = bb * ff - cc * ee;
    float s = self_limited(self_ratio(numerator, denominator));
    precise float reached = bb * s + ff;
    float t = self_limited(self_ratio(reached, ee));
    precise float back = bb * t - cc;
    s = self_limited(self_ratio(back, aa));
    return vec2(s, t);
}

SHARED float self_least(float a, float b) { return b < a ? b : a; }
SHARED float self_largest(float a, float b) { return b > a ? b : a; }

/// Relative to the first corner, where coordinates are small.
SHARED SelfCorners self_relative(SelfCorners x) {
    precise vec3 b = x.b - x.a;
    precise vec3 c = x.c - x.a;
    precise vec3 d = x.d - x.a;
    return SelfCorners(vec3(0.0f, 0.0f, 0.0f), b, c, d);
}

SHARED vec4 self_weights(bool edges, SelfCorners x) {
    if (edges) {
        vec2 at = nearest_on_edges(x.a, x.b, x.c, x.d);
        precise float first = at.x - 1.0f;
        precise float second = 1.0f - at.y;
        return vec4(first, -at.x, second, at.y);
    }
    vec3 at = nearest_in_triangle(x.a, x.b, x.c, x.d);
    return vec4(-1.0f, at.x, at.y, at.z);
}

SHARED vec3 self_sum(vec4 weights, SelfCorners x) {
    precise vec3 sum = ((x.a * weights.x + x.b * weights.y) + x.c * weights.z) + x.d * weights.w;
    return sum;
}

SHARED float self_largest_coordinate(vec3 x) {
    return self_largest(self_largest(abs(x.x), abs(x.y)), abs(x.z));
}

/// A few roundings of a coordinate.
SHARED float self_doubt(float coordinate) {
    precise float doubt = coordinate * 1.0e-6f;
    return doubt;
}

SHARED SelfGap self_gap(bool edges, SelfCorners corners) {
    SelfCorners x = self_relative(corners);
    vec4 weights = self_weights(edges, x);
    vec3 across = self_sum(weights, x);
    precise float distance = sqrt(ordered_dot(across, across));
    float doubt = self_doubt(
        self_largest(self_largest(self_largest_coordinate(corners.a), self_largest_coordinate(corners.b)),
                     self_largest(self_largest_coordinate(corners.c), self_largest_coordinate(corners.d))));
    SelfGap none = SelfGap(weights, vec3(0.0f, 0.0f, 0.0f), distance, 0.0f, vec4(0.0f, 0.0f, 0.0f, 0.0f), doubt);
    if (!(distance > 1.0e-12f)) return none;
    precise vec3 normal = across / distance;
    float b = ordered_dot(normal, x.b), c = ordered_dot(normal, x.c), d = ordered_dot(normal, x.d);
    float below = edges ? self_largest(0.0f, b) : 0.0f;
    float above = edges ? self_least(c, d) : self_least(b, self_least(c, d));
    precise float apart = above - below;
    precise float middle = (above + below) * 0.5f;
    precise float room_b = edges ? middle - b : b - middle;
    precise float room_c = c - middle;
    precise float room_d = d - middle;
    return SelfGap(weights, normal, distance, apart, vec4(middle, room_b, room_c, room_d), doubt);
}

/// The thickness that a pair keeps. Primitives that are nearer than two thicknesses in the flat cloth keep half of that
/// distance: pushed together in its plane the cloth is not stiffer for it. `corners`: columns and rows of the
/// particles.
SHARED float self_pair_thickness(SelfContactPush push, bool edges, ivec2 a, ivec2 b, ivec2 c, ivec2 d) {
    int columns = b.x - a.x, rows = b.y - a.y;
    if (edges) {
        columns = c.x - a.x;
        rows = c.y - a.y;
    }
    if (columns > 4 || columns < -4 || rows > 4 || rows < -4) return push.thickness;
    precise vec3 flat_a = vec3(float(a.x) * push.spacing.x, float(a.y) * push.spacing.y, 0.0f);
    precise vec3 flat_b = vec3(float(b.x) * push.spacing.x, float(b.y) * push.spacing.y, 0.0f);
    precise vec3 flat_c = vec3(float(c.x) * push.spacing.x, float(c.y) * push.spacing.y, 0.0f);
    precise vec3 flat_d = vec3(float(d.x) * push.spacing.x, float(d.y) * push.spacing.y, 0.0f);
    SelfCorners x = self_relative(SelfCorners(flat_a, flat_b, flat_c, flat_d));
    vec3 across = self_sum(self_weights(edges, x), x);
    precise float half_distance = sqrt(ordered_dot(across, across)) * 0.5f;
    return self_least(push.thickness, half_distance);
}

/// Length, rounded up.
SHARED float self_motion(vec3 displacement) {
    precise float motion = sqrt(ordered_dot(displacement, displacement)) * 1.000001f;
    return motion;
}

/// Most that a pair's distance changes in a substep before contact corrects it.
SHARED float self_approach(bool edges, SelfCorners moved) {
    float a = self_motion(moved.a), b = self_motion(moved.b),
          last = self_largest(self_motion(moved.c), self_motion(moved.d));
    precise float approach = edges ? self_largest(a, b) + last : a + self_largest(b, last);
    return approach;
}

/// Distance within which a pair is listed: it may come nearer than its thickness; or, with what contact may add to
/// every corner's motion, meet.
SHARED float self_listing_distance(SelfGap gap, float pair_thickness, float thickness, float approach) {
    precise float slack = thickness * self_listed_share;
    precise float listing = (self_largest(pair_thickness, slack) + approach) + gap.doubt;
    return listing;
}

/// Most that lies between two boxes along an axis, a lower bound of their distance.
SHARED float self_box_distance(SelfBox a, SelfBox b) {
    precise float x = a.lower.x - b.upper.x;
    precise float y = a.lower.y - b.upper.y;
    precise float z = a.lower.z - b.upper.z;
    precise float back_x = b.lower.x - a.upper.x;
    precise float back_y = b.lower.y - a.upper.y;
    precise float back_z = b.lower.z - a.upper.z;
    return self_largest(self_largest(self_largest(x, back_x), self_largest(y, back_y)), self_largest(z, back_z));
}

/// Whether two primitives are farther apart than `reach` along an axis.
SHARED bool self_far(bool edges, SelfCorners x, float reach) {
    vec3 lower = x.a, upper = x.a, other_lower = x.c, other_upper = x.c;
    if (edges) {
        lower = vec3(self_least(x.a.x, x.b.x), self_least(x.a.y, x.b.y), self_least(x.a.z, x.b.z));
        upper = vec3(self_largest(x.a.x, x.b.x), self_largest(x.a.y, x.b.y), self_largest(x.a.z, x.b.z));
    } else {
        other_lower = vec3(self_least(x.b.x, x.c.x), self_least(x.b.y, x.c.y), self_least(x.b.z, x.c.z));
        other_upper = vec3(self_largest(x.b.x, x.c.x), self_largest(x.b.y, x.c.y), self_largest(x.b.z, x.c.z));
    }
    vec3 next_lower =
        vec3(self_least(other_lower.x, x.d.x), self_least(other_lower.y, x.d.y), self_least(other_lower.z, x.d.z));
    vec3 next_upper = vec3(self_largest(other_upper.x, x.d.x), self_largest(other_upper.y, x.d.y),
                           self_largest(other_upper.z, x.d.z));
    precise vec3 ahead = next_lower - upper;
    precise vec3 behind = lower - next_upper;
    return ahead.x > reach || ahead.y > reach || ahead.z > reach || behind.x > reach || behind.y > reach ||
           behind.z > reach;
}

/// Within which what is in two boxes may be listed.
SHARED float self_reach(SelfBox a, SelfBox b, SelfContactPush push) {
    float doubt = self_doubt(
        self_largest(self_largest_coordinate(vec3(a.lower.x, a.lower.y, a.lower.z)),
                     self_largest_coordinate(vec3(a.upper.x, a.upper.y, a.upper.z))));
    precise float reach = (((a.lower.w + b.lower.w) + push.thickness) + push.least) + doubt;
    return reach;
}

/// Whether what is in two boxes may be listed.
SHARED bool self_boxes_meet(SelfBox a, SelfBox b, SelfContactPush push) {
    return self_box_distance(a, b) <= self_reach(a, b, push);
}

SHARED SelfBox self_joined(SelfBox a, SelfBox b) {
    return SelfBox(vec4(self_least(a.lower.x, b.lower.x), self_least(a.lower.y, b.lower.y),
                        self_least(a.lower.z, b.lower.z), self_largest(a.lower.w, b.lower.w)),
                   vec4(self_largest(a.upper.x, b.upper.x), self_largest(a.upper.y, b.upper.y),
                        self_largest(a.upper.z, b.upper.z), 0.0f));
}

SHARED SelfBox self_point_box(vec3 at, vec3 displacement) {
    return SelfBox(vec4(at.x, at.y, at.z, self_motion(displacement)), vec4(at.x, at.y, at.z, 0.0f));
}

/// What pushes a pair's corners: corner i, of inverse mass w_i and weight g_i, moves by w_i g_i times this. Zero where
/// they stay apart. Of a thickness that is missing already only `recovery` is given back. Friction is Coulomb's, on
/// the displacement of the substep (docs/physics.md 5), against how deep the pair would be.
SHARED vec3 self_impulse(SelfGap gap, SelfCorners moved, vec4 inverse_mass, float pair_thickness, float friction,
                         float recovery) {
    vec3 nothing = vec3(0.0f, 0.0f, 0.0f);
    if (!(gap.distance > 1.0e-12f)) return nothing;
    precise float given_back = gap.distance + recovery;
    float target = self_least(pair_thickness, given_back);
    vec3 relative = self_sum(gap.weights, moved);
    float along = ordered_dot(gap.normal, relative);
    precise float missing = target - (gap.distance + along);
    float depth = self_least(missing, pair_thickness);
    if (!(depth > 0.0f)) return nothing;
    vec4 g = gap.weights;
    precise float mass = ((inverse_mass.x * g.x * g.x + inverse_mass.y * g.y * g.y) + inverse_mass.z * g.z * g.z) +
                         inverse_mass.w * g.w * g.w;
    if (!(mass > 0.0f)) return nothing;
    precise vec3 tangent = relative - gap.normal * along;
    precise float sliding = sqrt(ordered_dot(tangent, tangent));
    precise float grip = friction * depth;
    precise float kept = sliding > grip ? grip / sliding : 1.0f;
    precise vec3 impulse = (gap.normal * depth - tangent * kept) / mass;
    return impulse;
}

/// A component of a correction in units; what is not a number is none.
SHARED int self_units(float correction, float units_per_metre) {
    precise float units = correction * units_per_metre;
    if (!(units > -self_correction_units)) return units <= -self_correction_units ? -int(self_correction_units) : 0;
    return units < self_correction_units ? int(units) : int(self_correction_units);
}

/// The corrections of all pairs that a particle is in: xyz in units, w the sum of its weights. Where it is in several
/// they are averaged by weight, so that layers that lie on each other corner on corner get what one pair would.
SHARED vec3 self_corrected(vec3 displacement, ivec4 sum, float thickness) {
    if (sum.w == 0) return displacement;
    precise float weight = float(sum.w) / self_weight_units;
    precise float unit = thickness / self_correction_units / self_largest(weight, 1.0f);
    precise vec3 correction = vec3(float(sum.x), float(sum.y), float(sum.z)) * unit;
    precise float length = sqrt(ordered_dot(correction, correction));
    precise float most = thickness * self_correction_share;
    precise float share = length > most ? most / length : 1.0f;
    precise vec3 corrected = displacement + correction * share;
    return corrected;
}

/// Most that a particle may move in a substep: what it would before contact, and what contact may add.
SHARED float self_limit(vec3 displacement, float thickness) {
    precise float limit = self_motion(displacement) + thickness * self_correction_share;
    return limit;
}

SHARED bool self_exceeds(vec3 displacement, float limit) {
    precise float length = sqrt(ordered_dot(displacement, displacement));
    return length > limit;
}

/// What colliders made of a corrected displacement, no longer than the limit that the list of pairs reckons with.
SHARED vec3 self_bounded(vec3 displacement, float limit) {
    precise float length = sqrt(ordered_dot(displacement, displacement));
    precise float share = length > limit ? limit / length : 1.0f;
    precise vec3 bounded = displacement * share;
    return bounded;
}

/// Share of its displacement that a pair lets a corner make, 1: all of it. `room`: from the corner to the plane
/// between the two, `side`: 1 where it lies before that plane along the normal, -1 beyond; `share` of the room that it
/// may use.
SHARED float self_share(SelfGap gap, float room, float side, vec3 displacement, float share, float least) {
    precise float toward = ordered_dot(gap.normal, displacement) * side;
    float doubt = self_largest(least, gap.doubt);
    precise float nearly = doubt * 0.25f;
    if (!(gap.apart > nearly)) return ordered_dot(displacement, displacement) > 0.0f ? 0.0f : 1.0f;
    precise float allowed = gap.apart > doubt ? room * share : 0.0f;
    if (!(toward > allowed)) return 1.0f;
    precise float part = allowed / toward;
    return part;
}

SHARED vec3 self_truncated(vec3 displacement, float share) {
    precise vec3 truncated = displacement * share;
    return truncated;
}

SHARED int self_weight(float weight) {
    precise float units = abs(weight) * self_weight_units;
    return int(units);
}

/// Pairs that are in the list.
SHARED int self_listed(uint pair_count, int pair_room) {
    return pair_count < uint(pair_room) ? int(pair_count) : pair_room;
}

/// A corner in a pair: row and column; self_edge_pair may be set beside them.
SHARED uint self_corner(ivec2 texel) { return (uint(texel.y) << 16) | uint(texel.x); }
SHARED ivec2 self_texel(uint corner) { return ivec2(int(corner & 0xffffu), int((corner & 0x7fff0000u) >> 16)); }

/// Boxes along columns and rows of a level of the tree, and all of them.
SHARED ivec2 self_tree_size(ivec2 grid, int level) {
    return ivec2(((grid.x - 1) >> level) + 1, ((grid.y - 1) >> level) + 1);
}
SHARED int self_tree_count(ivec2 grid, int level) {
    ivec2 size = self_tree_size(grid, level);
    return size.x * size.y;
}

/// Edge k (0..2) that a particle owns: its ends relative to the particle.
SHARED ivec4 self_edge(int k) {
    if (k == 0) return ivec4(0, 0, 1, 0);
    if (k == 1) return ivec4(0, 0, 0, 1);
    return ivec4(1, 0, 0, 1);
}

/// The two triangles that may have that edge: cell relative to the particle, and which one.
SHARED ivec4 self_edge_owner(int k, int side) {
    if (k == 2) return ivec4(0, 0, side == 0 ? 1 : 2, 0);
    if (side == 0) return ivec4(0, 0, 1, 0);
    return k == 0 ? ivec4(0, -1, 2, 0) : ivec4(-1, 0, 2, 0);
}

#endif
