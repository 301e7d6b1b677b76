// The wind's force on a triangle, and the normal of a cell (docs/physics.md 6).
#ifndef DRAPE_WIND_H
#define DRAPE_WIND_H

#include "include/vector.h"

/// The force of the wind on a triangle, or on a particle from all of its triangles.
struct WindForce {
    vec3 force;  // N
    float drag;  // per triangle, kg/s; per particle, N per metre that the substep's displacement changes
};

/// Force (N) on a triangle of corners p0 p1 p2 (m) moving with mean velocity `velocity` (m/s) in wind `wind`: F = rho A
/// / 2 [(Cd - Cl)(v.n) v + Cl |v|^2 n], v = wind - velocity, n the unit normal turned so that n.v > 0. A degenerate
/// triangle (no area, no normal) feels nothing. Coefficients: rho (Cd - Cl)/2, rho Cl/2. Drag c = rho A/2 (|Cd - Cl| f
/// + Cl |v| min(|v|/f, 2)), f = v.n: where the wind blows straight on the triangle it is half of -dF/dv, which makes a
/// step of v' = v + h F/(m + h c) exact there for every h; elsewhere it is more than half of every eigenvalue of -dF/dv
/// (for Cd <= 3 Cl) and than |F|/|v|. The factor of 2 is for grazing wind, whose lift turns over with the triangle:
/// with 1, light cloth of Cl > Cd gathers speed without end. A counts up to `area_limit`: cloth too soft for its wind
/// would else offer it ever more area and stretch without end.
SHARED WindForce triangle_wind_force(vec3 p0, vec3 p1, vec3 p2, vec3 velocity, vec3 wind, float drag_coefficient,
                                     float lift_coefficient, float area_limit) {
    precise vec3 doubled = ordered_cross(p1 - p0, p2 - p0);
    precise float doubled_squared = ordered_dot(doubled, doubled);
    precise float doubled_area = sqrt(doubled_squared);
    precise float half_doubled = 0.5f * doubled_area;
    precise float area = half_doubled > area_limit ? area_limit : half_doubled;
    precise vec3 relative = wind - velocity;
    precise vec3 unit = doubled * reciprocal(doubled_area);
    precise float along = ordered_dot(relative, unit);
    precise vec3 normal = along < 0.0f ? -unit : unit;
    precise float facing = along < 0.0f ? -along : along;
    precise float squared = ordered_dot(relative, relative);
    precise vec3 force = (relative * (drag_coefficient * facing) + normal * (lift_coefficient * squared)) * area;
    precise float speed = sqrt(squared);
    precise float resisting = 2.0f * facing <= speed ? 2.0f * speed : squared / facing;
    precise float drag = (abs(drag_coefficient) * facing + lift_coefficient * resisting) * area;
    // The values are selected, not branched on (include/line.h).
    bool is_one = doubled_squared > 0.0f;
    return WindForce(is_one ? force : vec3(0.0f, 0.0f, 0.0f), is_one ? drag : 0.0f);
}

/// Sums over triangles start from -0, since -0 + x is x for every x, +0 + (-0) is not, and some compilers drop the
/// addition of a zero.
SHARED vec3 empty_sum() { return vec3(-0.0f, -0.0f, -0.0f); }

/// Returns one corner's third of the force on a triangle whose corners moved by d0 d1 d2 in the last substep.
SHARED WindForce wind_share(vec3 p0, vec3 p1, vec3 p2, vec3 d0, vec3 d1, vec3 d2, float inverse_step, vec3 wind,
                            float drag_coefficient, float lift_coefficient, float area_limit) {
    const float third = 1.0f / 3.0f;
    precise float third_of_inverse_step = inverse_step * third;
    precise vec3 velocity = (d0 + d1 + d2) * third_of_inverse_step;
    WindForce on_triangle =
        triangle_wind_force(p0, p1, p2, velocity, wind, drag_coefficient, lift_coefficient, area_limit);
    precise vec3 force = on_triangle.force * third;
    precise float drag = on_triangle.drag * third_of_inverse_step;
    return WindForce(force, drag);
}

SHARED WindForce add_share(WindForce sum, WindForce share) {
    precise vec3 force = sum.force + share.force;
    precise float drag = sum.drag + share.drag;
    return WindForce(force, drag);
}

/// Returns `sum` plus the weight of a particle under `gravity`; the inverse mass of an inner particle is 1. A particle
/// that no force moves has inverse mass 0, and no weight.
SHARED vec3 add_weight(vec3 sum, vec3 gravity, float inner_mass, float inverse_mass) {
    precise vec3 total = sum + gravity * (inner_mass / inverse_mass);
    return inverse_mass > 0.0f ? total : sum;
}

/// Returns `sum` plus a triangle's area vector (twice its area times its normal).
SHARED vec3 add_area_vector(vec3 sum, vec3 p0, vec3 p1, vec3 p2) {
    precise vec3 total = sum + ordered_cross(p1 - p0, p2 - p0);
    return total;
}

/// Returns the unit vector, or zero when there is no direction.
SHARED vec3 unit_or_zero(vec3 v) {
    precise float squared = ordered_dot(v, v);
    precise float size = sqrt(squared);
    precise vec3 unit = v * reciprocal(size);
    return squared > 0.0f ? unit : vec3(0.0f, 0.0f, 0.0f);
}

#endif
