// The implicit bending of a whole line of particles (docs/solvers.md, "Bending along lines"), together with the tension
// that the line carries. It minimises, over the changes y_i of the displacements,
//   sum y_i^2/(2 w_i) + sum g_i/2 |e_i + t_i|^2 + sum kappa_i/2 |c_i + t_i - t_(i-1)|^2,   t_i = y_(i+1) - y_i,
// where e are the edges, c_i = e_i - e_(i-1) the second differences, g and kappa the geometric and the bending
// stiffness in units of the inner particle's mass over the substep's length squared. Eliminated as bands are, this
// pentadiagonal system loses kappa digits, since inertia is the difference of large numbers. Here the eliminated part
// keeps the form of an energy of the next particle's y and the next edge's t, and all sums are of terms of one sign.
#ifndef DRAPE_BENT_LINE_H
#define DRAPE_BENT_LINE_H

#include "include/bend.h"

/// Energy of the eliminated part: (shift |y|^2 + 2 coupling y.t + turning |t|^2)/2 + pull.y + moment.t; coupling <= 0.
struct BentLine {
    float shift, coupling, turning;
    float determinant;  // shift turning - coupling^2
    vec3 pull, moment;
};

/// Returns the line before its first particle, which has no energy.
SHARED BentLine unbent_line() {
    return BentLine(0.0f, 0.0f, 0.0f, 0.0f, vec3(0.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 0.0f));
}

/// A particle that was eliminated, with t = turn + by_turn t_next + by_shift y_next, and the line that includes it.
struct BentParticle {
    vec3 turn;
    float by_turn, by_shift;
    BentLine line;
};

/// Returns kappa of the element of two springs; it is `bend` where both have their full share.
SHARED float element_bend(float bend, float share, float share_after) {
    precise float element = bend * bend_share(share, share_after);
    return element;
}

/// Eliminates the next particle, which lies between the eliminated edges and `edge`. `bend` belongs to the element of
/// `edge` and the edge after it, 0 at the line's end; `difference` is the element's c minus c at rest.
SHARED BentParticle eliminate_bent(BentLine line, vec3 edge, float stiffness, vec3 difference, float bend,
                                   float weight) {
    precise float turning = line.turning + stiffness;
    precise vec3 moment = line.moment + edge * stiffness;
    precise float shift = weight * line.shift + 1.0f;
    precise float determinant = weight * (line.determinant + line.shift * stiffness) + turning;
    precise float own = shift + weight * (turning - 2.0f * line.coupling);
    precise float coupled = shift - weight * line.coupling;
    precise float pivot = weight * bend + own;
    precise vec3 turn = (difference * bend + (line.pull - moment)) * (weight / pivot);
    precise float by_turn = (weight * bend) / pivot;
    precise float by_shift = coupled / pivot;
    precise float next_shift = (bend * shift + determinant) / pivot;
    precise float next_coupling = -(bend * coupled) / pivot;
    precise float next_turning = (bend * own) / pivot;
    precise float next_determinant = (bend * determinant) / pivot;
    precise vec3 next_pull =
        (line.pull * (weight * (bend + (turning - line.coupling))) + (moment - difference * bend) * coupled) / pivot;
    precise vec3 next_moment = (difference * own + (moment - line.pull) * weight) * (bend / pivot);
    return BentParticle(turn, by_turn, by_shift,
                        BentLine(next_shift, next_coupling, next_turning, next_determinant, next_pull, next_moment));
}

/// Eliminates the last particle, whose y_next is zero, into the same form.
SHARED BentParticle eliminate_last_bent(BentLine line, float weight) {
    precise vec3 turn = line.pull * (weight / (1.0f + weight * line.shift));
    return BentParticle(turn, 0.0f, 0.0f, line);
}

/// Back substitution: returns t of the edge after a particle, given t and y of what follows.
SHARED vec3 substitute_turn(vec4 turn_by_turn, float by_shift, vec3 turn_after, vec3 delta_after) {
    precise vec3 turn =
        vec3(turn_by_turn.x, turn_by_turn.y, turn_by_turn.z) + turn_after * turn_by_turn.w + delta_after * by_shift;
    return turn;
}

/// Back substitution: returns y of the particle before the edge whose t is `turn`.
SHARED vec3 bent_delta(vec3 delta_after, vec3 turn) {
    precise vec3 delta = delta_after - turn;
    return delta;
}

#endif
