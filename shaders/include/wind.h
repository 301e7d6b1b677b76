// Wind on a triangle and the normal of a cell (docs/physics.md 6).
#ifndef DRAPE_WIND_H
#define DRAPE_WIND_H

#include "include/vector.h"

/// Force (N) on a triangle of corners p0 p1 p2 (m) moving with mean velocity `velocity` (m/s) in wind `wind`:
/// F = rho A / 2 [(Cd - Cl)(v.n) v + Cl |v|^2 n], v = wind - velocity, n the unit normal turned so that
/// n.v > 0. A degenerate triangle (no area, no normal) feels nothing. Coefficients: rho (Cd - Cl)/2, rho Cl/2.
SHARED vec3 triangle_wind_force(vec3 p0, vec3 p1, vec3 p2, vec3 velocity, vec3 wind, float drag_coefficient,
                                float lift_coefficient) {
    precise vec3 doubled = ordered_cross(p1 - p0, p2 - p0);
    precise float doubled_squared = ordered_dot(doubled, doubled);
    if (!(doubled_squared > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
    precise float doubled_area = sqrt(doubled_squared);
    precise float area = 0.5f * doubled_area;
    precise vec3 relative = wind - velocity;
    precise vec3 unit = doubled / doubled_area;
    precise float along = ordered_dot(relative, unit);
    precise vec3 normal = along < 0.0f ? -unit : unit;
    precise float facing = along < 0.0f ? -along : along;
    precise float squared = ordered_dot(relative, relative);
    precise vec3 force = (relative * (drag_coefficient * facing) + normal * (lift_coefficient * squared)) * area;
    return force;
}

/// What a sum over triangles starts from: -0 + x is x for every x, +0 + (-0) is not, and some compilers drop the
/// addition of a zero.
SHARED vec3 empty_sum() { return vec3(-0.0f, -0.0f, -0.0f); }

/// `sum` plus one corner's third of the force on a triangle whose corners moved by d0 d1 d2 in the last substep.
SHARED vec3 add_wind_share(vec3 sum, vec3 p0, vec3 p1, vec3 p2, vec3 d0, vec3 d1, vec3 d2, float inverse_step,
                           vec3 wind, float drag_coefficient, float lift_coefficient) {
    precise vec3 velocity = (d0 + d1 + d2) * inverse_step / 3.0f;
    vec3 force = triangle_wind_force(p0, p1, p2, velocity, wind, drag_coefficient, lift_coefficient);
    precise vec3 total = sum + force / 3.0f;
    return total;
}

/// `sum` plus a triangle's area vector (twice its area times its normal).
SHARED vec3 add_area_vector(vec3 sum, vec3 p0, vec3 p1, vec3 p2) {
    precise vec3 total = sum + ordered_cross(p1 - p0, p2 - p0);
    return total;
}

/// Unit vector, or zero when there is no direction.
SHARED vec3 unit_or_zero(vec3 v) {
    precise float squared = ordered_dot(v, v);
    if (!(squared > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
    precise float size = sqrt(squared);
    precise vec3 unit = v / size;
    return unit;
}

#endif
