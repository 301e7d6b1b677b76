// Structs that the simulation's shaders and the C++ side share, in std430; every member's offset is compared with the
// SPIR-V when a pass is recorded (struct_layout.h).
#ifndef DRAPE_SIMULATION_TYPES_H
#define DRAPE_SIMULATION_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Workgroups are rows along x: 64x1 is among the best shapes on the default device and coalesces on GPUs.
const int workgroup_width = 64;
/// Rows of a state image's buffer view begin at multiples of so many bytes (include/state_store.h).
const int state_row_alignment = 64;

/// Push constants of one parity pass of one spring direction (engine/cloth/directions.h).
struct SpringPush {
    ivec2 grid;           // columns, rows
    ivec2 pair_count;     // springs of this pass along columns, rows
    ivec2 offset;         // from a spring's first particle to its second
    int parity_axis;      // 0: pairs alternate along columns, 1: along rows
    int parity;           // 0 even, 1 odd
    float rest_length;    // m
    float compliance;     // m_inner / (k h^2), dimensionless; 0 = rigid
    int channel;          // index into the spring shares: row, column, shear down-right, shear down-left
    int first_iteration;  // 1: the tension starts at zero (it is written, not read)
    float compression;    // share of a spring's stiffness where it is pushed together
    int unused;
};

/// Push constants of all passes of an iteration at once (spring_stream.comp). Vectors are over the spring directions.
struct AllSpringsPush {
    ivec2 grid;
    float compression;  // as in SpringPush
    float unused;
    vec4 rest_length;  // m
    vec4 compliance;   // as in SpringPush
};

struct ForcePush {
    ivec2 grid;
    float damping_loss;  // q = 1 - exp(-c h)
    float force_step;    // phi h^2 / m_inner: displacement per newton on an inner particle
    vec4 gravity_step;   // xyz: phi h^2 g, metres; w unused
};

/// Vectors are over the spring directions: row, column, shear down-right, shear down-left.
struct ExplicitPush {
    ivec2 grid;
    float damping_loss;       // q = 1 - exp(-c h)
    float force_step;         // phi h^2 / m_inner: displacement per newton on an inner particle
    vec4 gravity_step;        // xyz: phi h^2 g, metres; w unused
    vec4 rest_length;         // m
    vec4 relative_stiffness;  // phi k h^2 / m_inner, dimensionless, softened where the step would not be stable
    vec2 bend;                // phi b h^2 / m_inner: elements along columns (a row's), along rows
    float strain_damping;     // kappa: strain-rate damping is kappa k h
    float twist;              // phi t h^2 / m_inner
    vec4 compression;         // x: share of a spring's stiffness where it is pushed together; yzw unused
};

/// Push constants of one colour of the bending elements of one axis (engine/cloth/directions.h).
struct BendPush {
    ivec2 grid;
    ivec2 element_count;  // elements of this pass along columns, rows
    ivec2 axis;           // (1, 0): three particles of a row, (0, 1): of a column
    int colour;           // 0, 1, 2
    int channel;          // index into the spring shares: 0 row, 1 column
    float compliance;     // m_inner / (b h^2), dimensionless, > 0
    int unused;
};

/// Push constants of the twist of one colour of the cells (engine/cloth/directions.h).
struct TwistPush {
    ivec2 grid;             // columns, rows
    ivec2 element_count;    // cells of this pass along columns, rows
    ivec2 first;            // first cell of the colour
    float compliance;       // m_inner / (t h^2), dimensionless, > 0
    float compliance_bdf2;  // (9/4) (1 + (2/3) c h) m_inner / (t h^2)
};

/// Push constants of the twist of all colours at once (twist_stream.comp).
struct AllTwistPush {
    ivec2 grid;
    float compliance;  // as in TwistPush
    float compliance_bdf2;
};

struct WindPush {
    ivec2 grid;
    int substep;
    float inverse_step;      // 1 / h
    float drag_coefficient;  // air_density (Cd - Cl) / 2
    float lift_coefficient;  // air_density Cl / 2
    vec2 spacing;            // m, of particles along columns, rows
    int first;               // index of the first substep's wind, of the cloth's own scene
    float inner_mass;        // kg, of an inner particle
    int first_load;          // of the cloth, among those of its scene
    float gas_sign;          // of GasAreaPush; 0: it closes no gas in
};

/// Bits of what the air acts on at a particle: its quarters of the cells up left, up right, down left and down right,
/// and the neighbours left, right, up and down that springs still hold it to.
const uint air_up_left = 1u, air_up_right = 2u, air_down_left = 4u, air_down_right = 8u;
const uint air_left = 16u, air_right = 32u, air_up = 64u, air_down = 128u;

struct CollisionPush {
    vec4 contact;  // x: thickness kept from every collider, m; y: square root of the cloth's friction coefficient; z:
                   // depth, m, under which a contact asks for no further round; w: m that a substep resolves of an
                   // overlap that was there before
    ivec2 grid;    // columns, rows
    int first;     // first collider of this substep; the cloth's own are `list` further
    int sheet_columns;  // after contact between cloths: columns of their sheet (shared/self_contact_types.h)
    ivec2 laid;         // and where this one lies on it
    int list;
    int unused;
};

struct PinPush {
    int particle_count;
    int motion_first;  // first motion of this substep
    int rows;          // of a cloth
};

struct ReleasePush {
    vec4 relative_stiffness;  // k h^2/m_inner by direction, for springs whose tension is stored
    ivec2 grid;
    int particle_count;
    int motion_first;  // first motion of this substep
    float reach;       // the cloth's diagonal, m
    float unused_x, unused_y, unused_z;
};

/// Vectors are over the stretch springs: along a row (x), along a column (y).
struct TensionPush {
    ivec2 grid;
    vec2 rest_length;      // m; 0: no springs
    vec2 used_share;       // share that the micro-step uses of the stiffness asked for
    float strain_damping;  // kappa
    float compression;     // share of a spring's stiffness where it is pushed together
};

struct GridPush {
    ivec2 grid;
};

struct AdvancePush {
    ivec2 grid;
    float half_share;  // half of excess_share (engine/cloth/substep_change.h)
    float unused;
};

struct StiffnessPush {
    ivec2 grid;
    int cloth;
    int unused;
};

/// A particle that the scene pins with a motion or a release.
struct PinnedParticle {
    vec4 rest;    // xyz: position at rest, metres; w: its inverse mass once released
    ivec4 index;  // column, row, motion, first row of its cloth (include/together.h)
};

/// Rigid motion of one pin at the end of one substep: x = rows . (rest, 1). Of a pin that took its particles where they
/// were it is the displacement in the substep of what is at x: rows . (x, 1). From the pin's release on it is h times
/// the velocity that it then had, m, of the same places.
struct PinMotion {
    vec4 row_x, row_y, row_z;
    vec4 held;  // x: 1 while held at the start of this substep, 0 from its release on; y: how many substeps ago that
                // was, 1 at most; z: 1 where the pin took its particles where they were; w unused
    ivec4 box;  // first column and row, last column and row of the particles that it holds or lets go; none: empty
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
