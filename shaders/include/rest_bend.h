// The difference that a bending element has at rest, where a cloth rests in the shape that it starts in: that of the
// start, turned as the cloth has turned there. Energies are b/2 |d - D|^2 with this D (docs/physics.md 4).
#ifndef DRAPE_REST_BEND_H
#define DRAPE_REST_BEND_H

#include "include/vector.h"

/// Directions in which column and row grow at a place of the cloth, m.
struct Tangents {
    vec3 row, column;
};

/// Unit vectors of tangents: along the row, along the normal and across the two; all zero where they span no plane.
struct SheetFrame {
    vec3 along, normal, across;
};

SHARED SheetFrame sheet_frame(Tangents tangents) {
    vec3 normal = ordered_cross(tangents.row, tangents.column);
    float row_squared = ordered_dot(tangents.row, tangents.row), normal_squared = ordered_dot(normal, normal);
    precise float least = 1.0e-8f * (row_squared * ordered_dot(tangents.column, tangents.column));
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    if (!(normal_squared > least)) return SheetFrame(none, none, none);
    precise vec3 along = tangents.row * reciprocal(sqrt(row_squared));
    precise vec3 upright = normal * reciprocal(sqrt(normal_squared));
    return SheetFrame(along, upright, ordered_cross(upright, along));
}

/// Returns a difference (m) of the shape at rest, turned as the tangents have turned since.
SHARED vec3 turned_difference(vec3 difference, Tangents rest, Tangents now) {
    SheetFrame from = sheet_frame(rest), to = sheet_frame(now);
    precise vec3 turned = to.along * ordered_dot(difference, from.along) +
                          to.normal * ordered_dot(difference, from.normal) +
                          to.across * ordered_dot(difference, from.across);
    return turned;
}

#endif
