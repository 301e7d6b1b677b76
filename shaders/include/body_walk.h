// The points of one body's surface that may touch another's, one a round: a ball's middle, a capsule's ends and the
// ball between them that is nearest, a box's corners, a mesh's hull points.
#ifndef DRAPE_BODY_WALK_H
#define DRAPE_BODY_WALK_H

#include "include/colliders.h"
#include "shared/body_types.h"
#include "shared/collider_types.h"

#if COLLIDER_KINDS != 6
#error "point_rounds and the includer's point_of take the new kind for an ellipsoid"
#endif

SHARED vec3 vector_of(vec4 v) { return vec3(v.x, v.y, v.z); }
SHARED vec4 with_w(vec3 v, float w) { return vec4(v.x, v.y, v.z, w); }

/// Returns the product of a symmetric tensor, whose entries are xx, xy, xz, yy and yz, zz, with a vector.
SHARED vec3 tensor_product(vec4 t, vec4 last, vec3 v) {
    precise vec3 product = vec3(t.x * v.x + t.y * v.y + t.z * v.z, t.y * v.x + t.w * v.y + last.x * v.z,
                                t.z * v.x + last.x * v.y + last.y * v.z);
    return product;
}

/// A body's shape, or an obstacle's, where it is when the substep begins.
struct MetShape {
    int kind;
    ivec2 hull;    // of a mesh: its first hull point, and their number
    vec3 size;     // as in BodyConstants
    vec3 x, y, z;  // rows of world from local
    vec3 middle;   // m
    vec4 field;    // of a mesh, as ColliderRecord.way_out
};

SHARED vec3 direction_in_world(MetShape shape, vec3 local) {
    return vec3(ordered_dot(shape.x, local), ordered_dot(shape.y, local), ordered_dot(shape.z, local));
}
SHARED vec3 place_in_world(MetShape shape, vec3 local) {
    precise vec3 place = direction_in_world(shape, local) + shape.middle;
    return place;
}
SHARED vec3 direction_in_shape(MetShape shape, vec3 world) {
    precise vec3 local = shape.x * world.x + shape.y * world.y + shape.z * world.z;
    return local;
}
SHARED vec3 place_in_shape(MetShape shape, vec3 world) {
    precise vec3 from_middle = world - shape.middle;
    return direction_in_shape(shape, from_middle);
}

const int halvings = 24;  // of the part of a capsule's length in which its nearest ball is
const int spread_count = 6;

/// Returns how many points of a shape are tried against a surface: balls with every surface, points of a capsule, a
/// box and a hull with all but a ball's, where the ball is tried, boxes only with planes and meshes, and ellipsoids
/// only with planes.
SHARED int point_rounds(MetShape points, int surface) {
    if (points.kind == kind_sphere) return 1;
    if (points.kind == kind_plane || surface == kind_sphere) return 0;
    if (points.kind == kind_capsule)
        return surface == kind_plane || !(points.size.x > 0.0f) ? 2 : surface == kind_box ? halvings + 5 : halvings + 3;
    if (points.kind == kind_mesh) return points.hull.y > 0 ? 2 * points.hull.y + spread_count + 1 : 0;
    if (points.kind == kind_box) return surface == kind_plane || surface == kind_mesh ? 8 : 0;
    return surface == kind_plane ? 1 : 0;
}

/// What is known of a capsule after its rounds so far: the part of its length in which the nearest ball is, and the
/// part that lies over a box's face, shares of its length; nothing lies over it where the first is not below the last.
struct CapsuleWalk {
    float from, to;
    vec2 over;
};

SHARED float capsule_share(CapsuleWalk walk, int round) {
    precise float middle = (walk.from + walk.to) * 0.5f;
    if (round < 2) return round == 0 ? 0.0f : 1.0f;
    return round < halvings + 3 ? middle : round == halvings + 3 ? walk.over.x : walk.over.y;
}

/// Returns the middle and, in w, the radius of a ball at a share of a capsule's length, in its frame.
SHARED vec4 capsule_ball(vec3 size, float share) {
    precise float height = size.x * (share * 2.0f - 1.0f);
    precise float radius = size.y + (size.z - size.y) * share;
    return vec4(0.0f, height, 0.0f, radius);
}

/// Returns the walk after a round that found a surface's normal in the world. The distance is convex along a capsule
/// beside what is convex, and where it is least its slope changes sign.
SHARED CapsuleWalk capsule_halved(CapsuleWalk walk, MetShape capsule, float middle, vec3 normal) {
    precise float widens = (capsule.size.z - capsule.size.y) / (capsule.size.x * 2.0f);
    vec3 axis = vec3(capsule.x.y, capsule.y.y, capsule.z.y);
    bool falls = ordered_dot(normal, axis) < widens;
    if (falls)
        walk.from = middle;
    else
        walk.to = middle;
    return walk;
}

