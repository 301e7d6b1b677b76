// The force of the air on a particle, and the normal of a cell (docs/physics.md 6).
#ifndef DRAPE_WIND_H
#define DRAPE_WIND_H

#include "include/vector.h"
#include "shared/simulation_types.h"

/// The force of the air on a particle, or on one of the quarters of cells that it has.
struct WindForce {
    vec3 force;  // N
    float drag;  // kg/s; of a whole particle, N per metre that the substep's displacement changes
};

/// Returns the bits of what the air acts on (shared/simulation_types.h) of a particle of a cloth without holes and
/// cuts.
SHARED uint border_air(ivec2 particle, ivec2 grid) {
    bool left = particle.x > 0, right = particle.x + 1 < grid.x, up = particle.y > 0, down = particle.y + 1 < grid.y;
    return (left && up ? air_up_left : 0u) | (right && up ? air_up_right : 0u) | (left && down ? air_down_left : 0u) |
           (right && down ? air_down_right : 0u) | (left ? air_left : 0u) | (right ? air_right : 0u) |
           (up ? air_up : 0u) | (down ? air_down : 0u);
}

/// The edges from a particle to its neighbours along its row and its column, m. Their signs do not matter.
struct AirEdges {
    vec3 left, right, up, down;
};

/// Returns an edge of length `width` square to `edge` and to the wind; zero where there is no such direction.
SHARED vec3 edge_across(vec3 edge, vec3 relative, float width) {
    vec3 square = ordered_cross(edge, relative);
    precise float squared = ordered_dot(square, square);
    precise float scale = width / sqrt(squared);
    precise vec3 across = square * scale;
    return squared > 0.0f ? across : vec3(0.0f, 0.0f, 0.0f);
}

/// Returns the edges with those to neighbours that are cut off replaced, since they lead to another piece. The edge on
/// the other side of the particle takes its place. Where that is gone too, cloth is a thread or a crumb there and has
/// no direction of its own across: it faces the wind, as wide as a cell (`spacing`, m).
SHARED AirEdges own_edges(AirEdges edges, uint air, vec3 relative, vec2 spacing) {
    bool left = (air & air_left) != 0u, right = (air & air_right) != 0u;
    bool up = (air & air_up) != 0u, down = (air & air_down) != 0u;
    AirEdges own = AirEdges(left ? edges.left : edges.right, right ? edges.right : edges.left,
                            up ? edges.up : edges.down, down ? edges.down : edges.up);
    bool in_row = left || right, in_column = up || down;
    if (!in_column) {
        vec3 axis = abs(relative.x) < abs(relative.y) ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
        own.up = edge_across(in_row ? own.left : axis, relative, spacing.y);
        own.down = edge_across(in_row ? own.right : axis, relative, spacing.y);
    }
    if (!in_row) {
        own.left = edge_across(own.up, relative, spacing.x);
        own.right = own.left;
    }
    return own;
}

/// Returns the force (N) on a quarter of a cell, whose corner's edges are `row` and `column` (m), in the wind
/// `relative` to the corner (m/s): F = rho A/2 [(Cd - Cl)(v.n) v + Cl |v|^2 n], v = `relative`, A = |row x column|/4, n
/// the unit normal turned so that n.v > 0. Coefficients: rho (Cd - Cl)/2, rho Cl/2. `squared` and `speed`: |v|^2, |v|.
///
/// Drag c = rho A/2 (|Cd - Cl| f + Cl |v| min(|v|/f, 2)), f = v.n. Where the wind blows straight on it is half of
/// -dF/dv, which makes a step of v' = v + h F/(m + h c) exact there for every h; elsewhere it is more than half of
/// every eigenvalue of -dF/dv (for Cd <= 3 Cl) and than |F|/|v|. The factor of 2 is for grazing wind, whose lift turns
/// over with the cloth: with 1, light cloth of Cl > Cd gathers speed without end.
///
/// A counts up to a quarter of `most` (m^2): cloth too soft for its wind would else offer it ever more area and stretch
/// without end.
SHARED WindForce quarter_wind_force(vec3 row, vec3 column, vec3 relative, float squared, float speed,
                                    float drag_coefficient, float lift_coefficient, float most) {
    precise vec3 normal = ordered_cross(row, column);
    precise float size = sqrt(ordered_dot(normal, normal));
    precise float along = ordered_dot(relative, normal);
    precise vec3 facing_normal = along < 0.0f ? -normal : normal;
    precise float facing = along < 0.0f ? -along : along;
    precise float flow = speed * size;
    precise float resisting = 2.0f * facing <= flow ? 2.0f * flow : flow / facing * flow;
    precise float limited = 0.25f * (most / size);
    float quarter = size > most ? limited : 0.25f;
    precise vec3 force =
        (relative * (drag_coefficient * facing) + facing_normal * (lift_coefficient * squared)) * quarter;
    precise float drag = (abs(drag_coefficient) * facing + lift_coefficient * resisting) * quarter;
    return WindForce(force, drag);
}

