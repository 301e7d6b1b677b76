// Where two boxes meet: by the axis along which they are farthest apart (Gottschalk, Lin and Manocha 1996), a face's
// touch at the corners of what the two faces share, an edge's where the two edges are nearest. All of it in loops that
// compilers cannot unroll, because their number of rounds is given: unrolled, it took lavapipe many seconds to compile.
#ifndef DRAPE_BODY_BOXES_H
#define DRAPE_BODY_BOXES_H

#include "include/vector.h"

struct PlacedBox {
    vec3 middle;      // m
    vec3 x, y, z;     // its axes
    vec3 half_sides;  // m
};

/// What separates two boxes most.
struct BoxAxis {
    vec3 normal;  // unit, towards the first box
    float gap;    // m, negative where they overlap
    int first;    // number of the first box's axis, of its face or edge; -1: the face is the second's
    int second;   // number of the second's, -1: the face is the first's
};

SHARED float along_axis(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
SHARED vec3 box_axis(PlacedBox box, int axis) { return axis == 0 ? box.x : axis == 1 ? box.y : box.z; }
SHARED int next_axis(int axis) { return axis == 2 ? 0 : axis + 1; }

SHARED float half_width(PlacedBox box, vec3 along) {
    precise float sum = abs(ordered_dot(box.x, along)) * box.half_sides.x +
                        abs(ordered_dot(box.y, along)) * box.half_sides.y +
                        abs(ordered_dot(box.z, along)) * box.half_sides.z;
    return sum;
}

const int box_axis_count = 15;  // three faces of each, nine pairs of edges

/// Returns the axis of largest gap; a face's where an edge's is larger by no more than rounding and a little. `rounds`:
/// box_axis_count.
SHARED BoxAxis separating_axis(PlacedBox a, PlacedBox b, int rounds) {
    precise vec3 apart = a.middle - b.middle;
    BoxAxis best = BoxAxis(vec3(0.0f, 1.0f, 0.0f), -1.0e30f, 0, -1);
    float least = -1.0e30f;  // that an edge's gap must exceed
    for (int k = 0; k < rounds; ++k) {
        int pair = k - 6;
        int first = k < 3 ? k : k < 6 ? -1 : pair / 3;
        int second = k < 3 ? -1 : k < 6 ? k - 3 : pair - pair / 3 * 3;
        vec3 own = box_axis(a, first), others = box_axis(b, second), across = ordered_cross(own, others);
        float squared = k < 6 ? 1.0f : ordered_dot(across, across);
        precise vec3 axis = (k < 3 ? own : k < 6 ? others : across) / sqrt(squared);
        precise float way = ordered_dot(apart, axis);
        precise float widths = half_width(a, axis) + half_width(b, axis);
        precise float gap = abs(way) - widths;
        precise float little = gap + widths * 1.0e-4f;
        // Parallel edges meet where a face does.
        bool better = squared > 1.0e-6f && gap > best.gap && (k < 6 || gap > least);
        if (better && k < 6) least = little;
        if (better) best = BoxAxis(way < 0.0f ? -axis : axis, gap, first, second);
    }
    return best;
}

/// A face of one box as a face of another sees it: x and y along that, z above it, m.
struct FacingFace {
    vec3 middle, u, v;  // v and u: from the middle to the middles of two sides
    float wide, deep;   // half sides of the face that sees it
};

/// Returns the face of `other` that looks at a face of `box`. `normal`: outward, of the face across `axis`.
SHARED FacingFace facing_face(PlacedBox box, int axis, vec3 normal, PlacedBox other) {
    float of_x = ordered_dot(other.x, normal), of_y = ordered_dot(other.y, normal), of_z = ordered_dot(other.z, normal);
    int facing = abs(of_x) >= abs(of_y) && abs(of_x) >= abs(of_z) ? 0 : abs(of_y) >= abs(of_z) ? 1 : 2;
    int along = next_axis(facing), across = next_axis(along);
    float side = along_axis(vec3(of_x, of_y, of_z), facing) > 0.0f ? -1.0f : 1.0f;
    precise vec3 away =
        other.middle + box_axis(other, facing) * (side * along_axis(other.half_sides, facing)) - box.middle;
    precise vec3 u = box_axis(other, along) * along_axis(other.half_sides, along);
    precise vec3 v = box_axis(other, across) * along_axis(other.half_sides, across);
    int next = next_axis(axis), last = next_axis(next);
    vec3 x = box_axis(box, next), y = box_axis(box, last);
    precise float above = ordered_dot(away, normal) - along_axis(box.half_sides, axis);
    return FacingFace(vec3(ordered_dot(away, x), ordered_dot(away, y), above),
                      vec3(ordered_dot(u, x), ordered_dot(u, y), ordered_dot(u, normal)),
                      vec3(ordered_dot(v, x), ordered_dot(v, y), ordered_dot(v, normal)),
                      along_axis(box.half_sides, next), along_axis(box.half_sides, last));
}

/// A corner of what two faces share, in the frame of the one that sees the other, m.
struct FaceCorner {
    vec3 place;
    bool is_one;
};

const int face_corner_count = 24;  // four of each face, sixteen where a side of one may cross a side of the other
/// Corners count that are outside by this share of a half side, since rounding may take each of two that fall together
/// for outside; crossings within a quarter of it beside a corner then do not.
const float face_margin = 1.0e-4f;

/// Returns the number of the seen face's corner, which counts where it is over the seeing face.
SHARED FaceCorner seen_corner(FacingFace face, int k) {
    float s = k == 1 || k == 2 ? 1.0f : -1.0f, t = k >= 2 ? 1.0f : -1.0f;
    precise vec3 place = face.middle + face.u * s + face.v * t;
    precise float wide = face.wide * (1.0f + face_margin);
    precise float deep = face.deep * (1.0f + face_margin);
    return FaceCorner(place, abs(place.x) <= wide && abs(place.y) <= deep);
}

/// Returns a corner of the seeing face, which counts where it is under the seen face and that has no corner there.
SHARED FaceCorner seeing_corner(FacingFace face, int k) {
    float x = (k & 1) == 0 ? -face.wide : face.wide, y = (k & 2) == 0 ? -face.deep : face.deep;
    precise float from_x = x - face.middle.x;
    precise float from_y = y - face.middle.y;
    precise float area = face.u.x * face.v.y - face.u.y * face.v.x;
    precise float s = (from_x * face.v.y - from_y * face.v.x) / area;
    precise float t = (face.u.x * from_y - face.u.y * from_x) / area;
    precise vec3 place = face.middle + face.u * s + face.v * t;
    float most = 1.0f + face_margin, least = 1.0f - 0.5f * face_margin;
    bool at_corner = abs(s) >= least && abs(t) >= least;
    return FaceCorner(place, abs(s) <= most && abs(t) <= most && !at_corner);
}

/// Returns where a side of the seen face crosses one of the seeing face; k: 4 times the first's number and the other's.
SHARED FaceCorner side_crossing(FacingFace face, int k) {
    int seen = k / 4, seeing = k - seen * 4;
    bool along_u = seen < 2, on_x = seeing < 2;
    float half_sign = (seen & 1) == 0 ? -1.0f : 1.0f, sign = (seeing & 1) == 0 ? -1.0f : 1.0f;
    vec3 run = along_u ? face.u : face.v, aside = along_u ? face.v : face.u;
    precise vec3 start = face.middle + aside * half_sign;
    float limit = on_x ? face.wide : face.deep, other_limit = on_x ? face.deep : face.wide;
    float rate = on_x ? run.x : run.y;
    precise float margin = 0.25f * face_margin * limit;
    bool crosses = abs(rate) > margin;  // else its corners are on the side
    precise float share = (sign * limit - (on_x ? start.x : start.y)) / (crosses ? rate : 1.0f);
    precise vec3 place = start + run * share;
    precise float from_seen = (1.0f - abs(share)) * abs(rate);
    precise float from_seeing = other_limit - abs(on_x ? place.y : place.x);
    float of_u = abs(face.u.x) > abs(face.u.y) ? abs(face.u.x) : abs(face.u.y);
    float of_v = abs(face.v.x) > abs(face.v.y) ? abs(face.v.x) : abs(face.v.y);
    precise float least = 0.25f * face_margin * (of_u < of_v ? of_u : of_v);
    return FaceCorner(place, crosses && from_seen > margin && from_seeing > least);
}

SHARED FaceCorner face_corner(FacingFace face, int k) {
    FaceCorner found = side_crossing(face, k < 8 ? 0 : k - 8);
    if (k < 4)
        found = seen_corner(face, k);
    else if (k < 8)
        found = seeing_corner(face, k - 4);
    return found;
}

/// Returns the place halfway between a point beside a face of `box` and the face.
SHARED vec3 beside_face(PlacedBox box, int axis, vec3 normal, vec3 point) {
    int x = next_axis(axis), y = next_axis(x);
    precise vec3 place = box.middle + box_axis(box, x) * point.x + box_axis(box, y) * point.y +
                         normal * (point.z * 0.5f + along_axis(box.half_sides, axis));
    return place;
}

/// Returns a point of the edge along an axis that is farthest along a direction.
SHARED vec3 edge_point(PlacedBox box, int axis, vec3 along) {
    int x = next_axis(axis), y = next_axis(x);
    float sx = ordered_dot(box_axis(box, x), along) < 0.0f ? -1.0f : 1.0f;
    float sy = ordered_dot(box_axis(box, y), along) < 0.0f ? -1.0f : 1.0f;
    precise vec3 point = box.middle + box_axis(box, x) * (sx * along_axis(box.half_sides, x)) +
                         box_axis(box, y) * (sy * along_axis(box.half_sides, y));
    return point;
}

/// Returns the place halfway between two edges where they are nearest.
SHARED vec3 between_edges(PlacedBox a, PlacedBox b, BoxAxis axis) {
    vec3 along = box_axis(a, axis.first), across = box_axis(b, axis.second);
    vec3 own = edge_point(a, axis.first, -axis.normal), others = edge_point(b, axis.second, axis.normal);
    precise vec3 apart = own - others;
    float cosine = ordered_dot(along, across), c = ordered_dot(along, apart), f = ordered_dot(across, apart);
    precise float squared = 1.0f - cosine * cosine;
    precise float s = (cosine * f - c) / squared;
    precise float t = (f - cosine * c) / squared;
    precise vec3 place = (own + along * s + others + across * t) * 0.5f;
    return place;
}

#endif
