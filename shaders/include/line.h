// Line solve: the springs of one whole line of particles (a row, a column, a diagonal) projected together. One Newton
// step of XPBD (Macklin et al. 2016, eq. 18 as a system) is tridiagonal along a line; the Thomas algorithm solves it.
// Unknown: the change of the multiplier of every spring e, between the particles e and e + 1 of the line.
#ifndef DRAPE_LINE_H
#define DRAPE_LINE_H

#include "include/spring.h"

/// First particle (column, row) of a line: rows start in column 0, all others in row 0.
SHARED ivec2 line_start(int line, ivec2 step) { return step.y == 0 ? ivec2(0, line) : ivec2(line, 0); }

/// The particle `step` further along a line; columns wrap around, so that the diagonals are as many closed lines as the
/// grid has columns and every particle lies on exactly one. The spring across the seam does not exist.
SHARED ivec2 next_on_line(ivec2 particle, ivec2 step, int columns) {
    int x = particle.x + step.x;
    return ivec2(x < 0 ? columns - 1 : x == columns ? 0 : x, particle.y + step.y);
}

/// What the system needs of a spring: its unit edge and how far it is too long, m. The normal is zero where there is no
/// direction: such a spring pulls on nothing.
struct LineSpring {
    vec3 normal;
    float excess;
};

SHARED LineSpring line_spring(vec3 edge, float rest_length) {
    precise float length_squared = ordered_dot(edge, edge);
    if (!(length_squared > 0.0f)) return LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f);
    precise float current = sqrt(length_squared);
    precise vec3 normal = edge / current;
    precise float excess = current - rest_length;
    return LineSpring(normal, excess);
}

/// Whether a spring takes part in its line's system: it exists and has a direction.
SHARED bool pulls(LineSpring spring, float share) {
    return share > 0.0f && (spring.normal.x != 0.0f || spring.normal.y != 0.0f || spring.normal.z != 0.0f);
}

/// |C| (m), what the solve is asked to take back; `largest` or more.
SHARED float larger_excess(float largest, LineSpring spring, float share) {
    if (!pulls(spring, share)) return largest;
    float excess = abs(spring.excess);
    return excess > largest ? excess : largest;
}

/// |C|/L of the line's worst spring, given its |C|.
SHARED float line_violation(float largest_excess, float rest_length) {
    precise float violation = largest_excess / rest_length;
    return violation;
}

/// Forward elimination of row e of the system
///   a_e x_(e-1) + b_e x_e + c_e x_(e+1) = -(C_e - T_e),
///   a_e = -w_e n_(e-1).n_e,  b_e = w_e + w_(e+1) + alpha/s,  c_e = -w_(e+1) n_e.n_(e+1),
/// every row times s = `share` (in [0, 1]; 0 = no spring: x_e = 0). `previous` and the result are (c', d') of
/// x_e = d' - c' x_(e+1). `weight_*`: relative inverse masses of the spring's ends; `compliance` alpha > 0; `tension`:
/// T = -alpha lambda/s as in project_spring, m.
SHARED vec2 eliminate_spring(vec2 previous, vec3 normal_before, LineSpring spring, vec3 normal_after,
                             float weight_first, float weight_second, float share, float compliance, float tension) {
    if (!pulls(spring, share)) return vec2(0.0f, 0.0f);
    precise float before = -(share * weight_first) * ordered_dot(normal_before, spring.normal);
    precise float after = -(share * weight_second) * ordered_dot(spring.normal, normal_after);
    precise float diagonal = share * (weight_first + weight_second) + compliance;
    precise float right = -(share * (spring.excess - tension));
    precise float pivot = diagonal - before * previous.x;
    precise float upper = after / pivot;
    precise float reduced = (right - before * previous.y) / pivot;
    return vec2(upper, reduced);
}

/// Back substitution: the change of a spring's multiplier from that of the spring after it.
SHARED float substitute_spring(vec2 eliminated, float change_after) {
    precise float change = eliminated.y - eliminated.x * change_after;
    return change;
}

/// Correction of the particle between two springs of a line, to be added times its w.
SHARED vec3 line_correction(vec3 normal_before, float change_before, vec3 normal_after, float change_after) {
    precise vec3 correction = normal_before * change_before - normal_after * change_after;
    return correction;
}

/// Tension (m) of a spring whose multiplier changed.
SHARED float changed_tension(float tension, float change, float share, float compliance) {
    if (!(share > 0.0f)) return tension;
    precise float updated = tension - (compliance / share) * change;
    return updated;
}

#endif
