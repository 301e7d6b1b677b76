// Shaders and C++ share these structs of the steps that find the pressure of gas (include/gas.h), in std430.
#ifndef DRAPE_GAS_TYPES_H
#define DRAPE_GAS_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Particles over which one workgroup sums.
const int gas_particles = 1024;

struct GasAreaPush {
    ivec2 grid;
    float sign;  // 1: the front is outside; -1: the back; 0: the cloth closes nothing in
    float unused;
};

struct GasSumPush {
    ivec2 grid;
    int first;   // the cloth's first record among those of all cloths
    int origin;  // the place from which others are measured: a particle that exists
};

/// A workgroup's sums over particles, of areas A as their places bear them, in the parts of a place that particles are.
struct GasSum {
    vec4 origin;  // xyz: m, where x is measured from; w: sum of (x - origin).A, m^3
    vec4 area;    // xyz: sum of A, m^2; w: of |A|^2 over the mass of a place, m^4/kg
    vec4 change;  // x: sum of d.A, m^3; y: of d'.A, d' being what inertia alone makes of a BDF2 step; z: the part of
                  // area.w that colliders touch; w: unused
};

struct GasPush {
    int first, count;  // records of all cloths that close the gas in
    int weather;       // where in `wind` the substep's amount of gas is
    int ends;          // 1 = it is a frame's end: the volume alone is found
    vec2 square_step;  // s^2: h^2, and 4/9 of it
    float step;        // s: h
    float ambient;     // Pa
    int joint;         // as in PredictPush
    uint most_wrong;   // likewise
    int unused_x, unused_y;
};

/// A gas keeps this of a substep, in two texels of its cloths' images.
struct GasState {
    vec4 now;   // x: pressure above ambient, Pa; y: volume at the substep's start or the frame's end, m^3; z: how much
                // it would have grown by inertia alone, m^3; w: the substep's length, s, 0 before the first one
    vec4 kept;  // x: how much other forces make it grow in a substep, m^3; y: how much a pascal does, m^3/Pa
};
const int gas_texels = 2;

/// The least part of a change by other forces that is believed at once: so p follows them within some 16 substeps.
const float least_gas_belief = 1.0f / 16.0f;

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
