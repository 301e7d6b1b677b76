// Gas that cloths close in (docs/physics.md 13): (p + ambient) V = ambient Vn. A stiff gas has to be solved for with
// the motion: what V is at a substep's end follows from what inertia makes of it, from the other forces, which go on as
// in the substep before, and from the change of p, by which the places of all cloths move as one.
#ifndef DRAPE_GAS_H
#define DRAPE_GAS_H

#include "include/vector.h"

/// The edges from a particle to its eight neighbours on the grid, m.
struct GasEdges {
    vec3 left, right, up, down, up_left, up_right, down_left, down_right;
};

/// Returns twelve times what a cell adds to the derivative of the volume by a corner, which has edges to the next
/// corner, the last one and the one across.
SHARED vec3 gas_quarter(vec3 next, vec3 last, vec3 across) {
    precise vec3 sum = ordered_cross(next, last) + ordered_cross(across, last - next);
    return sum;
}

/// Returns the derivative, m^2, of the volume behind a cloth by the place of a particle. A cell's share of the volume
/// is the mean of both ways to halve it. `air`: bits of the quarters of cells that the particle has. Quarters that face
/// each other are added first.
SHARED vec3 gas_area(GasEdges edges, uint air) {
    vec3 none = vec3(-0.0f, -0.0f, -0.0f);
    vec3 up_left = (air & air_up_left) != 0u ? gas_quarter(edges.left, edges.up, edges.up_left) : none;
    vec3 up_right = (air & air_up_right) != 0u ? gas_quarter(edges.up, edges.right, edges.up_right) : none;
    vec3 down_left = (air & air_down_left) != 0u ? gas_quarter(edges.down, edges.left, edges.down_left) : none;
    vec3 down_right = (air & air_down_right) != 0u ? gas_quarter(edges.right, edges.down, edges.down_right) : none;
    precise vec3 area = ((up_left + down_right) + (up_right + down_left)) * (1.0f / 12.0f);
    return area;
}

/// Returns an area turned outwards.
SHARED vec3 gas_turned(vec3 area, float sign) {
    precise vec3 outward = area * sign;
    return outward;
}

/// Returns what a BDF2 step makes of a displacement by inertia alone (bdf2_increment, without damping).
SHARED vec3 gas_inertia(vec3 displacement, vec3 displacement_before, vec3 excess_before) {
    precise vec3 change = displacement - displacement_before;
    precise vec3 inertia = displacement + ((change - excess_before) * (2.0f / 9.0f) + change * (4.0f / 9.0f));
    return inertia;
}

SHARED GasSum empty_gas_sum() {
    vec4 none = vec4(-0.0f, -0.0f, -0.0f, -0.0f);
    return GasSum(none, none, none);
}

/// Joins two sums of one origin.
SHARED GasSum joined(GasSum a, GasSum b) {
    precise vec4 origin = vec4(a.origin.x, a.origin.y, a.origin.z, a.origin.w + b.origin.w);
    precise vec4 area = vec4(a.area.x + b.area.x, a.area.y + b.area.y, a.area.z + b.area.z, a.area.w + b.area.w);
    precise vec4 change = vec4(a.change.x + b.change.x, a.change.y + b.change.y, a.change.z + b.change.z, 0.0f);
    return GasSum(origin, area, change);
}

/// Returns the terms of a particle. `area` is its place's, `share.x` its part of the place, `share.y` what the square
/// of that area counts, 1/kg; `arm` is from the origin, `inertia` of gas_inertia; `touched`: by a collider.
SHARED GasSum gas_term(vec3 area, vec2 share, bool held, bool touched, vec3 arm, vec3 displacement, vec3 inertia) {
    precise vec3 own = area * share.x;
    precise float square = ordered_dot(area, area) * share.y;
    return GasSum(
        vec4(0.0f, 0.0f, 0.0f, ordered_dot(arm, own)), vec4(own.x, own.y, own.z, held ? 0.0f : square),
        vec4(ordered_dot(displacement, own), ordered_dot(inertia, own), touched && !held ? square : 0.0f, 0.0f));
}

/// Returns a sum as seen from another origin.
SHARED GasSum gas_seen(GasSum sum, vec3 origin) {
    precise vec3 off = vec3(sum.origin.x, sum.origin.y, sum.origin.z) - origin;
    precise float volume = sum.origin.w + ordered_dot(off, vec3(sum.area.x, sum.area.y, sum.area.z));
    return GasSum(vec4(origin.x, origin.y, origin.z, volume), sum.area, sum.change);
}

/// Returns p of (p + ambient) (volume + yielding p) = ambient amount, the root with p > -ambient, in the form that does
/// not cancel. Where nothing yields, and nothing is closed in, the pressure is nobody's.
SHARED float gas_root(float volume, float yielding, float ambient, float amount) {
    precise float both = volume + yielding * ambient;
    precise float apart = volume - yielding * ambient;
    precise float root = sqrt(apart * apart + 4.0f * yielding * ambient * amount);
    precise float inner = 2.0f * ambient * (amount - volume) / (both + root);
    precise float outer = (root - both) / (2.0f * yielding);
    float found = both > 0.0f ? inner : outer;
    return yielding > 0.0f || volume > 0.0f ? found : 0.0f;
}

/// Returns which part of a change of the other forces is believed at once. Places that colliders hold count as if they
/// yielded, so that other forces seem to undo what the change of p does there. Where half of the places or more are
/// held, p would swing if all of that were believed; (1 - f)/f is the bound where the part f is held (docs/physics.md).
SHARED float gas_belief(float squares, float touched) {
    precise float free = 0.65f * (squares - touched);
    precise float share = free / touched;
    float belief = share < least_gas_belief ? least_gas_belief : share;
    return free < touched ? belief : 1.0f;
}

/// Returns the state of a gas after a substep's pressure is found. `sum`: of all cloths; `amount`: m^3.
SHARED GasState gas_next(GasSum sum, GasState last, float amount, bool second_order, GasPush push) {
    precise float volume = sum.origin.w / 3.0f;
    if (push.ends == 1) return GasState(vec4(last.now.x, volume, last.now.z, last.now.w), last.kept);
    bool begins = last.now.w == 0.0f;
    precise float others = (sum.change.x - last.now.z) - last.kept.y * last.now.x;
    float belief = gas_belief(sum.area.w, sum.change.z);
    precise float learnt = last.kept.x + (others - last.kept.x) * belief;
    // After a change of substeps, how the last one would have gone by inertia is not known in these.
    precise float stretch = (push.step / last.now.w) * (push.step / last.now.w);
    precise float scaled = last.kept.x * stretch;
    float followed = belief < 1.0f ? learnt : others;
    float grown = begins ? 0.0f : last.now.w == push.step ? followed : scaled;
    float inertia = second_order ? sum.change.y : sum.change.x;
    precise float yielding = sum.area.w * (second_order ? push.square_step.y : push.square_step.x);
    precise float expected = volume + (inertia + grown);
    float pressure = gas_root(expected, yielding, push.ambient, amount);
    return GasState(vec4(pressure, volume, inertia, push.step), vec4(grown, yielding, 0.0f, 0.0f));
}

/// Returns the force of a gas on a particle whose area it turns outwards by `sign`.
SHARED vec3 gas_force(vec3 sum, vec3 area, float pressure, float sign) {
    precise vec3 total = sum + area * (pressure * sign);
    return total;
}

#endif
