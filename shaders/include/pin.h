// The displacement of a held particle, and the start of a released one. A pin that takes particles holds them from the
// start of a substep on, wherever they are; their velocity is over.
//
// A pin lets go at the start t of a substep, where its particle moves with v; by the substep's end it has moved by h v
// + h^2 a/2. Verlet's d' = d + h^2 a, from the d of a substep that ends at t, gives that when d = h v - h^2 a/2: the
// force that the pin takes back acts for half a substep, as at the start of a run (docs/physics.md 3). If it was
// released earlier, at t' within the substep before, that force acts for (t - t')/h more. So the share 1/2 + (t - t')/h
// of the first increment counts, and h v - d, known only when the position has advanced by d, goes into the sum's
// remainder. Where springs act after the prediction, their share is taken back from their tension of the substep
// before: the pin bore the whole cloth, which would else fall as if from half a substep earlier. (Relaxation of rigid
// springs has no tension and falls so.) BDF2 cannot look back over the release: it takes backward Euler substeps, which
// are Verlet's, until its history begins after it.
#ifndef DRAPE_PIN_H
#define DRAPE_PIN_H

#include "include/spring.h"

/// Returns the place to which a held pin takes a rest position; for a released pin, h times the velocity that it had
/// there.
SHARED vec3 pin_target(PinMotion motion, vec3 rest) {
    vec3 row_x = vec3(motion.row_x.x, motion.row_x.y, motion.row_x.z);
    vec3 row_y = vec3(motion.row_y.x, motion.row_y.y, motion.row_y.z);
    vec3 row_z = vec3(motion.row_z.x, motion.row_z.y, motion.row_z.z);
    precise vec3 target = vec3(ordered_dot(row_x, rest) + motion.row_x.w, ordered_dot(row_y, rest) + motion.row_y.w,
                               ordered_dot(row_z, rest) + motion.row_z.w);
    return target;
}

/// Returns whether the pin holds, or lets go, the particle at this column and row of its list.
SHARED bool is_pinned(PinMotion motion, ivec2 place) {
    return place.x >= motion.box.x && place.y >= motion.box.y && place.x <= motion.box.z && place.y <= motion.box.w;
}

/// Returns the displacement of a held particle: from `position` to where its pin moves its rest position, or, where the
/// pin took it as it was, with the pin.
SHARED vec3 pin_displacement(PinMotion motion, vec3 rest, vec3 position) {
    if (motion.held.z != 0.0f) return pin_target(motion, position);
    precise vec3 moved = pin_target(motion, rest) - position;
    return moved;
}

/// Returns the share of the first increment that counts in addition to a whole one: (t - t')/h - 1/2.
SHARED float release_surplus(PinMotion motion) {
    precise float surplus = motion.held.y - 0.5f;
    return surplus;
}

/// Returns the mark that a particle just released has beside its displacement, in the place of the share that drag
/// took: minus the share of the particle's first increment that counts.
SHARED float release_mark(float surplus) {
    precise float mark = -(1.0f + surplus);
    return mark;
}

/// Returns `sum` plus a spring's pull on the particle where `edge` starts. `tension` is an extension of the spring's
/// full `stiffness` k h^2/m_inner.
SHARED vec3 add_tension_pull(vec3 sum, vec3 edge, float tension, float stiffness) {
    precise float squared = ordered_dot(edge, edge);
    if (!(squared > 0.0f)) return sum;
    precise vec3 total = sum + edge * (stiffness * tension / sqrt(squared));
    return total;
}

/// Returns the remainder of the displacement's sum after its first increment. `velocity_step`: h v - d; `pull`: the
/// displacement by which springs would move an inner particle in a substep, limited to `reach`: springs stretched to
/// many times their length, as strong wind with too few substeps leaves them, would throw the particle out of sight.
SHARED vec3 release_remainder(vec3 velocity_step, float weight, float surplus, vec3 pull, float reach) {
    precise vec3 pulled = pull * (weight * surplus);
    precise float far = sqrt(ordered_dot(pulled, pulled));
    if (far > reach) pulled = pulled * (reach / far);
    precise vec3 remainder = velocity_step + pulled;
    return remainder;
}

#endif
