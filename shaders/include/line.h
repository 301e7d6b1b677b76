// Line solve (docs/solvers.md, "Implicit tension"): the springs of one whole line of particles (a row, a column, a
// diagonal) are projected together, their tension implicit, in two tridiagonal systems, each solved by the Thomas
// algorithm:
// 1. The tension T that the springs carried through the last substep resists sideways motion with the geometric
//    stiffness g = T/length (Tournier et al. 2015, "Stable Constrained Dynamics"): (1 + w sum g) delta = -w sum g x.
//    Its unknown is the change of every particle's displacement.
// 2. From there one Newton step of XPBD (Macklin et al. 2016, eq. 18 as a system) finds the change of the multiplier of
//    every spring e, between the particles e and e + 1 of the line.
#ifndef DRAPE_LINE_H
#define DRAPE_LINE_H

#include "include/spring.h"

/// Returns the first particle (column, row) of a line: rows start in column 0, all others in row 0.
SHARED ivec2 line_start(int line, ivec2 step) { return step.y == 0 ? ivec2(0, line) : ivec2(line, 0); }

SHARED ivec2 line_end(int line, ivec2 step, int count, int columns) {
    ivec2 start = line_start(line, step);
    int x = start.x + step.x * ((count - 1) % columns);
    return ivec2(x < 0 ? x + columns : x >= columns ? x - columns : x, start.y + step.y * (count - 1));
}

/// Returns the particle `step` further along a line. Columns wrap around, so that the diagonals are as many closed
/// lines as the grid has columns and every particle lies on exactly one. The spring across the seam does not exist.
SHARED ivec2 next_on_line(ivec2 particle, ivec2 step, int columns) {
    int x = particle.x + step.x;
    return ivec2(x < 0 ? columns - 1 : x == columns ? 0 : x, particle.y + step.y);
}

// Values are selected, not branched on: the default device would run both branches anyway, under masks.

/// A spring in the second system: its unit edge, its length and how far it is too long, m. The normal is zero where the
/// edge has no direction; such a spring pulls on nothing.
struct LineSpring {
    vec3 normal;
    float current;
    float excess;
};

SHARED LineSpring line_spring(vec3 edge, float rest_length) {
    precise float length_squared = ordered_dot(edge, edge);
    precise float current = sqrt(length_squared);
    precise vec3 normal = edge * reciprocal(current);
    precise float excess = current - rest_length;
    bool directed = length_squared > 0.0f;
    return LineSpring(directed ? normal : vec3(0.0f, 0.0f, 0.0f), directed ? current : 0.0f, directed ? excess : 0.0f);
}

/// Returns a tension in the solve's own units, an extension by the compliance in use (m). It is stored as an extension
/// by the scene's compliance, which neither the order nor the length of a substep changes; `per_followed` is the
/// compliance in use divided by the scene's.
SHARED float tension_in_use(float stored, float per_followed) {
    precise float tension = stored * per_followed;
    return tension;
}

/// `followed`: the scene's compliance divided by the one in use.
SHARED float stored_tension(float tension, float followed) {
    precise float stored = tension * followed;
    return stored;
}

/// Returns the last substep's tension (an extension by the compliance in use, m) per length of the spring at the start
/// of the substep. Compressed springs carry no tension over, and the bound by L makes collapsed starts safe.
SHARED float tension_per_length(float tension, vec3 start_edge, float rest_length) {
    precise float current = sqrt(ordered_dot(start_edge, start_edge));
    precise float per_length = tension / (current > rest_length ? current : rest_length);
    return tension > 0.0f ? per_length : 0.0f;
}

/// Returns g of a spring, dimensionless, in units of the inner particle's mass divided by the square of the substep's
/// length. `per_compliance`: 1/alpha.
SHARED float geometric_stiffness(float tension_per_length, float share, float per_compliance) {
    precise float stiffness = (share * tension_per_length) * per_compliance;
    return stiffness;
}

/// A particle eliminated from the first system: delta_i = row.xyz + row.w delta_(i+1). `left` is 1 - row.w, stored
/// because for a stiff line the difference would lose its digits.
struct EliminatedParticle {
    vec4 row;
    float left;
};

/// Returns the particle before a line's first, which does not move; the elimination begins with it.
SHARED EliminatedParticle unmoved_start() { return EliminatedParticle(vec4(0.0f, 0.0f, 0.0f, 0.0f), 1.0f); }

/// Eliminates particle i from the first system, between the springs `before` and `after` it,
///   (1 + w (g_(i-1) + g_i)) delta_i - w g_(i-1) delta_(i-1) - w g_i delta_(i+1) = w (g_i e_i - g_(i-1) e_(i-1)).
/// g is zero beyond the ends.
SHARED EliminatedParticle eliminate_particle(EliminatedParticle previous, vec3 edge_before, float stiffness_before,
                                             vec3 edge_after, float stiffness_after, float weight) {
    precise float before = weight * stiffness_before;
    precise float after = weight * stiffness_after;
    precise float kept = 1.0f + before * previous.left;
    precise float per_pivot = reciprocal(kept + after);
    vec3 reduced_before = vec3(previous.row.x, previous.row.y, previous.row.z);
    precise vec3 pull = edge_after * after - (edge_before - reduced_before) * before;
    precise vec3 reduced = pull * per_pivot;
    precise float upper = after * per_pivot;
    precise float left = kept * per_pivot;
    return EliminatedParticle(vec4(reduced.x, reduced.y, reduced.z, upper), left);
}

