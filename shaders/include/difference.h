// Measures how far apart two runs are in a frame (docs/solvers.md, "The closed loop").
#ifndef DRAPE_DIFFERENCE_H
#define DRAPE_DIFFERENCE_H

#include "include/vector.h"
#include "shared/closed_loop_types.h"

SHARED DifferenceRecord empty_difference() { return DifferenceRecord(-0.0f, -0.0f); }

SHARED DifferenceRecord joined(DifferenceRecord a, DifferenceRecord b) {
    precise float moved = a.moved + b.moved;
    precise float mass = a.mass + b.mass;
    return DifferenceRecord(moved, mass);
}

/// Returns the difference of one particle with relative inverse mass `weight`; a held particle does not count.
SHARED DifferenceRecord particle_difference(float weight, vec3 position, vec3 coarse_position) {
    if (!(weight > 0.0f)) return empty_difference();
    precise float share = 1.0f / weight;
    precise vec3 apart = position - coarse_position;
    precise float moved = share * ordered_dot(apart, apart);
    return DifferenceRecord(moved, share);
}

#endif
