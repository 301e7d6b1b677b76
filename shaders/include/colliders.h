// The signed distances to each kind of collider in its local frame, positive outside, each with the outward normal of
// the closest surface point; and contact with friction.
#ifndef DRAPE_COLLIDERS_H
#define DRAPE_COLLIDERS_H

#include "include/collider_frame.h"
#include "include/contact_law.h"
#include "include/vector.h"
#include "shared/collider_types.h"

#if COLLIDER_KINDS != 6
#error "These lack the new kind: *_end, shape_surface, least_half_width, beyond_reach, bounding_radius, way_in"
#endif

struct SurfacePoint {
    vec3 normal;     // unit, outward, local frame
    float distance;  // m, negative inside
};

// The fields of meshes (shared/collider_types.h). The shader of a scene without meshes needs none.
#ifdef __cplusplus
#define WITH_FIELDS , const vec4* fields
#define FIELDS , fields
#define FIELD_TEXEL(place) fields[place]
const bool has_meshes = true;
#else
#define WITH_FIELDS
#define FIELDS
// The list is sorted by kind, and these constants say where each kind ends, so that loops over kinds that a scene lacks
// are removed.
layout(constant_id = 0) const int planes_end = 0;
layout(constant_id = 1) const int spheres_end = 0;
layout(constant_id = 2) const int boxes_end = 0;
layout(constant_id = 3) const int ellipsoids_end = 0;
layout(constant_id = 4) const int capsules_end = 0;
layout(constant_id = 5) const int meshes_end = 0;
const bool has_meshes = capsules_end < meshes_end;
layout(set = 0, binding = 5, std430) readonly buffer Colliders { ColliderRecord colliders[]; };
layout(set = 0, binding = 15, rgba32f) uniform readonly imageBuffer mesh_fields;
#define FIELD_TEXEL(place) imageLoad(mesh_fields, place)
#endif

SHARED SurfacePoint sphere_surface(vec3 local, float radius) {
    precise float squared = ordered_dot(local, local);
    if (!(squared > 0.0f)) return SurfacePoint(vec3(0.0f, 1.0f, 0.0f), -radius);
    precise float from_center = sqrt(squared);
    precise vec3 normal = local / from_center;
    precise float distance = from_center - radius;
    return SurfacePoint(normal, distance);
}

/// From outside, the nearest surface point of the whole box is taken; from inside, the nearest face decides.
SHARED SurfacePoint box_surface(vec3 local, vec3 half_extents) {
    vec3 side = vec3(local.x < 0.0f ? -1.0f : 1.0f, local.y < 0.0f ? -1.0f : 1.0f, local.z < 0.0f ? -1.0f : 1.0f);
    precise vec3 beyond = local * side - half_extents;
    if (beyond.x > 0.0f || beyond.y > 0.0f || beyond.z > 0.0f) {
        precise vec3 outside = vec3(beyond.x > 0.0f ? beyond.x : 0.0f, beyond.y > 0.0f ? beyond.y : 0.0f,
                                    beyond.z > 0.0f ? beyond.z : 0.0f);
        precise float distance = sqrt(ordered_dot(outside, outside));
        if (distance > 0.0f) {  // otherwise it underflows: for a point on the surface, the nearest face decides
            precise vec3 normal = outside * side / distance;
            return SurfacePoint(normal, distance);
        }
    }
    if (beyond.x >= beyond.y && beyond.x >= beyond.z) return SurfacePoint(vec3(side.x, 0.0f, 0.0f), beyond.x);
    if (beyond.y >= beyond.z) return SurfacePoint(vec3(0.0f, side.y, 0.0f), beyond.y);
    return SurfacePoint(vec3(0.0f, 0.0f, side.z), beyond.z);
}