/// Returns the part of a way of a point, in shares of it, that is within two opposite sides of a box.
SHARED vec2 shares_between(float start, float end, float half_side, vec2 before) {
    precise float way = end - start;
    precise float least = 1.0e-6f * half_side;
    if (!(abs(way) > least)) return before;
    precise float enters = (-half_side - start) / way;
    precise float leaves = (half_side - start) / way;
    float lower = enters < leaves ? enters : leaves, upper = enters < leaves ? leaves : enters;
    return vec2(lower > before.x ? lower : before.x, upper < before.y ? upper : before.y);
}

/// Returns the part of a capsule's length that lies over the face of a box whose normal, in its frame, its nearest
/// ball has; nothing where that is no face's.
SHARED vec2 shares_over_face(MetShape capsule, MetShape box, vec3 normal) {
    vec3 start = place_in_shape(box, place_in_world(capsule, vec3(0.0f, -capsule.size.x, 0.0f)));
    vec3 end = place_in_shape(box, place_in_world(capsule, vec3(0.0f, capsule.size.x, 0.0f)));
    bool x = abs(normal.x) > 0.999f, y = abs(normal.y) > 0.999f, z = abs(normal.z) > 0.999f;
    if (!(x || y || z)) return vec2(1.0f, 0.0f);
    vec2 over = vec2(0.0f, 1.0f);
    if (!x) over = shares_between(start.x, end.x, box.size.x, over);
    if (!y) over = shares_between(start.y, end.y, box.size.y, over);
    if (!z) over = shares_between(start.z, end.z, box.size.z, over);
    return over;
}

/// Returns whether a round's ball may touch: an end, the nearest one between them, and over a box's face, where the
/// capsule comes over it and leaves it.
SHARED bool capsule_touches(CapsuleWalk walk, int round, float share) {
    if (round < 2) return true;
    if (round < halvings + 2) return false;
    if (round == halvings + 2) return share > 1.0e-4f && share < 0.9999f;
    bool over = walk.over.x < walk.over.y;
    return over && (round == halvings + 3 ? walk.over.x > 0.0f : walk.over.y < 1.0f);
}

/// What is known of hull points after their rounds so far: the deepest, and among those hardly higher the farthest six
/// ways.
struct HullWalk {
    int deepest;
    float least;         // m: its gap
    vec3 place, normal;  // its own, and that of the surface, in the world
    int farthest[spread_count];
    float ways[spread_count];  // m
};

/// Returns a direction along a surface, of six that are no multiples of a right angle apart from a mesh's edges.
SHARED vec3 spread_direction(vec3 normal, int k) {
    vec3 axis = abs(normal.x) < 0.6f ? vec3(0.8f, 0.36f, 0.48f) : vec3(0.36f, 0.8f, 0.48f);
    vec3 x = ordered_cross(normal, axis), y = ordered_cross(normal, x);
    int turn = k < 3 ? k : k - 3;
    float cosine = turn == 0 ? 1.0f : turn == 1 ? 0.5f : -0.5f, sine = turn == 0 ? 0.0f : 0.8660254f;
    precise vec3 along = (x * cosine + y * sine) * (k < 3 ? 1.0f : -1.0f);
    return along;
}

SHARED HullWalk hull_walk() {
    HullWalk walk;
    walk.deepest = 0;
    walk.least = 1.0e30f;
    walk.place = vec3(0.0f, 0.0f, 0.0f);
    walk.normal = walk.place;
    for (int way = 0; way < spread_count; ++way) {
        walk.farthest[way] = -1;
        walk.ways[way] = 0.0f;
    }
    return walk;
}

/// Returns the walk after a point of the first `count` rounds, which find the deepest, or of the next, which find the
/// farthest among those less than `slack` higher.
SHARED HullWalk hull_walked(HullWalk walk, int round, int count, vec3 place, vec3 normal, float gap, float slack) {
    if (round < count && gap < walk.least) {
        walk.deepest = round;
        walk.least = gap;
        walk.place = place;
        walk.normal = normal;
    }
    precise float most = walk.least + slack;
    if (round < count || !(gap < most)) return walk;
    precise vec3 off = place - walk.place;
    for (int way = 0; way < spread_count; ++way) {
        float along = ordered_dot(off, spread_direction(walk.normal, way));
        if (along > walk.ways[way]) {
            walk.farthest[way] = round - count;
            walk.ways[way] = along;
        }
    }
    return walk;
}

/// Returns the number of the point of a round, or -1: in the last rounds, of the deepest and of those of the farthest
/// that are not yet taken.
SHARED int hull_point_number(HullWalk walk, int round, int count) {
    if (round < 2 * count) return round < count ? round : round - count;
    int own = round - 2 * count - 1, chosen = walk.deepest;
    bool taken = false;
    for (int way = 0; way < spread_count; ++way)
        if (way == own) chosen = walk.farthest[way];
    for (int way = 0; way < spread_count; ++way) taken = taken || (way < own && walk.farthest[way] == chosen);
    bool again = own >= 0 && (taken || chosen == walk.deepest);
    return again ? -1 : chosen;
}

#endif
