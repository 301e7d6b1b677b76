// Shaders and C++ share these structs and constants of the line solver.
#ifndef DRAPE_LINE_TYPES_H
#define DRAPE_LINE_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Lines are few and long: workgroups of one subgroup of the default device spread them over the cores.
const int line_group_width = 8;
/// Texels in a row of the lines' scratch image, which is addressed as if it had only one row. An image of 16384 a side
/// holds that of 4096 x 4096 particles; wider rows would cost small cloths, which have at least one.
const int line_scratch_width = 2048;

struct LinePush {
    ivec2 grid;  // columns, rows
    ivec2 step;  // from a particle of a line to the next; columns wrap around
    int line_count;
    int particle_count;     // in each line, >= 2
    int seam;               // column whose particles own no spring of this direction, -1 = none
    int channel;            // index into the spring shares
    float rest_length;      // m
    float compliance;       // m_inner / (k h^2), dimensionless, > 0
    float compliance_bdf2;  // (9/4) (1 + (2/3) c h) m_inner / (k h^2)
    float followed;         // compliance asked for over `compliance`, 1 = nothing softened
    float followed_bdf2;
    float bend;         // b h^2 / m_inner, for an element that has its whole share; 0 on diagonals
    float bend_bdf2;    // b h^2 / m_inner over (9/4) (1 + (2/3) c h)
    float compression;  // share of a spring's stiffness where it is pushed together
};

/// Push constants of the line solver's prediction in second order (include/bdf2.h).
struct PredictPush {
    ivec2 grid;
    vec2 loss;               // x: 1 - exp(-c h), y: (2/3) (1 - f), f = 1/(1 + (2/3) c h) (about: bdf2.h)
    vec2 force_step;         // displacement per newton on an inner particle: phi h^2 / m_inner, f (4/9) h^2 / m_inner
    vec2 weight;             // f 2/9, f 8/9
    vec4 gravity_step;       // xyz: phi h^2 g, metres; w unused
    vec4 gravity_step_bdf2;  // xyz: f (4/9) h^2 g, metres; w unused
    uint most_wrong;         // lines that may meet a spring wrong by more than line_violation_limit
    int joint;               // of cloth that is sewn to others: SeamPush::joint; else -1
    uint unused_x, unused_y;
};

/// Texels of the line solver's control image (LineControl in include/bdf2.h). A prediction reads the control of the
/// substep before and writes that of its own to another image, which the substep's other passes take.
const int control_order = 0, control_wrong_lines = 1, control_hold = 2, control_texel_count = 3;
/// A spring that a substep meets wrong by more than its own length, beyond what the carried tension explains, shows
/// that BDF2 extrapolates nonsense there. Where many lines have one the next substeps are backward Euler.
const float line_violation_limit = 1.0f;
const uint line_hold_count = 8u;
/// Substeps until BDF2 has a history, which takes two differences of its own. At the start that is two substeps, the
/// first of which is made up for free flight; after a pin has let go it is three, this one and two more.
const uint line_hold_start = 2u, line_hold_release = 4u;
/// Contact raises `hold` after it has been counted down for this substep, so to one more.
const uint line_hold_contact = line_hold_count + 1u;

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
