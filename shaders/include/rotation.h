// Keeps a cloth's angular momentum (docs/solvers.md, "Angular momentum"). Over a substep that starts at X the sum of m
// X x d changes by the sum of X x J, where J is what each particle is given. The cloth's own forces have no torque, but
// what a method that takes springs one after another gives in their place has. A rotation of the whole cloth, about its
// centre of mass or the axis on which it is held, takes that back.
#ifndef DRAPE_ROTATION_H
#define DRAPE_ROTATION_H

#include "include/vector.h"

/// Returns the sum of nothing: -0 + x is x for every x.
SHARED TorqueSum empty_torque() {
    vec4 none = vec4(-0.0f, -0.0f, -0.0f, -0.0f);
    return TorqueSum(none, none, none, none);
}

SHARED vec4 torque_terms(vec4 a, vec4 b) {
    precise vec4 sum = vec4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w);
    return sum;
}

SHARED TorqueSum joined(TorqueSum a, TorqueSum b) {
    return TorqueSum(torque_terms(a.moment, b.moment), torque_terms(a.impulse, b.impulse),
                     torque_terms(a.torque, b.torque), torque_terms(a.products, b.products));
}

/// Returns the terms of a particle on which no air acts. `impulse` is what the cloth's forces gave it.
SHARED TorqueSum torque_of(vec3 arm, float mass, vec3 impulse, vec3 torque) {
    precise vec3 moment = arm * mass;
    precise vec4 products = vec4(moment.z * arm.z, moment.x * arm.y, moment.x * arm.z, moment.y * arm.z);
    precise float across = moment.x * arm.x;
    precise float down = moment.y * arm.y;
    return TorqueSum(vec4(moment.x, moment.y, moment.z, mass), vec4(impulse.x, impulse.y, impulse.z, across),
                     vec4(torque.x, torque.y, torque.z, down), products);
}

/// Returns what a step without air gave to a particle by the cloth's own forces, mass x m: what its displacement has
/// changed by, less damping and gravity.
SHARED vec3 own_impulse(vec3 displacement, vec3 before, float mass, vec3 gravity_step, float damping_loss) {
    precise vec3 change = (displacement - before) + before * damping_loss - gravity_step;
    precise vec3 impulse = change * mass;
    return impulse;
}

/// What air gives to a particle in a step, mass x m, and the mass that follows a change of its displacement.
struct AirImpulse {
    vec3 given;
    float mass;
};

/// `loss` is the share of the step that drag takes (verlet.h), `ratio` is RotationPush::drag_ratio of a BDF2 step, else
/// 1.
SHARED AirImpulse air_impulse(vec3 displacement, vec3 before, float mass, float loss, vec3 force, float force_step,
                              float ratio) {
    precise float drag = mass * (loss / (1.0f - loss)) * ratio;
    precise vec3 given = force * force_step - (displacement - before) * drag;
    precise float whole = mass + drag;
    return AirImpulse(given, whole);
}

/// Returns the terms of a particle, zeros of one that is held. `start` and `moved` are position and displacement of the
/// particle `about`; `now` is the displacement with the share beside it that drag takes, and `force` that of the air.
SHARED TorqueSum torque_on(vec4 position, vec3 start, vec4 now, vec3 moved, vec3 before, vec3 force, bool windy,
                           bool second_order, RotationPush push) {
    vec3 displacement = vec3(now.x, now.y, now.z);
    vec3 gravity_step = vec3(push.gravity_step.x, push.gravity_step.y, push.gravity_step.z);
    precise vec3 arm = vec3(position.x, position.y, position.z) - start;
    float mass = position.w > 0.0f ? reciprocal(position.w) : 0.0f;
    vec3 given = own_impulse(displacement, before, mass, gravity_step, push.damping_loss);
    if (!windy) return torque_of(arm, mass, given, ordered_cross(arm, given));
    float ratio = second_order ? push.drag_ratio : 1.0f;
    AirImpulse air = air_impulse(displacement, before, mass, now.w, force, push.force_step, ratio);
    // Air acts at a BDF2 step's end.
    precise vec3 further = (displacement - moved) * (second_order ? 1.0f : 0.0f);
    precise vec3 own = given - air.given;
    precise vec3 torque = ordered_cross(arm, own) - ordered_cross(further, air.given);
    return torque_of(arm, air.mass, own, torque);
}

