// Distance of two primitives of a cloth (a particle and a triangle, or two edges), and a plane between them.
#ifndef DRAPE_SELF_GAP_H
#define DRAPE_SELF_GAP_H

#include "include/vector.h"

/// The four corners of a pair: particle and triangle, or the ends of one edge and of the other.
struct SelfCorners {
    vec3 a, b, c, d;
};

/// The place where two disjoint primitives are nearest, and a plane between them.
struct SelfGap {
    vec4 weights;    // corners' weighted sum leads from the first primitive's nearest point to the other's
    vec3 normal;     // direction of that sum, unit length; zero if the two touch
    float distance;  // m
    float apart;     // m between two planes with this normal that separate the two; not > 0: none was found
    vec4 height;     // m of the corners along the normal, relative to the first one
    float doubt;     // m that the rounding of coordinates of this size leaves uncertain
};

SHARED float self_limited(float x) { return x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x; }

SHARED float self_ratio(float a, float b) {
    precise float ratio = b > 0.0f ? a / b : 0.0f;
    return ratio;
}

/// Weights of a triangle's corners at its point nearest to p (Ericson, Real-Time Collision Detection, 5.1.5). All cases
/// are computed, and the first that applies is selected: on the default device that costs as much as one of them.
SHARED vec3 nearest_in_triangle(vec3 p, vec3 a, vec3 b, vec3 c) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    precise vec3 ap = p - a;
    precise vec3 bp = p - b;
    precise vec3 cp = p - c;
    float d1 = ordered_dot(ab, ap), d2 = ordered_dot(ac, ap);
    float d3 = ordered_dot(ab, bp), d4 = ordered_dot(ac, bp);
    float d5 = ordered_dot(ab, cp), d6 = ordered_dot(ac, cp);
    precise float vc = d1 * d4 - d3 * d2;
    precise float vb = d5 * d2 - d1 * d6;
    precise float va = d3 * d6 - d5 * d4;
    precise float area = (va + vb) + vc;
    float per_area = reciprocal(area);
    precise float v = vb * per_area;
    precise float w = vc * per_area;
    precise float u = (1.0f - v) - w;
    precise float length_ab = d1 - d3;
    precise float length_ac = d2 - d6;
    precise float along = d4 - d3;
    precise float back = d5 - d6;
    precise float length_bc = along + back;
    float on_ab = self_ratio(d1, length_ab), on_ac = self_ratio(d2, length_ac), on_bc = self_ratio(along, length_bc);
    precise float rest_ab = 1.0f - on_ab;
    precise float rest_ac = 1.0f - on_ac;
    precise float rest_bc = 1.0f - on_bc;
    vec3 weights = vec3(u, v, w);
    weights = va <= 0.0f && along >= 0.0f && back >= 0.0f ? vec3(0.0f, rest_bc, on_bc) : weights;
    weights = vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f ? vec3(rest_ac, 0.0f, on_ac) : weights;
    weights = d6 >= 0.0f && d5 <= d6 ? vec3(0.0f, 0.0f, 1.0f) : weights;
    weights = vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f ? vec3(rest_ab, on_ab, 0.0f) : weights;
    weights = d3 >= 0.0f && d4 <= d3 ? vec3(0.0f, 1.0f, 0.0f) : weights;
    return d1 <= 0.0f && d2 <= 0.0f ? vec3(1.0f, 0.0f, 0.0f) : weights;
}

/// Returns the places where two edges a-b and c-d are nearest, as shares of their lengths (Ericson, 5.1.9).
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

/// Moves the corners to where coordinates are small, relative to the first one.
SHARED SelfCorners self_relative(SelfCorners x) {
    precise vec3 b = x.b - x.a;
    precise vec3 c = x.c - x.a;
    precise vec3 d = x.d - x.a;
    return SelfCorners(vec3(0.0f, 0.0f, 0.0f), b, c, d);
}

/// `edges` is a constant in every call.
SHARED vec4 self_weights(bool edges, SelfCorners x) {
    vec4 weights;
    if (edges) {
        vec2 at = nearest_on_edges(x.a, x.b, x.c, x.d);
        precise float first = at.x - 1.0f;
        precise float second = 1.0f - at.y;
        weights = vec4(first, -at.x, second, at.y);
    } else {
        vec3 at = nearest_in_triangle(x.a, x.b, x.c, x.d);
        weights = vec4(-1.0f, at.x, at.y, at.z);
    }
    return weights;
}

