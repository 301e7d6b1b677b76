// Contact of a body (include/rigid_body.h) with planes: impulses at points of its surface in sequence, each of which
// never pulls and has Coulomb friction (Guendelman and others 2003; Catto 2005), before the body moves. A point above a
// plane may come as near as it is, so a body that falls ends its step on the plane.
#ifndef DRAPE_BODY_CONTACT_H
#define DRAPE_BODY_CONTACT_H

#include "include/collider_frame.h"
#include "include/rigid_body.h"
#include "shared/body_types.h"

#if COLLIDER_KINDS != 6
#error "body_point_count and body_point take the new kind for a box"
#endif

const int body_points = 8;   // of a body, at most, that may touch a plane
const int body_planes = 4;   // that a body touches at most
const int body_rounds = 16;  // over all of them

SHARED int body_point_count(int kind) {
    if (kind == kind_sphere || kind == kind_ellipsoid) return 1;
    return kind == kind_capsule ? 2 : body_points;
}

/// Returns a point of a body's surface in its shape's frame, that which is deepest in a plane with this normal, or one
/// of several among which it is.
SHARED vec3 body_point(BodyConstants body, int k, vec3 normal) {
    vec3 size = vec3(body.size.x, body.size.y, body.size.z);
    precise vec3 below = normal * -size.x;
    if (body.what.x == kind_sphere) return below;
    if (body.what.x == kind_ellipsoid) {
        precise vec3 scaled = normal * size;
        precise vec3 point = scaled * size / -sqrt(ordered_dot(scaled, scaled));
        return point;
    }
    if (body.what.x == kind_capsule) {
        precise vec3 on_ball = normal * -(k == 0 ? size.y : size.z);
        precise float height = on_ball.y + (k == 0 ? -size.x : size.x);
        return vec3(on_ball.x, height, on_ball.z);
    }
    return vec3((k & 1) == 0 ? -size.x : size.x, (k & 2) == 0 ? -size.y : size.y, (k & 4) == 0 ? -size.z : size.z);
}

/// A point of a body at a plane.
struct BodyTouch {
    vec3 arm;     // from the centre of mass, m
    vec3 normal;  // of the plane
    vec3 ground;  // the plane's velocity there, m/s
    float least;  // that the point may have along the normal, beyond the plane's, m/s
    float depth;  // m
};

SHARED BodyTouch body_touch(RigidBody body, BodyConstants constants, int k, ColliderRecord plane, float step) {
    vec3 normal = vec3(plane.shape.x, plane.shape.y, plane.shape.z);
    vec3 own = turned_by_quaternion(opposite_turn(body.turn), normal);
    precise vec3 local =
        body_point(constants, k, own) - vec3(constants.center.x, constants.center.y, constants.center.z);
    vec3 arm = turned_by_quaternion(body.turn, local);
    precise vec3 place = body.position + arm;
    vec3 carried = surface_displacement(plane, local_point(plane, place));
    precise vec3 above = place - vec3(plane.pose_x.w, plane.pose_y.w, plane.pose_z.w) + carried;
    precise float gap = ordered_dot(above, normal);
    precise vec3 ground = carried / step;
    precise float least = gap > 0.0f ? -gap / step : 0.0f;
    return BodyTouch(arm, normal, ground, least, gap < 0.0f ? -gap : 0.0f);
}

/// Returns the velocity of a body's point relative to the plane, m/s.
SHARED vec3 touch_velocity(RigidBody body, vec3 inverse_inertia, BodyTouch touch) {
    vec3 turning = ordered_cross(angular_velocity(body.turn, body.spin, inverse_inertia), touch.arm);
    precise vec3 velocity = body.velocity + turning - touch.ground;
    return velocity;
}

/// Returns the velocity that an impulse of 1 N s along a direction gives to a body's point along it, 1/kg.
SHARED float touch_yield(RigidBody body, BodyConstants constants, vec3 arm, vec3 direction) {
    vec3 inverse_inertia = vec3(constants.inverse.x, constants.inverse.y, constants.inverse.z);
    vec3 moment = ordered_cross(arm, direction);
    vec3 turning = ordered_cross(angular_velocity(body.turn, moment, inverse_inertia), arm);
    precise float yielding = constants.inverse.w + ordered_dot(turning, direction);
    return yielding;
}

/// Returns the mass with which a body's point resists along a direction, kg.
SHARED float touch_mass(RigidBody body, BodyConstants constants, vec3 arm, vec3 direction) {
    precise float mass = 1.0f / touch_yield(body, constants, arm, direction);
    return mass;
}

SHARED RigidBody pushed_body(RigidBody body, BodyConstants constants, vec3 arm, vec3 impulse) {
    return struck_body(body, constants.inverse.w, impulse, ordered_cross(arm, impulse));
}