/// Returns the closest point on the ellipsoid sum (x_i/radii_i)^2 = 1 to `local` (Eberly, "Distance from a Point to an
/// Ellipse, an Ellipsoid, or a Hyperellipsoid"): foot_i = r_i y_i / (s + r_i) with r_i = (e_i/e_min)^2 at the largest
/// root of g(s) = sum (r_i z_i / (s + r_i))^2 - 1, z_i = y_i / e_i. g is convex and falling right of -1, so Newton from
/// a point where g >= 0 (one term alone reaches 1) rises monotonically to the root; it stops when it no longer rises.
/// The unknown here is u = s + 1, so that it keeps its digits next to the pole.
SHARED vec3 ellipsoid_foot(vec3 local, vec3 radii) {
    float smallest = radii.x < radii.y ? radii.x : radii.y;
    smallest = radii.z < smallest ? radii.z : smallest;
    // A coordinate of exactly zero along the smallest axis has no start value, so it is shifted by less than rounding.
    precise float tiny = 1.0e-7f * smallest;
    vec3 magnitude = vec3(abs(local.x), abs(local.y), abs(local.z));
    magnitude = vec3(magnitude.x < tiny ? tiny : magnitude.x, magnitude.y < tiny ? tiny : magnitude.y,
                     magnitude.z < tiny ? tiny : magnitude.z);
    vec3 one = vec3(1.0f, 1.0f, 1.0f);
    precise vec3 relative = radii / smallest;
    precise vec3 ratio = relative * relative;
    precise vec3 beyond_one = ratio - one;
    precise vec3 scaled = magnitude / radii;
    precise vec3 weighted = ratio * scaled;
    precise vec3 starts = weighted - beyond_one;  // where each term alone is 1
    float u = starts.x > starts.y ? starts.x : starts.y;
    u = starts.z > u ? starts.z : u;
    // Compilers do not know that this is bounded; lavapipe would unroll 24 rounds and run all of them for every
    // particle.
    int most = smallest > 0.0f ? 24 : 0;
    for (int step = 0; step < most; ++step) {
        precise vec3 shifted = beyond_one + vec3(u, u, u);
        precise vec3 terms = weighted / shifted;
        precise float value = ordered_dot(terms, terms) - 1.0f;
        precise vec3 slopes = terms * terms / shifted;
        precise float slope = 2.0f * (slopes.x + slopes.y + slopes.z);
        precise float next = u + value / slope;
        if (!(next > u)) break;
        u = next;
    }
    precise vec3 foot = ratio * magnitude / (beyond_one + vec3(u, u, u));
    return vec3(local.x < 0.0f ? -foot.x : foot.x, local.y < 0.0f ? -foot.y : foot.y,
                local.z < 0.0f ? -foot.z : foot.z);
}

/// The normal is the gradient of the surface at the foot point, which is accurate however close the point is.
SHARED SurfacePoint ellipsoid_surface(vec3 local, vec3 radii) {
    vec3 foot = ellipsoid_foot(local, radii);
    precise vec3 gradient = foot / (radii * radii);
    precise vec3 normal = gradient / sqrt(ordered_dot(gradient, gradient));
    precise float distance = ordered_dot(local - foot, normal);
    return SurfacePoint(normal, distance);
}

/// Returns whether the point is farther than `reach` from the ellipsoid's bounding box, so that no root is needed.
SHARED bool beyond_bounds(vec3 local, vec3 radii, float reach) {
    precise vec3 bound = radii + vec3(reach, reach, reach);
    return abs(local.x) > bound.x || abs(local.y) > bound.y || abs(local.z) > bound.z;
}

/// Returns the surface of a capsule along y; `size`: half the distance of its ends' centres, the radius at the lower
/// end, at the upper (m). Its side is the cone that touches both balls, along circles; there its normal leans out of
/// the horizontal by an angle whose sine is the radii's difference over the centres' distance, and beyond the circles
/// the surface is the ball's.
SHARED SurfacePoint capsule_surface(vec3 local, vec3 size) {
    precise float apart = size.x + size.x;
    precise float narrowing = size.y - size.z;
    bool has_side = abs(narrowing) < apart;  // otherwise one ball contains the other
    bool upper = narrowing < 0.0f;           // which ball may be the nearest; without a side, the larger one
    precise float above = local.y + size.x;  // height above the lower end's centre
    if (has_side) {
        precise float sine = narrowing / apart;
        precise float cosine = sqrt((1.0f - sine) * (1.0f + sine));
        precise float from_axis = sqrt(local.x * local.x + local.z * local.z);
        precise float along = above * cosine - from_axis * sine;  // position along the side, from the lower circle
        precise float side = apart * cosine;
        if (along > 0.0f && along < side && from_axis > 0.0f) {
            precise vec3 normal = vec3(local.x / from_axis * cosine, sine, local.z / from_axis * cosine);
            precise float distance = from_axis * cosine + above * sine - size.y;
            return SurfacePoint(normal, distance);
        }
        if (along > 0.0f && along < side) {  // on the axis all directions are equally near
            precise float distance = above * sine - size.y;
            return SurfacePoint(vec3(cosine, sine, 0.0f), distance);
        }
        upper = along > 0.0f;
    }
    precise float below_upper = local.y - size.x;
    return sphere_surface(vec3(local.x, upper ? below_upper : above, local.z), upper ? size.z : size.y);
}

