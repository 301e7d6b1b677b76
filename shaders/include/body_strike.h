// What a cloth gives to a body.
#ifndef DRAPE_BODY_STRIKE_H
#define DRAPE_BODY_STRIKE_H

#include "include/rigid_body.h"
#include "shared/body_types.h"

/// Returns a body after what it gave to a cloth, an impulse and its moment about the shape's centre, in units.
SHARED RigidBody body_after_cloth(RigidBody body, BodyConstants constants, vec3 given, vec3 moment, float unit) {
    precise vec3 impulse = given * -unit;
    vec3 from_center =
        turned_by_quaternion(body.turn, vec3(constants.center.x, constants.center.y, constants.center.z));
    precise vec3 own_moment = moment * -unit - ordered_cross(from_center, impulse);
    return struck_body(body, constants.inverse.w, impulse, own_moment);
}

#endif
