// The stretch error of a substep's springs, which shows how far the solve is from converged.
#ifndef DRAPE_RESIDUAL_H
#define DRAPE_RESIDUAL_H

#include "include/spring.h"
#include "include/vector.h"
#include "shared/residual_types.h"

SHARED ResidualRecord empty_residual() { return ResidualRecord(-0.0f, 0u); }

SHARED ResidualRecord joined(ResidualRecord a, ResidualRecord b) {
    precise float squares = a.squares + b.squares;
    return ResidualRecord(squares, a.count + b.count);
}

/// Returns `record` plus a stretch spring of length |edge|. Its error is (f(|edge| - rest_length) -
/// tension)/rest_length, which a perfect solve makes zero (spring.h). `share`: of its stiffness, 0 = the spring does
/// not exist; a compressed spring has `compression` of it.
SHARED ResidualRecord add_residual(ResidualRecord record, vec3 edge, float rest_length, float share, float compression,
                                   float tension) {
    if (!(rest_length > 0.0f) || !(share > 0.0f)) return record;
    precise float current = sqrt(ordered_dot(edge, edge));
    precise float excess = current - rest_length;
    precise float error = (balancing_tension(excess, compression) - tension) / rest_length;
    precise float squares = record.squares + error * error;
    return ResidualRecord(squares, record.count + 1u);
}

/// Returns whether the RMS is above the tolerance, or not finite.
SHARED bool needs_iteration(ResidualRecord record, float squared_tolerance) {
    precise float limit = squared_tolerance * float(record.count);
    return !(record.squares <= limit);
}

#endif