#include "include/mesh_field.h"

struct Contact {
    vec3 displacement;
    float depth;  // m; 0 when there was no contact
    vec3 normal;  // of the surface, in the world frame
    vec4 grip;    // as in Support
    vec3 led;     // the part of the displacement that leads the particle out of an overlap, which is no velocity, m
    vec3 lost;    // what rounding lost of the displacement, m
};

SHARED vec3 moved_position(vec3 start, vec3 displacement) {
    precise vec3 now = start + displacement;
    return now;
}

SHARED vec3 led_sum(vec3 a, vec3 b) {
    precise vec3 sum = a + b;
    return sum;
}

/// Returns the displacement that is a particle's velocity, if its start is shifted by the displacement that leads it.
SHARED vec3 displacement_of_own(vec3 displacement, vec3 led) {
    precise vec3 own = displacement - led;
    return own;
}

/// Returns the signed distance and normal of a shape other than the plane, in the shape's own frame.
SHARED SurfacePoint shape_surface(int kind, vec3 local, vec3 size) {
    if (kind == kind_sphere) return sphere_surface(local, size.x);
    if (kind == kind_box) return box_surface(local, size);
    if (kind == kind_capsule) return capsule_surface(local, size);
    return ellipsoid_surface(local, size);
}

SHARED SurfacePoint plane_surface(ColliderRecord collider, vec3 world) {
    vec3 normal = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
    precise vec3 from_foot = world - vec3(collider.pose_x.w, collider.pose_y.w, collider.pose_z.w);
    return SurfacePoint(normal, ordered_dot(from_foot, normal));
}

/// Returns the signed distance and normal of the collider's surface point nearest to a particle at `world`, which is
/// `local` in the collider's frame. The normal of a plane is in the world frame, others are in the local one.
SHARED SurfacePoint collider_surface(int kind, ColliderRecord collider, vec3 world, vec3 local WITH_FIELDS) {
    vec3 size = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
    if (has_meshes)
        if (kind == kind_mesh) return mesh_surface(collider, local, 1.0f FIELDS);
    if (kind != kind_plane) return shape_surface(kind, local, size);
    return plane_surface(collider, world);
}

/// Returns whether cloth started in a box, which it then leaves through one face.
SHARED bool has_way_out(ColliderRecord collider) {
    return collider.way_out.x != 0.0f || collider.way_out.y != 0.0f || collider.way_out.z != 0.0f;
}

/// Returns the face through which cloth leaves a box in which it started, for a point at `local`.
SHARED SurfacePoint way_out_surface(ColliderRecord collider, vec3 local) {
    vec3 normal = vec3(collider.way_out.x, collider.way_out.y, collider.way_out.z);
    vec3 half_extents = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
    vec3 magnitude = vec3(abs(normal.x), abs(normal.y), abs(normal.z));
    precise float distance = ordered_dot(local, normal) - ordered_dot(half_extents, magnitude);
    return SurfacePoint(normal, distance);
}

/// Returns the distance from a shape's surface to its middle, m. A plane has no middle, and a mesh may be arbitrarily
/// thin.
SHARED float least_half_width(int kind, vec3 size) {
    if (has_meshes)
        if (kind == kind_mesh) return 0.0f;
    float ends = size.y < size.z ? size.y : size.z;
    float least = size.x < ends ? size.x : ends;
    return kind == kind_sphere ? size.x : kind == kind_capsule ? ends : least;
}

