// Lines that bend (bent_line.h) by parallel cyclic reduction. Their pentadiagonal system couples blocks of two
// neighbouring particles to the blocks beside them only. A block's unknowns are u = (y, t), the change y of its first
// particle's displacement and that t of the edge between its two. With the blocks `distance` before and after it a row
// is
//   rigid u_i + before (u_(i - distance) - T(-apart) u_i) + after (u_(i + distance) - T(apart) u_i) = right,
// where T(apart) (y, t) = (y + apart t, t) moves a block's unknowns by `apart` = 2 distance particles as a rigid bar
// would. Bending resists no motion of a rigid bar, so `rigid` is what inertia and tension make of one, and reduction
// takes in those of other blocks alone: as cyclic.h's shift, it loses nothing to what is stiff.
#ifndef DRAPE_CYCLIC_BENT_H
#define DRAPE_CYCLIC_BENT_H

#include "include/bent_line.h"

struct BentRow {
    vec2 before, rigid, after;
    vec3 right;
};

/// The two rows of a block.
struct BentBlock {
    BentRow first, second;
};

/// Returns the row of a particle that does not exist; it gives y = 0 for a block's first particle and t = 0 for its
/// second.
SHARED BentRow no_bent_row(bool is_second) {
    return BentRow(vec2(0.0f, 0.0f), is_second ? vec2(0.0f, 1.0f) : vec2(1.0f, 0.0f), vec2(0.0f, 0.0f),
                   vec3(0.0f, 0.0f, 0.0f));
}

/// A spring that a particle's row reads: its edge, geometric stiffness and share, all zero if the spring does not
/// exist.
struct BentSpring {
    vec3 edge;
    float stiffness, share;
};

/// The second differences at rest of the elements around the previous particle, this one and the next one, m.
struct BentTargets {
    vec3 first, middle, third;
};

/// Returns the row of a particle between the two springs before it and the two after it.
SHARED BentRow bent_row(BentSpring far_before, BentSpring before, BentSpring after, BentSpring far_after,
                        BentTargets targets, float bend, float weight, bool is_second) {
    float first = element_bend(bend, far_before.share, before.share);
    float middle = element_bend(bend, before.share, after.share);
    float third = element_bend(bend, after.share, far_after.share);
    vec3 first_difference = beyond_rest(second_difference(-far_before.edge, before.edge), targets.first);
    vec3 difference = beyond_rest(second_difference(-before.edge, after.edge), targets.middle);
    vec3 third_difference = beyond_rest(second_difference(-after.edge, far_after.edge), targets.third);
    precise vec3 tension = after.edge * after.stiffness - before.edge * before.stiffness;
    precise vec3 bending = difference * (2.0f * middle) - (first_difference * first + third_difference * third);
    precise vec3 right = (tension + bending) * weight;
    // The couplings to the particles two and one before and two after, and the sums of pairs of them.
    precise float far_before_by = weight * first;
    precise float before_by = -(weight * (before.stiffness + 2.0f * (first + middle)));
    precise float both_before = -(weight * (before.stiffness + (first + 2.0f * middle)));
    precise float both_after = -(weight * (after.stiffness + (third + 2.0f * middle)));
    precise float far_after_by = weight * third;
    precise float turn = weight * (before.stiffness - after.stiffness);
    precise float second_turn = 1.0f + turn;
    if (is_second)
        return BentRow(vec2(far_before_by, far_before_by), vec2(1.0f, second_turn), vec2(both_after, far_after_by),
                       right);
    return BentRow(vec2(both_before, before_by), vec2(1.0f, turn), vec2(far_after_by, 0.0f), right);
}

/// Returns the coefficients of a row for its own block's unknowns when the neighbouring blocks do not move.
SHARED vec2 own_part(BentRow row, float apart) {
    precise float of_change = row.rigid.x - (row.before.x + row.after.x);
    precise float of_turn = (row.rigid.y - (row.before.y - apart * row.before.x)) - (row.after.y + apart * row.after.x);
    return vec2(of_change, of_turn);
}

/// Returns the weights of the rows `first` and `second` that add up to `row`.
SHARED vec2 weights_of(vec2 row, vec2 first, vec2 second) {
    precise float per_determinant = 1.0f / (first.x * second.y - first.y * second.x);
    precise float weight_first = (row.x * second.y - row.y * second.x) * per_determinant;
    precise float weight_second = (row.y * first.x - row.x * first.y) * per_determinant;
    return vec2(weight_first, weight_second);
}

SHARED vec2 weighted_sum(vec2 weights, vec2 first, vec2 second) {
    precise float x = weights.x * first.x + weights.y * second.x;
    precise float y = weights.x * first.y + weights.y * second.y;
    return vec2(x, y);
}

SHARED vec3 weighted_right(vec2 weights, BentBlock block) {
    precise vec3 right = block.first.right * weights.x + block.second.right * weights.y;
    return right;
}

/// Returns a row after the unknowns of the blocks `distance` before and after its own were eliminated from it.
SHARED BentRow reduced_bent_row(BentRow row, BentBlock before, BentBlock after, int distance) {
    float apart = float(2 * distance);
    vec2 by_before = weights_of(row.before, own_part(before.first, apart), own_part(before.second, apart));
    vec2 by_after = weights_of(row.after, own_part(after.first, apart), own_part(after.second, apart));
    vec2 rigid_before = weighted_sum(by_before, before.first.rigid, before.second.rigid);
    vec2 rigid_after = weighted_sum(by_after, after.first.rigid, after.second.rigid);
    vec2 farther_before = weighted_sum(by_before, before.first.before, before.second.before);
    vec2 farther_after = weighted_sum(by_after, after.first.after, after.second.after);
    precise float rigid_x = row.rigid.x - (rigid_before.x + rigid_after.x);
    precise float rigid_y =
        row.rigid.y - ((rigid_before.y - apart * rigid_before.x) + (rigid_after.y + apart * rigid_after.x));
    precise vec3 right = row.right - (weighted_right(by_before, before) + weighted_right(by_after, after));
    return BentRow(vec2(-farther_before.x, -farther_before.y), vec2(rigid_x, rigid_y),
                   vec2(-farther_after.x, -farther_after.y), right);
}

/// Returns y of a block's first or second particle, when the block's rows are coupled to no other block any more.
SHARED vec3 bent_solution(BentBlock block, bool is_second) {
    vec2 weights = weights_of(is_second ? vec2(1.0f, 1.0f) : vec2(1.0f, 0.0f), block.first.rigid, block.second.rigid);
    return weighted_right(weights, block);
}

#endif
