// Rules out pairs of cells, in a patch of 3 x 3, that cannot touch in a substep because the cloth between them keeps
// them apart. Such pairs are most of those whose boxes meet, wherever the cloth is bent or lies aslant to the axes. A
// pair that is ruled out here would not be listed (self_listed_pair), so leaving it out changes no bit. Primitives of a
// grid that share no corner have their corners on two sides of a column, a row or a diagonal.
#ifndef DRAPE_SELF_RING_H
#define DRAPE_SELF_RING_H

#include "include/self_contact.h"

/// The particles of a column, from the first row on.
struct SelfColumn {
    vec3 a, b, c, d;
};

/// The particles of a patch, from the first column on.
struct SelfColumns {
    SelfColumn a, b, c, d;
};

/// The largest motions of a patch's particles in its plane and across it, and the largest height of a particle across
/// it, m.
struct SelfPlay {
    float within, across, height;
};

SHARED vec3 self_column_sum(SelfColumn x) {
    precise vec3 sum = ((x.a + x.b) + x.c) + x.d;
    return sum;
}

SHARED SelfColumn self_columns_sum(SelfColumn x, SelfColumn y) {
    precise vec3 a = x.a + y.a;
    precise vec3 b = x.b + y.b;
    precise vec3 c = x.c + y.c;
    precise vec3 d = x.d + y.d;
    return SelfColumn(a, b, c, d);
}

SHARED float self_column_size(SelfColumn x) {
    return self_largest(self_largest(self_largest_coordinate(x.a), self_largest_coordinate(x.b)),
                        self_largest(self_largest_coordinate(x.c), self_largest_coordinate(x.d)));
}

SHARED vec3 self_unit(vec3 x) {
    precise float by = 1.0f / sqrt(self_squared(x));
    precise vec3 unit = x * by;
    return unit;
}

SHARED vec4 self_along(SelfColumn x, vec3 axis) {
    return vec4(ordered_dot(x.a, axis), ordered_dot(x.b, axis), ordered_dot(x.c, axis), ordered_dot(x.d, axis));
}

SHARED vec4 self_largest_by_row(vec4 a, vec4 b) {
    return vec4(self_largest(a.x, b.x), self_largest(a.y, b.y), self_largest(a.z, b.z), self_largest(a.w, b.w));
}
SHARED vec4 self_least_by_row(vec4 a, vec4 b) {
    return vec4(self_least(a.x, b.x), self_least(a.y, b.y), self_least(a.z, b.z), self_least(a.w, b.w));
}
SHARED float self_largest_of(vec4 x) { return self_largest(self_largest(x.x, x.y), self_largest(x.z, x.w)); }
SHARED float self_least_of(vec4 x) { return self_least(self_least(x.x, x.y), self_least(x.z, x.w)); }

/// Returns by row how far motions go along a normal, and the squares of how far they go in its plane.
SHARED vec4 self_across_by_row(SelfColumn motions, vec3 normal) {
    vec4 along = self_along(motions, normal);
    return vec4(abs(along.x), abs(along.y), abs(along.z), abs(along.w));
}
SHARED vec4 self_within_by_row(SelfColumn motions, vec3 normal) {
    return vec4(self_within(motions.a, normal), self_within(motions.b, normal), self_within(motions.c, normal),
                self_within(motions.d, normal));
}