/// Returns the terms of a particle after contact between cloths, zeros of one that is held: in `torque` the couples of
/// its pairs (self_half_couple), and in `impulse` the angular momentum that it has gained as contact moved it by
/// `shift`, m, which is no part of its motion.
SHARED TorqueSum contact_torque_on(vec3 arm, float inverse_mass, vec3 shift, vec3 displacement, vec3 couple) {
    float mass = inverse_mass > 0.0f ? reciprocal(inverse_mass) : 0.0f;
    precise vec3 shifted = ordered_cross(shift, displacement) * mass;
    return torque_of(arm, mass, shifted, couple);
}

SHARED TorqueSum with_torque(TorqueSum sum, vec3 torque) {
    return TorqueSum(sum.moment, vec4(0.0f, 0.0f, 0.0f, sum.impulse.w),
                     vec4(torque.x, torque.y, torque.z, sum.torque.w), sum.products);
}

/// Returns the sum with all that is to be taken back as its torque. The couples of cloth at rest are those of the
/// substep before. Taken back after contact, they would set the cloth in motion. So each substep but a frame's last one
/// also pays the next one's in advance, and contact answers that; `paid` is what this one finds paid.
SHARED TorqueSum contact_owed(TorqueSum sum, vec3 paid, bool ends_frame) {
    vec3 couples = vec3(sum.torque.x, sum.torque.y, sum.torque.z);
    precise vec3 rest = (couples - paid) + vec3(sum.impulse.x, sum.impulse.y, sum.impulse.z);
    precise vec3 both = rest + couples;
    return with_torque(sum, ends_frame ? rest : both);
}

/// Returns the sum with what a substep pays in advance as its torque.
SHARED TorqueSum contact_advance(TorqueSum sum) {
    return with_torque(sum, vec3(sum.torque.x, sum.torque.y, sum.torque.z));
}

/// Returns where a particle is at the end of its motion, relative to `start`, m.
SHARED vec3 arm_at_end(vec3 position, vec3 displacement, vec3 start) {
    precise vec3 arm = (position - start) + displacement;
    return arm;
}

/// How a cloth is turned at the end of a substep.
struct Rotation {
    vec3 centre;  // m, relative to the particle `about`
    vec3 turn;    // radians
    vec3 taken;   // the angular momentum that this takes back, of masses in units of an inner particle's, times h: m^2
};

SHARED Rotation no_rotation() {
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    return Rotation(none, none, none);
}

/// Inertia about a point: the diagonal and the products xy, xz, yz with their signs.
struct Inertia {
    vec3 diagonal, products;
};

SHARED Inertia inertia_of(TorqueSum sum, vec3 centre, float mass) {
    precise float across = sum.impulse.w - mass * centre.x * centre.x;
    precise float down = sum.torque.w - mass * centre.y * centre.y;
    precise float deep = sum.products.x - mass * centre.z * centre.z;
    precise vec3 diagonal = vec3(down + deep, across + deep, across + down);
    precise vec3 products =
        vec3(mass * centre.x * centre.y - sum.products.y, mass * centre.x * centre.z - sum.products.z,
             mass * centre.y * centre.z - sum.products.w);
    return Inertia(diagonal, products);
}

/// A millionth of the sum of the moments of inertia is added to each: a cloth that is all on a line has none about it.
SHARED float least_inertia(Inertia inertia) {
    precise float least = (inertia.diagonal.x + inertia.diagonal.y + inertia.diagonal.z) * 1.0e-6f;
    return least;
}

