// What a cloth gives to a body.
#ifndef DRAPE_BODY_STRIKE_H
#define DRAPE_BODY_STRIKE_H

#include "include/rigid_body.h"
#include "shared/body_types.h"

/// What a cloth gives to a body, or what it still owes: an impulse, N s, and its moment about the centre of mass, N m
/// s.
struct BodyStrike {
    vec3 impulse, moment;
};

/// Returns the opposite of what a body gave to a cloth, an impulse and its moment about the shape's centre, in units.
SHARED BodyStrike strike_of(RigidBody body, BodyConstants constants, vec3 given, vec3 moment, float unit) {
    precise vec3 impulse = given * -unit;
    vec3 from_center =
        turned_by_quaternion(body.turn, vec3(constants.center.x, constants.center.y, constants.center.z));
    precise vec3 own_moment = moment * -unit - ordered_cross(from_center, impulse);
    return BodyStrike(impulse, own_moment);
}

/// Returns whether what cloth gives to a body is first owed to it.
SHARED bool is_light(BodyConstants constants) { return constants.cover.x > 0.0f; }

SHARED BodyStrike strikes_sum(BodyStrike a, BodyStrike b) {
    precise vec3 impulse = a.impulse + b.impulse;
    precise vec3 moment = a.moment + b.moment;
    return BodyStrike(impulse, moment);
}

SHARED bool is_strike(BodyStrike strike) {
    return strike.impulse.x != 0.0f || strike.impulse.y != 0.0f || strike.impulse.z != 0.0f ||
           strike.moment.x != 0.0f || strike.moment.y != 0.0f || strike.moment.z != 0.0f;
}

/// Returns the part of what is owed to a light body that it gets now: all of it where no cloth touches it. Else it
/// takes it as if it had the mass of the cloth on it too, which follows it: what it gets too little stays owed.
SHARED BodyStrike paid_part(BodyStrike owed, BodyConstants constants, vec4 turn, bool touched) {
    if (!touched) return owed;
    precise vec3 impulse = owed.impulse / (1.0f + constants.cover.x * constants.inverse.w);
    vec3 own = turned_by_quaternion(opposite_turn(turn), owed.moment);
    precise vec3 shares =
        vec3(1.0f + constants.cover.y * constants.inverse.x, 1.0f + constants.cover.y * constants.inverse.y,
             1.0f + constants.cover.y * constants.inverse.z);
    precise vec3 moment = own / shares;
    return BodyStrike(impulse, turned_by_quaternion(turn, moment));
}

SHARED BodyStrike unpaid_part(BodyStrike owed, BodyStrike paid) {
    precise vec3 impulse = owed.impulse - paid.impulse;
    precise vec3 moment = owed.moment - paid.moment;
    return BodyStrike(impulse, moment);
}

#endif