/// Returns how far a particle may move relative to a collider that it meets, m; `length`: by its displacement;
/// `motion`: by the surface, for which the host passes 1e15 where it turns by more than a fifth of a radian.
SHARED float most_way(float length, float motion) {
    precise float way = (length + motion) * 1.25f;
    return way;
}

/// Returns whether a particle moves so far that its end does not show from which side it came. A plane has only one
/// side.
SHARED bool goes_far(int kind, vec3 size, float length, float motion, float thickness) {
    precise float middle = least_half_width(kind, size) + thickness;
    return kind != kind_plane && most_way(length, motion) > middle;
}

/// Returns how near to a collider a particle that meets it may end, m.
SHARED float way_reach(int kind, vec3 size, float length, float motion, float thickness) {
    precise float behind = (most_way(length, motion) + thickness) * 2.0f;
    return goes_far(kind, size, length, motion, thickness) ? behind : thickness;
}

SHARED float length_of(vec3 v) {
    precise float length = sqrt(ordered_dot(v, v));
    return length;
}

SHARED vec3 size_of(ColliderRecord collider) { return vec3(collider.shape.x, collider.shape.y, collider.shape.z); }

/// Returns whether bounds show, with a margin for all rounding, that a collider is too far away to move a point by
/// contact.
SHARED bool beyond_reach(int kind, ColliderRecord collider, vec3 now, float thickness) {
    vec3 local = local_point(collider, now);
    vec3 size = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
    if (kind == kind_plane) {
        precise float inside = thickness - plane_surface(collider, now).distance;
        return !(inside > 0.0f);
    }
    if (kind == kind_sphere) {
        precise float reach = (size.x + thickness) * 1.0001f;
        precise float squared = reach * reach;
        return ordered_dot(local, local) > squared;
    }
    float widest = size.y > size.z ? size.y : size.z;
    precise float half_length = size.x + widest;
    precise vec3 bound = (kind == kind_capsule ? vec3(widest, half_length, widest) : size) * 1.0001f;
    precise float reach = (kind == kind_mesh ? thickness + collider.way_out.y : thickness) * 1.0001f;
    return beyond_bounds(local, bound, reach);
}

/// Returns the radius of a ball about a collider's centre that contains all of it, m; for a plane it contains
/// everything.
SHARED float bounding_radius(int kind, vec3 size) {
    float widest = size.y > size.z ? size.y : size.z;
    precise float half_length = size.x + widest;
    precise float corner = sqrt(ordered_dot(size, size));
    return kind == kind_plane ? 1.0e15f : kind == kind_sphere ? size.x : kind == kind_capsule ? half_length : corner;
}

SHARED vec3 least_of_each(vec3 a, vec3 b) {
    return vec3(b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z);
}

SHARED vec3 largest_of_each(vec3 a, vec3 b) {
    return vec3(b.x > a.x ? b.x : a.x, b.y > a.y ? b.y : a.y, b.z > a.z ? b.z : a.z);
}

/// Returns how far a number is beyond the nearer end of an interval, 0 within it.
SHARED float beyond_interval(float x, float lower, float upper) {
    precise float below = lower - x;
    precise float above = x - upper;
    float most = below > above ? below : above;
    return most > 0.0f ? most : 0.0f;
}

/// Returns whether a box between two corners may be nearer than `thickness` to a ball (w: radius), with all rounding.
SHARED bool near_ball(vec4 ball, vec3 lower, vec3 upper, float thickness) {
    vec3 off = vec3(beyond_interval(ball.x, lower.x, upper.x), beyond_interval(ball.y, lower.y, upper.y),
                    beyond_interval(ball.z, lower.z, upper.z));
    precise float reach = (ball.w + thickness) * 1.001f;
    precise float squared = reach * reach;
    return !(ordered_dot(off, off) > squared);
}

/// Returns a row of the pose when the substep began, from the row now and its change.
SHARED vec4 row_before(vec4 row, vec4 change) {
    precise vec4 before = vec4(row.x - change.x, row.y - change.y, row.z - change.z, row.w - change.w);
    return before;
}