/// Returns the turn whose angular momentum is `wanted`.
SHARED vec3 turn_of(Inertia inertia, vec3 wanted) {
    float least = least_inertia(inertia);
    precise float first = inertia.diagonal.x + least;
    precise float low = inertia.products.x / first;
    precise float lowest = inertia.products.y / first;
    precise float second = inertia.diagonal.y + least - low * inertia.products.x;
    precise float rest = inertia.products.z - low * inertia.products.y;
    precise float between = rest / second;
    precise float third = inertia.diagonal.z + least - lowest * inertia.products.y - between * rest;
    precise float y = wanted.y - low * wanted.x;
    precise float z = (wanted.z - lowest * wanted.x - between * y) / third;
    precise float turn_y = y / second - between * z;
    precise float turn_x = wanted.x / first - low * turn_y - lowest * z;
    return vec3(turn_x, turn_y, z);
}

/// Returns the turn about an axis, a unit vector, whose angular momentum about it is that of `wanted`.
SHARED vec3 turn_about(Inertia inertia, vec3 axis, vec3 wanted) {
    precise vec3 products = vec3(inertia.products.x * axis.y + inertia.products.y * axis.z,
                                 inertia.products.x * axis.x + inertia.products.z * axis.z,
                                 inertia.products.y * axis.x + inertia.products.z * axis.y);
    precise vec3 moments =
        vec3(inertia.diagonal.x * axis.x, inertia.diagonal.y * axis.y, inertia.diagonal.z * axis.z) + products;
    precise float moment = ordered_dot(axis, moments) + least_inertia(inertia);
    precise vec3 turn = axis * (ordered_dot(axis, wanted) / moment);
    return turn;
}

/// Returns the rotation that takes the sum's torque back. A larger one than a tenth of a radian is none: such a step
/// has made nonsense of the cloth. Of `axis`, RotationPush::axis, only a cloth that is `held` takes notice.
SHARED Rotation rotation_of(TorqueSum sum, vec4 axis, bool held) {
    float mass = sum.moment.w;
    vec3 moment = vec3(sum.moment.x, sum.moment.y, sum.moment.z), none = vec3(0.0f, 0.0f, 0.0f);
    precise vec3 centre = moment * reciprocal(mass);
    if (held) centre = none;
    vec3 impulse = vec3(sum.impulse.x, sum.impulse.y, sum.impulse.z);
    precise vec3 made = vec3(sum.torque.x, sum.torque.y, sum.torque.z) - ordered_cross(centre, impulse);
    Inertia inertia = inertia_of(sum, centre, mass);
    vec3 line = vec3(axis.x, axis.y, axis.z);
    vec3 turn = held && axis.w == 0.0f ? turn_about(inertia, line, -made) : turn_of(inertia, -made);
    precise vec3 about_line = line * ordered_dot(line, made);
    vec3 taken = held && axis.w == 0.0f ? about_line : made;
    bool sound = ordered_dot(turn, turn) < 0.01f;
    return sound ? Rotation(centre, turn, taken) : no_rotation();
}

/// Returns by how much the rotation changes a particle's displacement.
SHARED vec3 turned_by(Rotation rotation, vec3 arm) {
    precise vec3 from_centre = arm - rotation.centre;
    return ordered_cross(rotation.turn, from_centre);
}
SHARED vec3 with_turn(vec3 displacement, vec3 by) {
    precise vec3 turned = displacement + by;
    return turned;
}
SHARED vec3 without_turn(vec3 remainder, vec3 by) {
    precise vec3 kept = remainder - by;
    return kept;
}

/// Returns the place about which a cloth is turned; `start`: that of the particle `about`.
SHARED vec3 turned_about(Rotation rotation, vec3 start) {
    precise vec3 centre = start + rotation.centre;
    return centre;
}

/// Returns a motion without what a turn about `centre`, which was paid in advance, has added to it.
SHARED vec3 without_advance(vec3 motion, vec3 turn, vec3 centre, vec3 position) {
    precise vec3 arm = position - centre;
    return without_turn(motion, ordered_cross(turn, arm));
}

/// Returns the displacement of a particle that the rotation takes along.
SHARED vec3 rotated(Rotation rotation, vec3 arm, vec3 displacement) {
    precise vec3 moved = displacement + ordered_cross(rotation.turn, arm - rotation.centre);
    return moved;
}

#endif
