// Tridiagonal systems in parts: some rows are eliminated one after the other, and cyclic reduction joins the rest (Wang
// 1981, "A Parallel Method for Tridiagonal Equations"; with reduction of what is left, as on GPUs: Zhang, Cohen and
// Owens 2010). The rows are those of cyclic.h; one that others take in is normalised, so that
//   x = before x_before + after x_after + right  and  shift + |before| + |after| = 1.
// Nothing cancels: shifts are sums of positive terms, and couplings that are joined have one sign.
#ifndef DRAPE_PART_ROWS_H
#define DRAPE_PART_ROWS_H

#include "include/cyclic.h"

SHARED CyclicRow normalised_row(CyclicRow row) {
    precise float per = 1.0f / cyclic_diagonal(row);
    precise float shift = row.shift * per;
    precise float before = row.before * per;
    precise float after = row.after * per;
    precise vec3 right = row.right * per;
    return CyclicRow(shift, before, after, right);
}

/// Returns a row after the unknown before it was eliminated with that unknown's normalised row.
SHARED CyclicRow without_before(CyclicRow row, CyclicRow eliminated) {
    precise float before = row.before * eliminated.before;
    precise float shift = row.shift + abs(row.before) * eliminated.shift;
    precise vec3 right = row.right + eliminated.right * row.before;
    return CyclicRow(shift, before, row.after, right);
}

/// Returns a row after the unknown after it was eliminated in the same way.
SHARED CyclicRow without_after(CyclicRow row, CyclicRow eliminated) {
    precise float after = row.after * eliminated.after;
    precise float shift = row.shift + abs(row.after) * eliminated.shift;
    precise vec3 right = row.right + eliminated.right * row.after;
    return CyclicRow(shift, row.before, after, right);
}

/// Returns a normalised row after the unknown after it was eliminated; that unknown's normalised row has the same
/// unknown before it.
SHARED CyclicRow joined_row(CyclicRow row, CyclicRow after) {
    precise float shift = row.shift + abs(row.after) * after.shift;
    precise float before = row.before + row.after * after.before;
    precise float farther = row.after * after.after;
    precise vec3 right = row.right + after.right * row.after;
    return CyclicRow(shift, before, farther, right);
}

/// Returns x of a normalised row between two known unknowns.
SHARED vec3 part_solution(CyclicRow row, vec3 before, vec3 after) {
    precise vec3 solution = before * row.before + (after * row.after + row.right);
    return solution;
}

#endif