/// Returns the collider as it was when the substep began.
SHARED ColliderRecord at_start(ColliderRecord collider) {
    collider.pose_x = row_before(collider.pose_x, collider.change_x);
    collider.pose_y = row_before(collider.pose_y, collider.change_y);
    collider.pose_z = row_before(collider.pose_z, collider.change_z);
    return collider;
}

/// Returns where a point was in the collider's frame when the substep began.
SHARED vec3 local_at_start(ColliderRecord collider, vec3 start) { return local_point(at_start(collider), start); }

/// Returns whether a collider is a mesh that deforms, as its field says.
SHARED bool is_deforming(int kind, ColliderRecord collider WITH_FIELDS) {
    if (has_meshes)
        if (kind == kind_mesh) return FIELD_TEXEL(int(collider.way_out.x) + 1).w > 0.0f;
    return false;
}

/// Returns how far the surface of a mesh that deforms moved near `local` during the substep, in addition to the motion
/// of its pose, world frame, m.
SHARED vec3 deformation(ColliderRecord collider, vec3 local WITH_FIELDS) {
    if (!has_meshes) return vec3(0.0f, 0.0f, 0.0f);
    int head = int(collider.way_out.x);
    vec3 in_frame = deformed_by(head + field_head, field_place(head, local FIELDS) FIELDS);
    precise vec3 moved = in_frame * FIELD_TEXEL(head + 1).w;
    return world_direction(at_start(collider), moved);
}

/// How a particle enters a shape.
struct WayIn {
    float before;     // m: how deep it was where it started, negative outside
    vec3 at;          // where it starts or, if it goes far, enters; local frame
    SurfacePoint by;  // the surface point nearest to `at`
    bool comes_in;
    float share;  // of the substep that is over at that time
};

/// Returns the surface that a particle meets on its way; a mesh that deforms is taken after this share of the substep.
SHARED SurfacePoint surface_on_way(int kind, ColliderRecord collider, vec3 world, vec3 local, float share WITH_FIELDS) {
    if (has_meshes)
        if (kind == kind_mesh) return mesh_surface(collider, local, share FIELDS);
    return collider_surface(kind, collider, world, local FIELDS);
}

/// Follows a particle from `from` along `way` if it goes far. For a shape without dents the distance is convex along a
/// line, so Newton's iteration approaches the surface from outside, or shows that the line misses it. In a mesh's dents
/// each round advances by the distance within which there is no surface (sphere tracing; Hart, "Sphere Tracing"), to a
/// hundredth of the thickness. Towards a mesh that deforms (`deforms`) it advances as if all of the surface approached
/// with the speed of its fastest part.
SHARED WayIn way_in(int kind, ColliderRecord collider, vec3 world, vec3 from, vec3 way, float thickness, bool far,
                    bool deforms WITH_FIELDS) {
    precise float enough = kind == kind_mesh ? thickness * -0.01f : 0.0f;
    WayIn found = WayIn(0.0f, from, SurfacePoint(from, 0.0f), far, 0.0f);
    precise float closing = length_of(way) + (deforms ? collider.way_out.w : 0.0f);
    float share = 0.0f;
    int round = 0;
    bool goes_on = far;
    do {
        found.by = surface_on_way(kind, collider, world, found.at, deforms ? share : 1.0f FIELDS);
        precise float inside = thickness - found.by.distance;
        found.before = round == 0 ? inside : found.before;
        float slope = kind == kind_mesh ? -closing : ordered_dot(found.by.normal, way);
        precise float next = share + inside / slope;
        bool outside = far && inside < enough;
        if (outside && !(slope < 0.0f && next <= 1.0f)) found.comes_in = false;
        goes_on = outside && found.comes_in && next > share && round < 24;
        if (kind == kind_mesh && outside && !goes_on) found.comes_in = false;
        share = goes_on ? next : share;
        precise vec3 there = from + way * share;
        if (goes_on) found.at = there;
        ++round;
    } while (goes_on);
    found.share = share;
    return found;
}

