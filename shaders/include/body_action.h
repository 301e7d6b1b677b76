// What actions do to a body (shared/body_types.h) before gravity moves it.
#ifndef DRAPE_BODY_ACTION_H
#define DRAPE_BODY_ACTION_H

#include "include/rigid_body.h"
#include "shared/body_types.h"

/// Returns the angular momentum of a body that turns with an angular velocity, 1/s.
SHARED vec3 spin_of(vec4 turn, vec3 rate, vec3 inverse_inertia) {
    vec3 own = turned_by_quaternion(opposite_turn(turn), rate);
    precise vec3 spin = own / inverse_inertia;
    return turned_by_quaternion(turn, spin);
}

/// Returns a body at the start of a substep, s, with what an action does to it. `begins`: the frame does, too. A
/// velocity that is given is that of this moment: the state's lies half of the last substep before it, by gravity,
/// m/s^2.
SHARED RigidBody acted_body(RigidBody body, BodyConstants constants, BodyAction action, bool begins, vec3 gravity,
                            float last_step, float step) {
    RigidBody next = body;
    vec3 inverse_inertia = vec3(constants.inverse.x, constants.inverse.y, constants.inverse.z);
    if (begins && action.force.w > 0.0f) {
        precise vec3 velocity =
            vec3(action.velocity.x, action.velocity.y, action.velocity.z) - gravity * (last_step * 0.5f);
        next.velocity = velocity;
        next.slower = vec3(0.0f, 0.0f, 0.0f);
        next.spin = spin_of(body.turn, vec3(action.turning.x, action.turning.y, action.turning.z), inverse_inertia);
    }
    if (begins)
        next = struck_body(next, constants.inverse.w, vec3(action.impulse.x, action.impulse.y, action.impulse.z),
                           vec3(action.twist.x, action.twist.y, action.twist.z));
    precise vec3 push = vec3(action.force.x, action.force.y, action.force.z) * step;
    precise vec3 twist = vec3(action.moment.x, action.moment.y, action.moment.z) * step;
    return struck_body(next, constants.inverse.w, push, twist);
}

#endif
