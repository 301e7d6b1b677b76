// Bodies that cloth moves (include/rigid_body.h), and the constants of their passes, in std430.
#ifndef DRAPE_BODY_TYPES_H
#define DRAPE_BODY_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A body of a scene. Its principal axes are those of its shape.
struct BodyConstants {
    vec4 inverse;  // xyz: of its principal moments, 1/(kg m^2); w: of its mass, 1/kg
    vec4 center;   // xyz: its centre of mass in its shape's frame, m; w: sqrt(friction)
    vec4 size;     // xyz: its shape's parameters, as in ColliderRecord; w: from its centre to the farthest point, m
    ivec4 what;    // x: its kind, y: its number among the colliders; zw unused
};

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
/// w of the velocity being 1 where planes changed them, else 0.
const int body_position = 0, body_remainder = 1, body_turn = 2, body_velocity = 3, body_slower = 4, body_spin = 5;
const int body_last_velocity = 6, body_last_spin = 7;
const int body_texels = 8;

struct BodyMovePush {
    vec4 gravity;  // xyz: m/s^2; w: the substep, s
    int body_count;
    int first;         // the substep's first record of the scene's first list of colliders
    int list_count;    // lists of colliders
    int record_count;  // records of a list
    int plane_count;   // the list's first records are planes
    int weather;       // index of the change of gravity since the start
    float recovery;    // m that a substep resolves of an overlap
    int first_action;  // index of the first body's
    int begins;        // 1: the frame begins with this substep
    int unused_a, unused_b, unused_c;
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
