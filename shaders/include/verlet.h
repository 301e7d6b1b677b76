// Verlet in displacement form with compensated sums (docs/physics.md 3). The state is X, the position at the start of
// the substep, d, its displacement, and the part that rounding lost of each (`*_remainder`), so that 1e5 substeps do
// not drift.
#ifndef DRAPE_VERLET_H
#define DRAPE_VERLET_H

struct CompensatedSum {
    vec3 value;
    vec3 remainder;  // exact sum - value
};

/// Returns a + b + remainder, with the rounding error: Knuth's TwoSum, exact for any magnitudes.
SHARED CompensatedSum compensated_add(vec3 a, vec3 b, vec3 remainder) {
    precise vec3 addend = b + remainder;
    precise vec3 sum = a + addend;
    precise vec3 back = sum - a;
    precise vec3 lost = (a - (sum - back)) + (addend - back);
    return CompensatedSum(sum, lost);
}

/// Returns the displacement of the next substep before constraints: d' = e^(-c h) d + phi h^2 (g + w F / m), as an
/// increment to d. `damping_loss` = 1 - e^(-c h); `gravity_step` = phi h^2 g; `force_step` = phi h^2 / m.
SHARED vec3 verlet_increment(vec3 displacement, vec3 gravity_step, vec3 force, float inverse_mass, float force_step,
                             float damping_loss) {
    precise vec3 forced = gravity_step + force * (inverse_mass * force_step);
    precise vec3 increment = forced - displacement * damping_loss;
    return increment;
}

/// Returns the part of a particle's increment that counts. Right after its release, the `mark` beside its displacement
/// is minus that share (pin.h); otherwise it is not below 0.
SHARED vec3 released_increment(vec3 increment, float mark) {
    if (!(mark < 0.0f)) return increment;
    precise vec3 counted = increment * -mark;
    return counted;
}

/// Returns the share q of a step that the wind's drag takes away. The wind's force follows the step's own change of
/// velocity, F' = F - k (d' - d), so that no wind is too strong for a step: d' - d = increment/(1 + x) = increment (1 -
/// q), x = w k phi h^2/m. `drag`: k, N/m (wind.h); `force_step`: phi h^2/m.
SHARED float drag_loss(float drag, float inverse_mass, float force_step) {
    precise float loss = 1.0f - 1.0f / (1.0f + drag * (inverse_mass * force_step));
    return loss;
}

SHARED vec3 dragged_increment(vec3 increment, float loss) {
    precise vec3 dragged = increment - increment * loss;
    return dragged;
}

/// Returns the inverse mass on which springs and bending act in a step with drag. Drag resists them as it resists the
/// prediction, so that cloth that they hold at rest in the wind feels its full force.
SHARED float dragged_weight(float inverse_mass, float loss) {
    precise float weight = inverse_mass - inverse_mass * loss;
    return weight;
}

#endif