SHARED SelfPlay self_play(SelfColumns x, SelfColumns motions, vec3 normal) {
    vec4 a = self_along(x.a, normal), b = self_along(x.b, normal), c = self_along(x.c, normal),
         d = self_along(x.d, normal);
    float upper = self_largest_of(self_largest_by_row(self_largest_by_row(a, b), self_largest_by_row(c, d)));
    float lower = self_least_of(self_least_by_row(self_least_by_row(a, b), self_least_by_row(c, d)));
    vec4 within = self_largest_by_row(
        self_largest_by_row(self_within_by_row(motions.a, normal), self_within_by_row(motions.b, normal)),
        self_largest_by_row(self_within_by_row(motions.c, normal), self_within_by_row(motions.d, normal)));
    vec4 across = self_largest_by_row(
        self_largest_by_row(self_across_by_row(motions.a, normal), self_across_by_row(motions.b, normal)),
        self_largest_by_row(self_across_by_row(motions.c, normal), self_across_by_row(motions.d, normal)));
    precise float height = upper - lower;
    precise float most_within = sqrt(self_largest(self_largest_of(within), 0.0f));
    return SelfPlay(most_within, self_largest_of(across), height);
}

/// Returns whether two cells at the distance `apart` along some direction contain no pair that must be listed. The line
/// between nearest points is at least that long; its normal leans out of the patch's plane by height / apart at most,
/// so corners come nearer along it by no more than their motion in the plane and that share of their motion across it:
///   apart > kept + 2 (within + across min(1, height / apart)), both sides times `apart`, so that nothing is divided.
SHARED bool self_clear(float apart, SelfPlay play, float kept) {
    precise float left = (apart * 0.999f - kept) - play.within * 2.002f;
    precise float leaning = (play.across * 2.002f) * self_least(apart, play.height);
    precise float surely = left * apart;
    return apart > 0.0f && left > 0.0f && surely > leaning;
}

/// Returns the distance between two groups, one of which reaches to a or b, while the other begins at c or d.
SHARED float self_between(float a, float b, float c, float d) {
    precise float apart = self_least(c, d) - self_largest(a, b);
    return apart;
}

/// The places of a patch's particles along a direction: by column, by row.
struct SelfSpread {
    vec4 a, b, c, d;
};
SHARED SelfSpread self_spread(SelfColumns x, vec3 axis) {
    return SelfSpread(self_along(x.a, axis), self_along(x.b, axis), self_along(x.c, axis), self_along(x.d, axis));
}
SHARED SelfSpread self_turned(SelfSpread x) {
    return SelfSpread(vec4(x.a.x, x.b.x, x.c.x, x.d.x), vec4(x.a.y, x.b.y, x.c.y, x.d.y),
                      vec4(x.a.z, x.b.z, x.c.z, x.d.z), vec4(x.a.w, x.b.w, x.c.w, x.d.w));
}

/// Returns bits of the pairs of cells that a gap between columns separates. Neighbours: the first column of the cell
/// from the rest of it and of the cell to its right (1); that of the cell below from the cell to the right (2). Pairs
/// two columns apart: in the same rows (4); with the second cell one row on (8) or back (16); or two (32, 64). Rows
/// work alike.
SHARED uint self_columns_clear(SelfSpread x, SelfPlay play, float kept) {
    float second = self_least(self_least(x.b.x, x.b.y), self_least(x.c.x, x.c.y));
    vec4 lower = self_largest_by_row(x.a, x.b), upper = self_least_by_row(x.c, x.d);
    return (self_clear(self_between(x.a.x, x.a.y, second, second), play, kept) ? 1u : 0u) |
           (self_clear(self_between(x.a.y, x.a.z, second, second), play, kept) ? 2u : 0u) |
           (self_clear(self_between(lower.x, lower.y, upper.x, upper.y), play, kept) ? 4u : 0u) |
           (self_clear(self_between(lower.x, lower.y, upper.y, upper.z), play, kept) ? 8u : 0u) |
           (self_clear(self_between(lower.y, lower.z, upper.x, upper.y), play, kept) ? 16u : 0u) |
           (self_clear(self_between(lower.x, lower.y, upper.z, upper.w), play, kept) ? 32u : 0u) |
           (self_clear(self_between(lower.z, lower.w, upper.x, upper.y), play, kept) ? 64u : 0u);
}