/// Back substitution: returns delta of a particle from that of the particle after it.
SHARED vec3 substitute_particle(vec4 eliminated, vec3 delta_after) {
    precise vec3 delta = vec3(eliminated.x, eliminated.y, eliminated.z) + delta_after * eliminated.w;
    return delta;
}

/// Returns the tension (m) of a spring after the first system, which turned the spring and made it longer.
SHARED float filtered_tension(float tension_per_length, LineSpring spring) {
    precise float tension = tension_per_length * spring.current;
    return tension;
}

/// Returns whether a spring takes part in its line's system: it exists and has a direction.
SHARED bool pulls(LineSpring spring, float share) {
    return share > 0.0f && (spring.normal.x != 0.0f || spring.normal.y != 0.0f || spring.normal.z != 0.0f);
}

/// Returns |C - T| (m), the violation that the solve has to remove, or `largest` if that is larger. At a lone pin of a
/// fine grid C alone is large at rest, which is no error, since the spring's tension explains it.
SHARED float larger_violation(float largest, LineSpring spring, float share, float compression, float tension) {
    precise float unexplained = abs(balancing_tension(spring.excess, compression) - tension);
    return pulls(spring, share) && unexplained > largest ? unexplained : largest;
}

/// Returns whether a line is wrong: its largest |C - T| exceeds line_violation_limit rest lengths.
SHARED bool line_is_wrong(float largest, float rest_length) {
    precise float violation = largest / rest_length;
    return violation > line_violation_limit;
}

/// Eliminates row e of the second system
///   a_e x_(e-1) + b_e x_e + c_e x_(e+1) = -(C_e - T_e),
///   a_e = -w_e n_(e-1).n_e,  b_e = w_e + w_(e+1) + alpha/s,  c_e = -w_(e+1) n_e.n_(e+1).
/// Every row is multiplied by s = `share` (in [0, 1]; 0 = no spring: x_e = 0), of which a spring pushed together keeps
/// `compression`; C stands for f(C) (project_spring). The elimination starts at the line's end, where the first
/// system's substitution starts too: `previous`, of spring e + 1, and the result are (a', d') of x_e = d' - a' x_(e-1).
/// `weight_*`: relative inverse masses of the spring's ends; `compliance` alpha > 0; `tension`: T, m.
SHARED vec2 eliminate_spring(vec2 previous, vec3 normal_before, LineSpring spring, vec3 normal_after,
                             float weight_first, float weight_second, float share, float compression, float compliance,
                             float tension) {
    float acting = acting_share(share, compression, spring.excess);
    precise float before = -(acting * weight_first) * ordered_dot(normal_before, spring.normal);
    precise float after = -(acting * weight_second) * ordered_dot(spring.normal, normal_after);
    precise float diagonal = acting * (weight_first + weight_second) + compliance;
    precise float right = -(share * (balancing_tension(spring.excess, compression) - tension));
    precise float per_pivot = reciprocal(diagonal - after * previous.x);
    precise float lower = before * per_pivot;
    precise float reduced = (right - after * previous.y) * per_pivot;
    return pulls(spring, share) ? vec2(lower, reduced) : vec2(0.0f, 0.0f);
}

/// Forward substitution: returns the change of a spring's multiplier from that of the spring before it.
SHARED float substitute_spring(vec2 eliminated, float change_before) {
    precise float change = eliminated.y - eliminated.x * change_before;
    return change;
}

/// Returns the correction of the particle between two springs of a line; the caller multiplies it by the particle's w.
SHARED vec3 line_correction(vec3 normal_before, float change_before, vec3 normal_after, float change_after) {
    precise vec3 correction = normal_before * change_before - normal_after * change_after;
    return correction;
}

/// Returns the displacement after both systems. Their changes are summed before they are rounded with the displacement.
SHARED vec3 moved_by_both(vec3 displacement, vec3 delta, vec3 correction, float weight) {
    precise vec3 moved = displacement + (delta + correction * weight);
    return moved;
}

/// Returns alpha/s of a spring.
SHARED float shared_compliance(float compliance, float share) {
    precise float shared_out = compliance / share;
    return shared_out;
}

#ifndef __cplusplus
/// alpha/s is computed by a division only where springs may have different shares.
#define SPRING_COMPLIANCE(line, share) (masked ? shared_compliance((line).compliance, share) : (line).shared_compliance)
#endif

/// Returns the tension (m) of a spring whose multiplier changed; 0 where the spring does not exist. `compliance`:
/// alpha/s.
SHARED float changed_tension(float tension, float change, float share, float compliance) {
    precise float updated = tension - compliance * change;
    return share > 0.0f ? updated : 0.0f;
}

#endif