/// Sums start from -0, since -0 + x is x for every x, +0 + (-0) is not, and some compilers drop the addition of a zero.
SHARED vec3 empty_sum() { return vec3(-0.0f, -0.0f, -0.0f); }

SHARED WindForce add_share(WindForce sum, WindForce share) {
    precise vec3 force = sum.force + share.force;
    precise float drag = sum.drag + share.drag;
    return WindForce(force, drag);
}

/// Returns what a quarter adds to a sum; one that does not exist adds nothing, not even a zero's sign.
SHARED WindForce share_if(bool exists, WindForce share) {
    // The values are selected, not branched on (include/line.h).
    return WindForce(exists ? share.force : empty_sum(), exists ? share.drag : -0.0f);
}

/// Returns the force of the air on a particle in the wind `relative` to it (m/s). Air is shared like mass: the force on
/// a quarter is its particle's. Quarters that face each other are added first, so that sums of a mirrored
/// or transposed cloth round alike.
SHARED WindForce particle_wind_force(AirEdges edges, uint air, vec3 relative, float inverse_step,
                                     float drag_coefficient, float lift_coefficient, vec2 spacing) {
    precise float squared = ordered_dot(relative, relative);
    precise float speed = sqrt(squared);
    precise float most = 2.0f * (spacing.x * spacing.y);
    WindForce up_left = quarter_wind_force(edges.left, edges.up, relative, squared, speed, drag_coefficient,
                                           lift_coefficient, most),
              up_right = quarter_wind_force(edges.right, edges.up, relative, squared, speed, drag_coefficient,
                                            lift_coefficient, most),
              down_left = quarter_wind_force(edges.left, edges.down, relative, squared, speed, drag_coefficient,
                                             lift_coefficient, most),
              down_right = quarter_wind_force(edges.right, edges.down, relative, squared, speed, drag_coefficient,
                                              lift_coefficient, most);
    WindForce sum = add_share(
        add_share(share_if((air & air_up_left) != 0u, up_left), share_if((air & air_down_right) != 0u, down_right)),
        add_share(share_if((air & air_up_right) != 0u, up_right), share_if((air & air_down_left) != 0u, down_left)));
    precise float drag = sum.drag * inverse_step;
    return WindForce(sum.force, drag);
}

/// Returns the wind that a particle feels which moved by `displacement` in the last substep, m/s.
SHARED vec3 relative_wind(vec3 wind, vec3 displacement, float inverse_step) {
    precise vec3 relative = wind - displacement * inverse_step;
    return relative;
}

/// Returns `sum` plus the weight of a particle under `gravity`; the inverse mass of an inner particle is 1. A particle
/// that no force moves has inverse mass 0, and no weight.
SHARED vec3 add_weight(vec3 sum, vec3 gravity, float inner_mass, float inverse_mass) {
    precise vec3 total = sum + gravity * (inner_mass / inverse_mass);
    return inverse_mass > 0.0f ? total : sum;
}

/// Returns the area vector of a particle's quarters of cells, m^2, which points to the front. Quarters that face each
/// other are added first (particle_wind_force). An edge to a neighbour that is cut off is that on the other side,
/// turned round; what is a thread or a crumb has no side.
SHARED vec3 area_vector(AirEdges edges, uint air) {
    bool left = (air & air_left) != 0u, right = (air & air_right) != 0u;
    bool up = (air & air_up) != 0u, down = (air & air_down) != 0u;
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    vec3 to_left = left ? edges.left : right ? -edges.right : none, to_right = right ? edges.right : -to_left;
    vec3 to_up = up ? edges.up : down ? -edges.down : none, to_down = down ? edges.down : -to_up;
    vec3 up_left = (air & air_up_left) != 0u ? ordered_cross(to_left, to_up) : empty_sum();
    vec3 up_right = (air & air_up_right) != 0u ? ordered_cross(to_up, to_right) : empty_sum();
    vec3 down_left = (air & air_down_left) != 0u ? ordered_cross(to_down, to_left) : empty_sum();
    vec3 down_right = (air & air_down_right) != 0u ? ordered_cross(to_right, to_down) : empty_sum();
    precise vec3 area = ((up_left + down_right) + (up_right + down_left)) * 0.25f;
    return area;
}

/// Returns `sum` plus what a load gives to a particle with this area vector: `load` is its force, N, and beside it its
/// pressure, Pa; `share` the particle's share of the force, after the load's number, and the factor of the pressure.
SHARED vec3 add_load(vec3 sum, vec4 load, vec4 share, vec3 area) {
    precise vec3 total = sum + (vec3(load.x, load.y, load.z) * share.y + area * (load.w * share.z));
    return total;
}

/// Returns the force on a particle with what loads give to it, unless it is held: pins bear that.
SHARED vec3 with_loads(vec3 force, vec3 by_loads, float inverse_mass) {
    precise vec3 total = force + by_loads;
    return inverse_mass > 0.0f ? total : force;
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
