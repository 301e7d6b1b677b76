// Where a frame's impulses are summed (include/impulses.h): a cloth has rows of numbers, and each number two words.
#ifndef DRAPE_IMPULSE_TYPES_H
#define DRAPE_IMPULSE_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A row has six numbers, each a 64-bit integer as two texels, the low word first.
const int impulse_numbers = 6, impulse_columns = 2 * impulse_numbers;

/// The rows, in masses of an inner particle times m; the rows of colliders and of pins follow, an impulse first and,
/// of a collider, its moment about the collider's centre then.
const int impulse_head = 0;      // the first texel is impulse_units, as a float's bits
const int impulse_momentum = 1;  // what the frame changed the momentum by, then by how far it moved free particles
const int impulse_air = 2;       // by air
const int impulse_cloths = 3;    // by contact with other cloths
const int impulse_loads = 4;     // by loads
const int impulse_first = 5;     // by the first collider

/// Units of the sum of how far free particles moved, by mass: to a metre of an inner particle.
const float travel_units = 1073741824.0f;

/// Where the largest of a frame's substeps are kept, all rows of sums are followed by as many with what they were when
/// the substep before ended, and these by as many with the largest impulse and the largest moment of a substep.
const int impulse_tables = 3;

struct WorstImpulsesPush {
    int rows;  // of sums
};

struct ClearImpulsesPush {
    int rows;
    float units;  // to a metre of an inner particle's motion in a substep
};

/// Vectors are over the spring directions.
struct MomentumPush {
    ivec2 grid;
    float sign;         // -1 as a frame begins, 1 as it ends
    float compression;  // share of a spring's stiffness where it is pushed together
    vec4 rest_length;   // m; 0: no springs
    vec4 pull;  // impulse, in masses of an inner particle times m, that a metre of tension gives in half a frame
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
