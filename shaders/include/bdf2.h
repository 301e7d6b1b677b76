// BDF2 in displacement form (docs/solvers.md, "Line solve"); the backward Euler step (Verlet's, verlet.h, with implicit
// springs) that replaces it where the history cannot be trusted; and the control that decides which of the two a
// substep is. Beside its position, a particle's state is d, the displacement of the substep, d_before, that of the
// substep before, and `excess` = u - d = (d - d_before)/2, where u is h times the velocity at the substep's end and d
// is h times its mean (under damping a share of it: end_velocity.h). These small numbers are stored and added, so no
// digits are lost in d. Both steps, and changes between them, are exact in free flight.
#ifndef DRAPE_BDF2_H
#define DRAPE_BDF2_H

SHARED vec3 velocity_excess(vec3 displacement, vec3 displacement_before) {
    precise vec3 excess = (displacement - displacement_before) * 0.5f;
    return excess;
}

/// Returns h^2 times the acceleration by gravity and a force, weighted by the method.
SHARED vec3 forced_step(vec3 gravity_step, vec3 force, float inverse_mass, float force_step) {
    precise vec3 forced = gravity_step + force * (inverse_mass * force_step);
    return forced;
}

/// Returns d* - d, where x* = (4 x_n - x_(n-1))/3 + f [(8/9) u_n - (2/9) u_(n-1) + (4/9) h^2 a], f = 1/(1 + (2/3) c h):
///   d* - d = f [(2/9) ((d - d_before) - excess_before) + (8/9) excess] - (2/3) (1 - f) d + f (4/9) h^2 a.
/// `forced` = f (4/9) h^2 a, `old_weight` = f 2/9, `new_weight` = f 8/9, `loss` = (2/3) (1 - f). The caller corrects
/// the weights and the loss so that damped flight is exact (engine/cloth/method_line.cpp).
SHARED vec3 bdf2_increment(vec3 displacement, vec3 displacement_before, vec3 excess, vec3 excess_before, vec3 forced,
                           float old_weight, float new_weight, float loss) {
    precise vec3 change = ((displacement - displacement_before) - excess_before) * old_weight + excess * new_weight;
    precise vec3 increment = (change + forced) - displacement * loss;
    return increment;
}

/// Returns the drag k (N/m) of a BDF2 step, from that of a Verlet step. The force of a BDF2 step acts at its end, where
/// the velocity is (3 d' - d)/(2 h), but the wind's force was computed at d/h, so it changes by -2 k 3/2 (d' - d). A
/// Verlet step includes half of its change of velocity, that at its middle.
SHARED float bdf2_drag(float drag) {
    precise float bdf2 = 3.0f * drag;
    return bdf2;
}

/// The control's state, which is passed from a cloth's substep to the next, one integer per texel of the control image.
struct LineControl {
    uint order;        // order of this substep: 1 backward Euler, 2 BDF2; 0 before the first
    uint wrong_lines;  // lines of this substep that met a spring wrong by more than line_violation_limit
    uint hold;         // substeps that remain backward Euler, this one included
};

/// Returns the control of the next substep. The first substeps are backward Euler, since the history with which a cloth
/// starts does not include the forces that hold it. Substeps after one with more than `most_wrong` lines that had a
/// spring of |C - T|/L > line_violation_limit are backward Euler too, and so are those after something else set `hold`.
SHARED LineControl next_control(LineControl last, uint most_wrong) {
    uint hold = last.order == 0u ? line_hold_start : last.hold > 0u ? last.hold - 1u : 0u;
    if (last.wrong_lines > most_wrong) hold = line_hold_count;
    return LineControl(hold > 0u ? 1u : 2u, 0u, hold);
}

/// Returns the control of cloths that are sewn together, from that of some of them, `joint`, and of one more. A
/// backward Euler step has at once what an impulse gives to a particle, BDF2 over several, so cloths that differ would
/// lose momentum at their seam.
SHARED LineControl joined_control(LineControl joint, LineControl own, uint most_wrong) {
    uint hold = own.wrong_lines > most_wrong ? line_hold_count + 1u : own.hold;
    return LineControl(own.order, 0u, joint.hold > hold ? joint.hold : hold);
}

#endif