SHARED vec3 self_sum(vec4 weights, SelfCorners x) {
    precise vec3 sum = ((x.a * weights.x + x.b * weights.y) + x.c * weights.z) + x.d * weights.w;
    return sum;
}

SHARED float self_largest_coordinate(vec3 x) { return self_largest(self_largest(abs(x.x), abs(x.y)), abs(x.z)); }

/// Returns the distance (m) that a few roundings of a coordinate leave uncertain.
SHARED float self_doubt(float coordinate) {
    precise float doubt = coordinate * 1.0e-6f;
    return doubt;
}

/// `normal`: unit length or zero; `x`: relative to the first corner.
SHARED SelfGap self_gap_along(bool edges, SelfCorners x, vec3 normal, vec4 weights, float distance, float doubt) {
    float b = ordered_dot(normal, x.b), c = ordered_dot(normal, x.c), d = ordered_dot(normal, x.d);
    float below = edges ? self_largest(0.0f, b) : 0.0f;
    float above = edges ? self_least(c, d) : self_least(b, self_least(c, d));
    precise float apart = above - below;
    return SelfGap(weights, normal, distance, apart, vec4(0.0f, b, c, d), doubt);
}

SHARED SelfGap self_gap(bool edges, SelfCorners corners) {
    SelfCorners x = self_relative(corners);
    vec4 weights = self_weights(edges, x);
    vec3 across = self_sum(weights, x);
    precise float distance = sqrt(ordered_dot(across, across));
    float doubt =
        self_doubt(self_largest(self_largest(self_largest_coordinate(corners.a), self_largest_coordinate(corners.b)),
                                self_largest(self_largest_coordinate(corners.c), self_largest_coordinate(corners.d))));
    precise vec3 direction = across * reciprocal(distance);
    vec3 normal = distance > 1.0e-12f ? direction : vec3(0.0f, 0.0f, 0.0f);
    return self_gap_along(edges, x, normal, weights, distance, doubt);
}

/// Returns a vector without its component along another; all of it where the other is zero.
SHARED vec3 self_without(vec3 x, vec3 along) {
    float part = self_ratio(ordered_dot(x, along), ordered_dot(along, along));
    precise vec3 rest = x - along * part;
    return rest;
}

/// Returns a pair's gap with a plane along the two edges, or along the triangle, inside which the two are nearest. For
/// primitives that almost touch, the line between their nearest points is mostly rounding; a plane perpendicular to it
/// might have both on either side, and then nothing could ever move again.
SHARED SelfGap self_gap_squared(bool edges, SelfCorners corners) {
    SelfGap gap = self_gap(edges, corners);
    SelfCorners x = self_relative(corners);
    vec4 g = gap.weights;
    vec3 nothing = vec3(0.0f, 0.0f, 0.0f), first = nothing, second = nothing;
    precise vec3 one = x.b - x.a;
    precise vec3 other = x.d - x.c;
    precise vec3 bc = x.c - x.b;
    precise vec3 bd = x.d - x.b;
    bool has_b = g.y != 0.0f, has_c = g.z != 0.0f, has_d = g.w != 0.0f;
    if (edges) {
        first = g.x != 0.0f && has_b ? one : nothing;
        second = has_c && has_d ? other : nothing;
    } else {
        first = has_b && has_c ? bc : has_c && has_d ? other : has_b && has_d ? bd : nothing;
        second = has_b && has_c && has_d ? bd : nothing;
    }
    second = self_without(second, first);
    // This is done twice: the remainder that rounding leaves the first time is small the second time.
    vec3 square = self_without(self_without(gap.normal, first), second);
    square = self_without(self_without(square, first), second);
    precise float length = sqrt(ordered_dot(square, square));
    precise vec3 unit = square * reciprocal(length);
    vec3 normal = length > 1.0e-4f ? unit : gap.normal;
    SelfGap squared = self_gap_along(edges, x, normal, g, gap.distance, gap.doubt);
    if (squared.apart > gap.apart) return squared;
    return gap;
}

SHARED float self_motion(vec3 displacement) {
    precise float motion = sqrt(ordered_dot(displacement, displacement)) * 1.000001f;
    return motion;
}

#endif
