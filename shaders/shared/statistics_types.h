// Structs of the statistics passes, shared by GLSL and C++, in std430.
#ifndef DRAPE_STATISTICS_TYPES_H
#define DRAPE_STATISTICS_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Rows of particles that one invocation of the statistics joins, and such records that a workgroup then joins, by a
/// tree over its lanes at the end. The tree costs the default device as much as a few hundred particles, so that with a
/// workgroup for each of the first ones it took as long as the particles.
const int statistics_rows = 32, statistics_chunk = 4096;

/// Push constants of a cloth's statistics. Vectors are over the spring directions: row, column, shear down-right, shear
/// down-left.
struct StatisticsPush {
    vec4 rest_length;     // m; 0: the cloth has no springs of this direction
    vec4 half_stiffness;  // N/m, k/2; 0: rigid, stores no energy
    vec4 half_bend;       // N/m, half the constants of bending along rows, along columns, and of twist (include/bend.h)
    ivec2 grid;           // columns, rows
    int collider_first;   // first collider at the frame's end
    float compression;    // share of the stiffness where springs are pushed together
};

struct StatisticsSumPush {
    int partial_count;
};

/// Statistics of a particle and its springs, of a part of a column, or of a cloth; include/statistics.h joins them.
struct StatisticsRecord {
    vec4 squares;   // sums: squared strain of stretch, of shear; elastic energy, J; mass share x |h v|^2, m^2
    vec4 moments;   // sums: xyz mass share x (position - reference), m; w: mass share (1 = an inner particle's)
    vec4 strains;   // largest: strain of stretch, of shear; minus strain of stretch, of shear
    vec4 extents;   // largest: |position|^2, m^2; |h v|^2, m^2; penetration, m; |stretch error|
    vec4 errors;    // sums: squared stretch error; yzw: what turning the cloth took back (Rotation::taken), m^2
    vec4 momentum;  // sums: xyz mass share x h v, m; w unused
    vec4 mean;      // sums: xyz mass share x displacement of the last substep, m; w unused
    vec4 spin;      // sums: xyz mass share x (position - reference) x displacement, m^2; w unused
    uvec4 counts;   // particles not finite; index of the first of them (none: all ones); springs: stretch, shear
    uvec4 places;   // index of the first particle with each of the extents; of a spring its first (none: all ones)
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
