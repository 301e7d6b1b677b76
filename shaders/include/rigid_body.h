// A rigid body's motion: semi-implicit for its centre, by the implicit midpoint of the turn with the angular momentum
// kept as it is for its attitude, so that without moments that never changes by a bit.
#ifndef DRAPE_RIGID_BODY_H
#define DRAPE_RIGID_BODY_H

#include "include/vector.h"

struct RigidBody {
    vec3 position;   // m, of its centre of mass
    vec3 remainder;  // m, what rounding lost of that
    vec4 turn;       // unit quaternion, world from its principal axes; w: the real part
    vec3 velocity;   // m/s
    vec3 slower;     // m/s, what rounding lost of that
    vec3 spin;       // kg m^2/s: angular momentum about its centre of mass
};

/// Returns a vector turned by a unit quaternion.
SHARED vec3 turned_by_quaternion(vec4 turn, vec3 v) {
    vec3 axis = vec3(turn.x, turn.y, turn.z);
    vec3 across = ordered_cross(axis, v);
    precise vec3 inner = across + v * turn.w;
    vec3 outer = ordered_cross(axis, inner);
    precise vec3 turned = v + outer * 2.0f;
    return turned;
}

SHARED vec4 opposite_turn(vec4 turn) { return vec4(-turn.x, -turn.y, -turn.z, turn.w); }

/// Returns the angular velocity, 1/s. `inverse_inertia`: of the principal moments, 1/(kg m^2).
SHARED vec3 angular_velocity(vec4 turn, vec3 spin, vec3 inverse_inertia) {
    vec3 own = turned_by_quaternion(opposite_turn(turn), spin);
    precise vec3 rates = own * inverse_inertia;
    return turned_by_quaternion(turn, rates);
}

/// Returns a unit quaternion after a turn by a vector of half the angle's tangent.
SHARED vec4 turned_on(vec4 turn, vec3 half_way) {
    vec3 axis = vec3(turn.x, turn.y, turn.z);
    vec3 across = ordered_cross(half_way, axis);
    precise vec3 more = axis + (half_way * turn.w + across);
    precise float real = turn.w - ordered_dot(half_way, axis);
    precise float squared = ordered_dot(more, more) + real * real;
    precise float inverse = 1.0f / sqrt(squared);
    precise vec3 unit = more * inverse;
    precise float last = real * inverse;
    return vec4(unit.x, unit.y, unit.z, last);
}

const int rigid_midpoint_rounds = 3;  // of the midpoint's fixed point: each leaves a share h |w| of the error

/// Returns the time, s, from the middle of a substep to the middle of the next.
SHARED float fall_time(float last_step, float step) {
    precise float time = (last_step + step) * 0.5f;
    return time;
}

/// Returns the body with the velocity that gravity, m/s^2, gives it in a step, s.
SHARED RigidBody fallen_body(RigidBody body, vec3 gravity, float step) {
    RigidBody next = body;
    precise vec3 gain = gravity * step + body.slower;
    precise vec3 velocity = body.velocity + gain;
    precise vec3 slower = gain - (velocity - body.velocity);
    next.velocity = velocity;
    next.slower = slower;
    return next;
}

/// Returns the body where its velocity and its angular momentum take it in a step, s.
SHARED RigidBody moved_body(RigidBody body, vec3 inverse_inertia, float step) {
    RigidBody next = body;
    precise vec3 way = body.velocity * step + body.remainder;
    precise vec3 position = body.position + way;
    precise vec3 lost = way - (position - body.position);
    next.position = position;
    next.remainder = lost;
    if (body.spin.x == 0.0f && body.spin.y == 0.0f && body.spin.z == 0.0f) return next;
    vec4 middle = body.turn;
    for (int round = 0; round < rigid_midpoint_rounds; ++round) {
        vec3 rate = angular_velocity(middle, body.spin, inverse_inertia);
        precise vec3 quarter = rate * (step * 0.25f);
        middle = turned_on(body.turn, quarter);
    }
    vec3 rate = angular_velocity(middle, body.spin, inverse_inertia);
    precise vec3 half_way = rate * (step * 0.5f);
    next.turn = turned_on(body.turn, half_way);
    return next;
}

SHARED RigidBody advanced_body(RigidBody body, vec3 inverse_inertia, vec3 gravity, float step) {
    return moved_body(fallen_body(body, gravity, step), inverse_inertia, step);
}

/// Returns the body with an impulse, N s, and its moment about the centre of mass, N m s.
SHARED RigidBody struck_body(RigidBody body, float inverse_mass, vec3 impulse, vec3 moment) {
    RigidBody next = body;
    precise vec3 gain = impulse * inverse_mass + body.slower;
    precise vec3 velocity = body.velocity + gain;
    precise vec3 slower = gain - (velocity - body.velocity);
    precise vec3 spin = body.spin + moment;
    next.velocity = velocity;
    next.slower = slower;
    next.spin = spin;
    return next;
}

#endif
