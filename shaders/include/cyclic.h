// Tridiagonal systems by parallel cyclic reduction (Hockney 1965; every row at once: Hockney and Jesshope 1981,
// "Parallel Computers", 5.4.3; on GPUs Zhang, Cohen and Owens 2010, "Fast Tridiagonal Solvers on the GPU"). A row
// couples its unknown to those `distance` before and after it:
//   (shift + |before| + |after|) x_i = before x_(i - distance) + after x_(i + distance) + right.
// Inserting its two neighbours' equations doubles the distance, until nothing is left to couple to. The systems of
// line.h are written so that the shift, the rest of a diagonal, is a sum of positive terms throughout: nothing cancels,
// however stiff the line is.
#ifndef DRAPE_CYCLIC_H
#define DRAPE_CYCLIC_H

#include "include/line.h"

struct CyclicRow {
    float shift;          // > 0
    float before, after;  // each has the sign with which that neighbour couples back
    vec3 right;
};

/// Returns the row of a particle or spring that does not exist; its solution is x = 0.
SHARED CyclicRow no_cyclic_row() { return CyclicRow(1.0f, 0.0f, 0.0f, vec3(0.0f, 0.0f, 0.0f)); }

SHARED float cyclic_diagonal(CyclicRow row) {
    precise float diagonal = row.shift + (abs(row.before) + abs(row.after));
    return diagonal;
}

/// Returns a row after its two neighbours' unknowns were eliminated from it.
SHARED CyclicRow reduced_row(CyclicRow row, CyclicRow before, CyclicRow after) {
    precise float by_before = row.before / cyclic_diagonal(before);
    precise float by_after = row.after / cyclic_diagonal(after);
    precise float shift = row.shift + (abs(by_before) * before.shift + abs(by_after) * after.shift);
    precise vec3 right = row.right + (before.right * by_before + after.right * by_after);
    precise float farther_before = by_before * before.before;
    precise float farther_after = by_after * after.after;
    return CyclicRow(shift, farther_before, farther_after, right);
}

/// Returns x of a row that is coupled to no other any more.
SHARED vec3 cyclic_solution(CyclicRow row) {
    precise vec3 solution = row.right / cyclic_diagonal(row);
    return solution;
}

/// Returns the row of a particle in the first system, between the springs before and after it, as in
/// eliminate_particle.
SHARED CyclicRow particle_row(vec3 edge_before, float stiffness_before, vec3 edge_after, float stiffness_after,
                              float weight) {
    precise float before = weight * stiffness_before;
    precise float after = weight * stiffness_after;
    precise vec3 pull = edge_after * after - edge_before * before;
    return CyclicRow(1.0f, before, after, pull);
}

/// Returns the share of a spring's own pull on a particle that its neighbour on the line does not take over.
SHARED float turned_share(float cosine) {
    precise float left = 1.0f - abs(cosine);
    return left > 0.0f ? left : 0.0f;
}

/// Returns the row of a spring in the second system, as in eliminate_spring, with the change of its multiplier in
/// `right.x`.
SHARED CyclicRow spring_row(vec3 normal_before, LineSpring spring, vec3 normal_after, float weight_first,
                            float weight_second, float share, float compression, float compliance, float tension) {
    float acting = acting_share(share, compression, spring.excess);
    float cosine_before = ordered_dot(normal_before, spring.normal);
    float cosine_after = ordered_dot(spring.normal, normal_after);
    precise float first = acting * weight_first;
    precise float second = acting * weight_second;
    precise float shift = (first * turned_share(cosine_before) + second * turned_share(cosine_after)) + compliance;
    precise float before = first * cosine_before;
    precise float after = second * cosine_after;
    precise float right = -(share * (balancing_tension(spring.excess, compression) - tension));
    if (!pulls(spring, share)) return no_cyclic_row();
    return CyclicRow(shift, before, after, vec3(right, 0.0f, 0.0f));
}

#endif
