// Bodies that cloth moves (include/rigid_body.h), and the constants of their passes, in std430.
#ifndef DRAPE_BODY_TYPES_H
#define DRAPE_BODY_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A body of a scene, or what bodies meet that has no mass, with zeros for `inverse`. Its frame has its principal axes,
/// which are those of its shape, but for a mesh's.
struct BodyConstants {
    vec4 inverse;  // xyz: of its principal moments, 1/(kg m^2); w: of its mass, 1/kg
    vec4 center;   // xyz: its centre of mass in its frame, from the shape's centre, m; w: sqrt(friction)
    vec4 size;     // xyz: its shape's parameters, as in ColliderRecord; w: from its centre to the farthest point, m
    vec4 axes;     // of a mesh: the turn of its frame from its shape's
    vec4 cover;  // of a body that is light beside the cloth that covers it: x: that cloth's mass, kg, y: and moment of
                 // inertia, kg m^2; else 0; zw unused
    ivec4 what;  // x: its kind, y: its number among the colliders; of a mesh z: its first hull point, w: their number
};

/// A body, or an obstacle, in a substep's contact of bodies.
struct MetBody {
    vec4 pose_x, pose_y, pose_z;  // of its shape when the substep begins: rows of world from local; w: its centre, m
    vec4 middle;                  // xyz: its centre of mass, m; w: what none of it moves farther than in the substep, m
    vec4 field;                   // of a mesh: ColliderRecord.way_out, for true surfaces when the substep begins
    vec4 velocity;                // from here on of a body: xyz: m/s; w unused
    vec4 slower;                  // xyz: what rounding lost of that, m/s; w unused
    vec4 spin;                    // xyz: angular momentum about the centre of mass, kg m^2/s; w unused
    vec4 led;                     // xyz: what leads it out of overlaps, m; w: 1: contact acted on it, else 0
    vec4 inertia, inertia_z;      // the inverse of its tensor of inertia in the world, 1/(kg m^2): xx, xy, xz, yy and
                                  // yz, zz; w of the second: the inverse of its mass, 1/kg
};

/// A place where two bodies, or a body and an obstacle, may touch in a substep.
struct BodyMeeting {
    vec4 arm;     // xyz: from the first body's centre of mass, m; w: the friction's coefficient
    vec4 beside;  // xyz: from the second body's centre of mass, m; w: depth of a pair's deepest, m, else 0
    vec4 normal;  // xyz: unit, towards the first body; w: relative velocity along it that is allowed at least, m/s
    vec4 ground;  // xyz: velocity of an obstacle, m/s; w: impulse along the normal, N s
    vec4 grip;    // xyz: impulse along the surfaces, N s; w: the mass with which both resist along the normal, kg
    vec4 yields, yields_z;  // the change of the relative velocity by an impulse, a symmetric tensor, 1/kg: xx, xy, xz,
                            // yy and yz, zz; z of the second: the first relative speed, m/s; w unused
    ivec4 who;  // x: first body, -1 after the last of a pair; y: second body, or -1: an obstacle; z unused; w: of
                // the meeting of this number among all: its place
};
/// A pair is a body and a later body, or an obstacle, which are counted after the bodies: pair a * all + b. Each has
/// room for as many meetings.
const int pair_meetings = 16;

/// What acts on a body in a frame beside what the scene has.
struct BodyAction {
    vec4 force;     // xyz: N; w: 1: the frame begins with `velocity` and `turning`, else 0
    vec4 moment;    // xyz: N m, about the centre of mass
    vec4 impulse;   // xyz: N s, as the frame begins
    vec4 twist;     // xyz: N m s, as the frame begins
    vec4 velocity;  // xyz: m/s
    vec4 turning;   // xyz: rad/s
};

/// The state of a body is a row of an image: its position and what rounding lost of it, its turn, its velocity and what
/// rounding lost of that, its angular momentum, and the velocity and the angular momentum of the last substep's motion,
/// w of the velocity being 1 where contact changed them, else 0. Of a light body two more: the momentum and the angular
/// momentum that cloth gave it and that are not yet in its motion, w of the first being 1 where cloth gave it some in
/// the last substep.
const int body_position = 0, body_remainder = 1, body_turn = 2, body_velocity = 3, body_slower = 4, body_spin = 5;
const int body_last_velocity = 6, body_last_spin = 7;
const int body_owed = 8, body_owed_spin = 9;
const int body_texels = 10;

struct BodyMovePush {
    vec4 gravity;  // xyz: m/s^2; w: the substep, s
    int body_count;
    int first;           // the substep's first record of the scene's first list of colliders
    int list_count;      // lists of colliders
    int record_count;    // records of a list
    int plane_count;     // the list's first records are planes
    int weather;         // index of the change of gravity since the start
    float recovery;      // m that a substep resolves of an overlap
    int first_action;    // index of the first body's
    int begins;          // 1: the frame begins with this substep
    int obstacle_count;  // colliders without a mass that bodies meet, whose constants follow the bodies'
    int unused_a, unused_b;
};

struct BodyStrikePush {
    int body_count;
    int begins;  // 1: the sums begin with this substep
    float unit;  // N s of a unit of the cloth's impulses
    int unused;
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
