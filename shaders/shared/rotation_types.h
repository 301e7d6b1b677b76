// Shaders and C++ share these structs of the steps that keep a cloth's angular momentum (include/rotation.h).
#ifndef DRAPE_ROTATION_TYPES_H
#define DRAPE_ROTATION_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Particles whose torques one workgroup sums, and the texels that it stores (TorqueSum).
const int torque_particles = 1024, torque_texels = 4;

struct RotationPush {
    ivec2 grid;
    ivec2 about;         // the particle relative to which arms are measured; where the cloth is held, it is on the axis
    vec4 axis;           // xyz: the axis about which a cloth that is held may turn; zero: none; w: 1 = any axis
    vec4 gravity_step;   // of PredictPush
    float damping_loss;  // 1 - exp(-c h)
    float force_step;    // displacement per newton on an inner particle of a Verlet step
    float drag_ratio;    // that over the same of a BDF2 step
    int sum_count;       // sums that the workgroups store
};

/// Texels of what a substep of contact pays in advance: couples, of two substeps in turn, then the turn that pays them
/// and the place about which it goes.
const int paid_turn = 2, paid_texels = 4;

/// Constants of the steps that give back what contact between cloths makes of angular momentum.
struct ContactTurnPush {
    ivec2 grid;
    ivec2 about;      // as in RotationPush
    vec4 axis;        // as in RotationPush
    ivec2 first;      // where the cloth lies on the sheet
    ivec2 sheet;      // columns, rows of the sheet
    float largest;    // SelfCloth's
    float lightness;  // SelfCloth's
    int sum_count;    // sums that the workgroups store
    int paid;         // which of two texels holds what the substep before paid in advance; the other is for this one
};

/// Sums over particles, of masses in units of an inner particle's. Arms are relative to the particle `about`, m.
struct TorqueSum {
    vec4 moment;    // xyz: mass x arm; w: mass
    vec4 impulse;   // xyz: what the cloth's own forces gave, mass x m; w: mass x arm.x^2
    vec4 torque;    // xyz: arm x what they gave; w: mass x arm.y^2
    vec4 products;  // mass x arm.z^2, arm.x arm.y, arm.x arm.z, arm.y arm.z
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