/// Returns the contact of a particle that started the substep at `start` with a collider; `depth` is how far the
/// particle is pushed. Shaders call it with a literal kind, so that each loop contains the code of one shape alone.
/// With `all_its_way`, a particle that goes far is stopped by the plane through which it enters; otherwise only its end
/// counts.
SHARED Contact collider_contact(int kind, ColliderRecord collider, vec3 start, vec3 displacement, float thickness,
                                float friction, float recovery, bool all_its_way WITH_FIELDS) {
    vec3 now = moved_position(start, displacement);
    vec3 local = local_point(collider, now);
    float length = length_of(displacement), motion = collider.way_out.w;
    bool far = all_its_way && goes_far(kind, size_of(collider), length, motion, thickness);
    float reach = far ? way_reach(kind, size_of(collider), length, motion, thickness) : thickness;
    vec3 nothing = vec3(0.0f, 0.0f, 0.0f);
    Contact none = Contact(displacement, 0.0f, nothing, vec4(0.0f, 0.0f, 0.0f, 0.0f), nothing, nothing);
    if (kind == kind_ellipsoid && beyond_bounds(local, size_of(collider), reach)) return none;
    if (kind == kind_mesh && !far && beyond_reach(kind, collider, now, thickness)) return none;
    SurfacePoint found = collider_surface(kind, collider, now, local FIELDS);
    precise float inside = thickness - found.distance;
    if (!(inside > 0.0f) && !far) return none;
    // The overlap at the substep's start is measured where the collider has since carried the particle's place; for a
    // mesh that deforms, with the form that it had then.
    bool deforms = is_deforming(kind, collider FIELDS);
    vec3 local_before = local_at_start(collider, start);
    vec3 surface = surface_displacement(collider, local_before);
    vec3 carried = moved_position(start, surface);
    precise vec3 way = local - local_before;
    WayIn in_by = way_in(kind, collider, carried, local_before, way, thickness, far, deforms FIELDS);
    if (!(inside > 0.0f) && !in_by.comes_in) return none;
    if (in_by.comes_in) {
        precise float beyond = in_by.by.distance + ordered_dot(in_by.by.normal, local - in_by.at);
        found = SurfacePoint(in_by.by.normal, beyond);
    }
    float before = in_by.before;
    vec3 normal_before = in_by.by.normal;
    if (kind == kind_box && before > recovery && has_way_out(collider)) {
        found = way_out_surface(collider, local);
        precise float by_one_face = thickness - way_out_surface(collider, local_before).distance;
        before = by_one_face;
        normal_before = found.normal;
    }
    vec3 out_of = kind == kind_plane ? found.normal : world_direction(collider, found.normal);
    if (deforms) {
        vec3 deformed = deformation(collider, in_by.comes_in ? in_by.at : local FIELDS);
        precise vec3 with_it = surface + deformed;
        surface = with_it;
        // The plane through which the particle entered has since moved on with the surface.
        precise float gone_on = found.distance - (1.0f - in_by.share) * ordered_dot(out_of, deformed);
        if (in_by.comes_in) found = SurfacePoint(found.normal, gone_on);
    }
    // The motion is taken along the mean of the normals at both of its ends.
    precise vec3 mean = (normal_before + found.normal) * 0.5f;
    vec3 along = kind == kind_plane ? mean : world_direction(collider, mean);
    precise vec3 relative = displacement - surface;
    precise float shown = thickness - found.distance - before;
    Depth deep =
        contact_depth(before, -ordered_dot(relative, along), shown, recovery, rounding_at(start, local), deforms);
    precise float depth = deep.pressed + deep.led;
    precise float least = largest_coordinate(relative) * 2.4e-7f;  // what rounding left of a motion taken away before
    if (!(depth > least)) return none;
    precise float pair_friction = friction * collider.shape.w;
    precise vec3 led = out_of * deep.led;
    CompensatedSum held = contact_displacement(displacement, surface, out_of, deep.pressed, pair_friction);
    vec4 grip = vec4(surface.x, surface.y, surface.z, pair_friction);
    return Contact(led_sum(held.value, led), depth, out_of, grip, led, held.remainder);
}

#endif
