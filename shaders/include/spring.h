// The projection of a spring (distance constraint), which every solver that takes springs one by one uses, and which
// spring an invocation of a pass owns. Sources: Jakobsen 2001 (relaxation, weighted by inverse mass), Macklin et al.
// 2016 "XPBD" eq. 18 (compliance and multiplier).
#ifndef DRAPE_SPRING_H
#define DRAPE_SPRING_H

#include "include/vector.h"

/// Returns the first particle (column, row) of spring `pair` of a parity pass; the second is `offset` away. Springs
/// whose offset leads to the left start one column in.
SHARED ivec2 spring_owner(ivec2 pair, ivec2 offset, int parity_axis, int parity) {
    int x = parity_axis == 0 ? 2 * pair.x + parity : pair.x;
    int y = parity_axis == 1 ? 2 * pair.y + parity : pair.y;
    return ivec2(offset.x < 0 ? x + 1 : x, y);
}

/// Returns the share of a spring's stiffness that the cells beside it give. A spring along a border has one cell
/// instead of two; a diagonal belongs to one cell and always has its full stiffness.
SHARED float border_share(ivec2 owner, ivec2 offset, ivec2 grid) {
    if (offset.y == 0 && (owner.y == 0 || owner.y == grid.y - 1)) return 0.5f;
    if (offset.x == 0 && (owner.x == 0 || owner.x == grid.x - 1)) return 0.5f;
    return 1.0f;
}

/// Returns second - first in displacement form. The difference of the start positions is exact where it matters, so the
/// edge carries the rounding of the edge's length, not of the distance from the origin (the position form loses a
/// factor of ten in the swing test).
SHARED vec3 spring_edge(vec3 position_first, vec3 position_second, vec3 displacement_first, vec3 displacement_second) {
    precise vec3 edge = (position_second - position_first) + (displacement_second - displacement_first);
    return edge;
}

SHARED vec3 moved_by(vec3 displacement, vec3 correction, float weight) {
    precise vec3 moved = displacement + correction * weight;
    return moved;
}

/// Returns the share of a spring's stiffness that acts; a compressed spring has `compression` of it, since fabrics
/// buckle on scales below the grid's spacing (docs/physics.md 1). `excess`: the spring's length minus its rest length,
/// or its tension, m.
SHARED float acting_share(float share, float compression, float excess) {
    precise float pushed = share * compression;
    return excess < 0.0f ? pushed : share;
}

/// Returns the tension (m) that balances a spring extended by `excess`, as an extension of the spring's full stiffness,
/// so that it means the same on both sides of the rest length. (If it were an extension of the stiffness that acts, a
/// spring that snaps from compression to extension would return 1/compression times the energy that it took, and the
/// cloth would explode.)
SHARED float balancing_tension(float excess, float compression) {
    precise float pushed = excess * compression;
    return excess < 0.0f ? pushed : excess;
}

struct SpringResult {
    vec3 correction;  // for the second particle, times its w; the first gets the negative, times its own w
    float tension;    // m; the spring's tension so far, as an extension of its full stiffness
};

/// `edge` = second - first, m; `weight_sum` = w_first + w_second (relative inverse masses); `share` in [0, 1] scales
/// the spring's stiffness, 0 = no spring, and so does `compression` c where it is pushed together; `compliance` =
/// m_inner / (k h^2), 0 = rigid. `tension` is the XPBD multiplier lambda as T = -a lambda/s, m, which unlike lambda
/// means the same to every solver: a perfect solve makes f(C) - T zero, f(C) = C, or c C where C < 0
/// (balancing_tension). delta lambda = -s (f(C) - T) / (s f'(C) (w1 + w2) + a): eq. 18 with compliance a/s, numerator
/// and denominator times s, so that s = 0 is no division by zero. A rigid spring between two fixed particles, and one
/// of zero length (no direction), are left alone.
SHARED SpringResult project_spring(vec3 edge, float weight_sum, float rest_length, float share, float compression,
                                   float compliance, float tension) {
    precise float length_squared = ordered_dot(edge, edge);
    precise float current = sqrt(length_squared);
    precise float excess = current - rest_length;
    float acting = acting_share(share, compression, excess);
    precise float denominator = acting * weight_sum + compliance;
    if (!(length_squared > 0.0f) || !(denominator > 0.0f)) return SpringResult(vec3(0.0f, 0.0f, 0.0f), tension);
    precise float residual = balancing_tension(excess, compression) - tension;
    precise float change = -(share * residual) / denominator;
    precise vec3 correction = edge * (change / current);
    precise float updated = tension + compliance * (residual / denominator);
    return SpringResult(correction, updated);
}

#endif