/// Returns bits of the pairs that a gap across the diagonal from the second column to the second row separates. The
/// cell itself: its first particle from the others (1). Its neighbours to the right (2), below (4) and past its last
/// corner (8): this particle, and those on the diagonal, from the neighbour's.
SHARED uint self_diagonal_clear(SelfSpread x, SelfPlay play, float kept_here, float kept) {
    float reached = self_largest(x.a.x, self_largest(x.b.x, x.a.y));
    float here = self_least(self_least(x.b.x, x.a.y), x.b.y), right = self_least(self_least(x.c.x, x.b.y), x.c.y),
          below = self_least(self_least(x.a.z, x.b.y), x.b.z),
          past = self_least(self_least(x.b.y, x.c.y), self_least(x.b.z, x.c.z));
    return (self_clear(self_between(x.a.x, x.a.x, here, here), play, kept_here) ? 1u : 0u) |
           (self_clear(self_between(reached, reached, right, right), play, kept_here) ? 2u : 0u) |
           (self_clear(self_between(reached, reached, below, below), play, kept_here) ? 4u : 0u) |
           (self_clear(self_between(reached, reached, past, past), play, kept) ? 8u : 0u);
}

SHARED SelfColumn self_column_from(SelfColumn x, vec3 from) {
    precise vec3 a = x.a - from;
    precise vec3 b = x.b - from;
    precise vec3 c = x.c - from;
    precise vec3 d = x.d - from;
    return SelfColumn(a, b, c, d);
}

/// Returns the bits of the pairs of self_close_pair that are ruled out. A patch over an edge of the cloth repeats its
/// last column or row.
SHARED uint self_close_apart(SelfContactPush push, SelfCloth cloth, SelfColumns at, SelfColumns motions) {
    // Coordinates relative to the first particle are small.
    SelfColumns x = SelfColumns(self_column_from(at.a, at.a.a), self_column_from(at.b, at.a.a),
                                self_column_from(at.c, at.a.a), self_column_from(at.d, at.a.a));
    SelfColumn first = self_columns_sum(x.a, x.b), last = self_columns_sum(x.c, x.d);
    precise vec3 on_columns = self_column_sum(last) - self_column_sum(first);
    precise vec3 on_rows = ((first.c + first.d) + (last.c + last.d)) - ((first.a + first.b) + (last.a + last.b));
    vec3 columns = self_unit(on_columns), rows = self_unit(on_rows);
    precise vec3 across = columns * cloth.spacing.y + rows * cloth.spacing.x;
    SelfPlay play = self_play(x, motions, self_unit(ordered_cross(columns, rows)));
    float farthest = self_largest(self_largest(self_column_size(at.a), self_column_size(at.b)),
                                  self_largest(self_column_size(at.c), self_column_size(at.d)));
    precise float half_flat = cloth.least_flat * 0.5001f;
    precise float slack = cloth.thickness * self_listed_share;
    precise float doubt = self_doubt(farthest) * 4.0f + push.least;
    precise float kept = cloth.thickness + doubt;
    // Primitives that only a diagonal separates, except past the last corner, are this far apart in the flat cloth.
    precise float kept_here = self_largest(self_least(cloth.thickness, half_flat), slack) + doubt;
    uint by_columns = self_columns_clear(self_spread(x, columns), play, kept),
         by_rows = self_columns_clear(self_turned(self_spread(x, rows)), play, kept),
         by_diagonal = self_diagonal_clear(self_spread(x, self_unit(across)), play, kept_here, kept);
    // Neighbours need all gaps that separate some of their primitives; other pairs need only one.
    uint bits = (by_diagonal & 1u) | (by_diagonal & 2u & (by_columns << 1)) | (by_diagonal & 4u & (by_rows << 2)) |
                (by_diagonal & 8u) | ((by_columns & by_rows & 2u) << 3);
    return bits | ((by_columns & 0x7cu) << 3) | ((by_rows & 0x60u) << 3) | ((by_rows & 0x1cu) << 8);
}

#endif
