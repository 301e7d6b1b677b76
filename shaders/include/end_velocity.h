// The velocity at the end of a substep, and the state of a substep of another length (docs/solvers.md, "Steps that
// change"). The displacement d of a substep of length h is h times its mean velocity; with the displacement b of the
// substep before, of the same length, h times the velocity at its end is d + e, e = (d - b)/2 = h^2/2 times the
// acceleration. Under damping e has a share of that, with which d + e is exact in flight (excess_share).
#ifndef DRAPE_END_VELOCITY_H
#define DRAPE_END_VELOCITY_H

#include "shared/closed_loop_types.h"

/// Returns e (m), which is zero for a particle that stands still, such as that of a pin that has stopped. For a
/// particle that a collider touched, `before` is the value that collision.comp stored, the displacement itself.
SHARED vec3 end_excess(vec3 displacement, vec3 before, float half_share) {
    precise vec3 excess = (displacement - before) * half_share;
    bool stands = displacement.x == 0.0f && displacement.y == 0.0f && displacement.z == 0.0f;
    return stands ? vec3(0.0f, 0.0f, 0.0f) : excess;
}

/// The state of a substep of another length that ends at the same place with the same velocity and acceleration.
struct ChangedSubstep {
    vec3 displacement;
    vec3 before;  // displacement of the substep before it
    vec3 excess;
    vec3 excess_before;
};

SHARED ChangedSubstep changed_substep(vec3 displacement, vec3 excess, SubstepChange change) {
    precise vec3 velocity = (displacement + excess) * change.ratio;
    precise vec3 changed_excess = excess * change.excess;
    precise vec3 moved = velocity - changed_excess;
    precise vec3 before = moved - excess * change.before;
    precise vec3 excess_before = excess * change.excess_before;
    return ChangedSubstep(moved, before, changed_excess, excess_before);
}

#endif