/// Returns the impulse along the normal of a touch that has `before`, N s.
SHARED float normal_impulse(RigidBody body, BodyConstants constants, BodyTouch touch, float before) {
    vec3 velocity = touch_velocity(body, vec3(constants.inverse.x, constants.inverse.y, constants.inverse.z), touch);
    float mass = touch_mass(body, constants, touch.arm, touch.normal);
    precise float impulse = before + (touch.least - ordered_dot(velocity, touch.normal)) * mass;
    return impulse > 0.0f ? impulse : 0.0f;
}

/// Returns the impulse along the plane of a touch that has `before`, N s, at most `most`.
SHARED vec3 grip_impulse(RigidBody body, BodyConstants constants, BodyTouch touch, vec3 before, float most) {
    vec3 velocity = touch_velocity(body, vec3(constants.inverse.x, constants.inverse.y, constants.inverse.z), touch);
    precise vec3 along = velocity - touch.normal * ordered_dot(velocity, touch.normal);
    precise float speed = sqrt(ordered_dot(along, along));
    vec3 impulse = before;
    if (speed > 0.0f) {
        precise vec3 direction = along / speed;
        precise vec3 wanted = before - along * touch_mass(body, constants, touch.arm, direction);
        impulse = wanted;
    }
    precise float size = sqrt(ordered_dot(impulse, impulse));
    if (!(size > most)) return impulse;
    precise vec3 limited = impulse * (most / size);
    return limited;
}

/// Returns whether a body may come to a plane in a step.
SHARED bool near_plane(RigidBody body, BodyConstants constants, ColliderRecord plane, float step) {
    vec3 normal = vec3(plane.shape.x, plane.shape.y, plane.shape.z);
    vec3 carried = surface_displacement(plane, local_point(plane, body.position));
    precise vec3 above = body.position - vec3(plane.pose_x.w, plane.pose_y.w, plane.pose_z.w);
    precise float gap = ordered_dot(above, normal) - constants.size.w * 1.01f;
    precise float way = sqrt(ordered_dot(body.velocity, body.velocity)) * step;
    precise float motion = sqrt(ordered_dot(carried, carried));
    // A body that turns may strike with an end by whose speed others move: its step's turn is bounded by its size.
    precise float reach = way + motion + constants.size.w;
    return gap < reach;
}

/// Returns 1 for a body whose motion planes changed, else 0.
SHARED float touches_planes(RigidBody before, RigidBody after) {
    bool same = before.velocity.x == after.velocity.x && before.velocity.y == after.velocity.y &&
                before.velocity.z == after.velocity.z && before.spin.x == after.spin.x &&
                before.spin.y == after.spin.y && before.spin.z == after.spin.z;
    return same ? 0.0f : 1.0f;
}

/// Returns a direction of a body's shape in its own frame.
SHARED vec3 shape_axis(BodyConstants constants, vec3 axis) {
    if (constants.what.x != kind_mesh) return axis;
    return turned_by_quaternion(constants.axes, axis);
}

/// Returns a body's pose in its shape's frame, with the change from the pose `before`, in a record of the shape.
SHARED ColliderRecord placed_record(ColliderRecord record, BodyConstants constants, RigidBody before, RigidBody now) {
    vec3 center = vec3(constants.center.x, constants.center.y, constants.center.z);
    precise vec3 last = before.position - turned_by_quaternion(before.turn, center);
    precise vec3 middle = now.position - turned_by_quaternion(now.turn, center);
    vec3 own_x = shape_axis(constants, vec3(1.0f, 0.0f, 0.0f)), own_y = shape_axis(constants, vec3(0.0f, 1.0f, 0.0f));
    vec3 own_z = shape_axis(constants, vec3(0.0f, 0.0f, 1.0f));
    vec3 x = turned_by_quaternion(now.turn, own_x), y = turned_by_quaternion(now.turn, own_y);
    vec3 z = turned_by_quaternion(now.turn, own_z);
    precise vec3 change_x = x - turned_by_quaternion(before.turn, own_x);
    precise vec3 change_y = y - turned_by_quaternion(before.turn, own_y);
    precise vec3 change_z = z - turned_by_quaternion(before.turn, own_z);
    precise vec3 moved = middle - last;
    ColliderRecord placed = record;
    placed.pose_x = vec4(x.x, y.x, z.x, middle.x);
    placed.pose_y = vec4(x.y, y.y, z.y, middle.y);
    placed.pose_z = vec4(x.z, y.z, z.z, middle.z);
    placed.change_x = vec4(change_x.x, change_y.x, change_z.x, moved.x);
    placed.change_y = vec4(change_x.y, change_y.y, change_z.y, moved.y);
    placed.change_z = vec4(change_x.z, change_y.z, change_z.z, moved.z);
    precise float squared =
        ordered_dot(change_x, change_x) + ordered_dot(change_y, change_y) + ordered_dot(change_z, change_z);
    precise float turn = sqrt(squared * 0.5f);
    precise float motion = (sqrt(ordered_dot(moved, moved)) + turn * constants.size.w) * 1.0001f;
    // As on the host (cloth/frame_inputs.cpp): after so wide a turn a straight line is no good measure of a path.
    placed.way_out.w = turn < 0.2f ? motion : 1.0e15f;
    return placed;
}

#endif
