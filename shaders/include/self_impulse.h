// Impulses of contacts between cloths (docs/physics.md 5). A contact is a pair of primitives that touch in a substep,
// or would. What it gives to one side it takes from the other, so linear and angular momentum are kept, and its impulse
// is what the two need not to come nearer than their thickness, with Coulomb friction. All contacts of a substep are
// worked out at once (Jacobi): a corner's mass is divided among its contacts in proportion to the weights with which
// they hold it (mass splitting: Tonge, Benevolenski, Voroshilov 2012), so that a round never adds energy. Impulses are
// kept from round to round and, by pair, from substep to substep, so that a pile that rests needs no rounds to carry
// itself. They move velocities; a thickness that is missing moves positions alone.
#ifndef DRAPE_SELF_IMPULSE_H
#define DRAPE_SELF_IMPULSE_H

#include "include/contact_law.h"
#include "include/self_gap.h"
#include "shared/self_contact_types.h"

/// A pair counts as a contact when it is nearer than so many thicknesses, since others may push it within a substep.
const float self_touch_reach = 1.1f;
/// A thickness counts as kept from this share on, so that cloth at rest needs no pushing.
const float self_thickness_kept = 0.98f;

/// Returns by how much (m) a substep restores a missing thickness. A layer that carries a pile needs more than one that
/// lies alone, and yields until it has that.
SHARED float self_made_good(float distance, float pair_thickness, float step) {
    precise float missing = pair_thickness - distance;
    float deep = self_limited(self_ratio(missing, pair_thickness));
    precise float most = (self_recovery_speed * step) * (1.0f + (self_deep_recovery - 1.0f) * (deep * deep));
    precise float lacking = pair_thickness * self_thickness_kept - distance;
    return self_largest(self_least(lacking, most), 0.0f);
}

/// Returns by how much (m) a pair may come nearer, or, if negative, must be led apart.
SHARED float self_freedom(float distance, float pair_thickness, float step) {
    precise float over = distance - pair_thickness;
    float lacking = self_made_good(distance, pair_thickness, step);
    return over > 0.0f ? over : -lacking;
}

/// Returns whether a pair is a contact in this substep. Two edges that are nearest at an end of one are left to the
/// pair of that end's particle and a triangle.
SHARED bool self_touches(bool edges, SelfGap gap, SelfCorners moved, float pair_thickness) {
    float along = ordered_dot(gap.normal, self_sum(gap.weights, moved));
    precise float then = gap.distance + along;
    precise float reach = pair_thickness * self_touch_reach;
    vec4 g = gap.weights;
    bool inside = !edges || (g.x != 0.0f && g.y != 0.0f && g.z != 0.0f && g.w != 0.0f);
    return inside && gap.distance > 1.0e-12f && (then < reach || gap.distance < pair_thickness);
}

/// Returns an impulse with these parts along a contact's normal and across it, limited to its friction cone.
SHARED vec3 self_in_cone(vec3 normal, float along, vec3 tangent, float friction) {
    float pressed = self_largest(along, 0.0f);
    precise float sliding = sqrt(ordered_dot(tangent, tangent));
    precise float grip = friction * pressed;
    float kept = sliding > grip ? self_ratio(grip, sliding) : 1.0f;
    precise vec3 impulse = normal * pressed + tangent * kept;
    return impulse;
}

/// Returns the impulse with which a pair begins a substep, from the force that it bore in the last one. The full force
/// is used: with a twentieth less, heaps sink and are lifted again without end.
SHARED vec3 self_begun(vec3 normal, vec3 force, float friction, float step) {
    precise vec3 impulse = force * (step * step);
    float along = ordered_dot(normal, impulse);
    precise vec3 tangent = impulse - normal * along;
    return self_in_cone(normal, along, tangent, friction);
}

SHARED vec3 self_borne_force(vec3 impulse, float step) {
    precise vec3 force = impulse * reciprocal(step * step);
    return force;
}

/// Returns a contact's impulse after a round. `relative`: how the second primitive moves relative to the first under
/// the previous round's impulses; `yields`: how much of that motion a unit of impulse causes, with the corners' masses
/// split among their contacts.
SHARED vec3 self_next_impulse(SelfTouch touch, vec3 relative, float yields) {
    vec3 normal = vec3(touch.normal.x, touch.normal.y, touch.normal.z),
         impulse = vec3(touch.impulse.x, touch.impulse.y, touch.impulse.z);
    float moves = ordered_dot(normal, relative), pressed = ordered_dot(normal, impulse);
    precise vec3 slides = relative - normal * moves;
    precise vec3 held = impulse - normal * pressed;
    float per_motion = reciprocal(yields);
    precise float along = pressed - (moves + self_largest(touch.normal.w, 0.0f)) * per_motion;
    precise vec3 tangent = held - slides * per_motion;
    vec3 next = self_in_cone(normal, along, tangent, touch.impulse.w);
    return yields > 0.0f ? next : impulse;
}

/// Returns the impulse (first cloth's masses times m) that leads a pair apart by the thickness that it lacks.
SHARED float self_leading(SelfTouch touch, float yields) {
    precise float leads = self_largest(-touch.normal.w, 0.0f) * reciprocal(yields);
    return yields > 0.0f ? leads : 0.0f;
}

/// Returns how far a unit of impulse moves a pair's primitives relative to each other. `holds`: by corner, the sum of
/// the weights with which contacts hold it.
SHARED float self_yields(vec4 weights, vec4 inverse_mass, vec4 holds) {
    vec4 g = vec4(abs(weights.x), abs(weights.y), abs(weights.z), abs(weights.w));
    precise float yields =
        (inverse_mass.x * (g.x * self_largest(holds.x, g.x)) + inverse_mass.y * (g.y * self_largest(holds.y, g.y))) +
        inverse_mass.z * (g.z * self_largest(holds.z, g.z)) + inverse_mass.w * (g.w * self_largest(holds.w, g.w));
    return yields;
}

/// Returns half of the couple with which a pair's impulse acts on its two sides, since it acts on each at that side's
/// nearest point: so much angular momentum is made on each. It is divided by the largest thickness, as impulses are
/// summed. `x`: relative to one of the corners.
SHARED vec3 self_half_couple(vec4 weights, SelfCorners x, vec3 impulse, float largest) {
    precise vec3 half_couple = ordered_cross(self_sum(weights, x), impulse) * (0.5f / largest);
    return half_couple;
}

/// Returns the couple, of masses in units of a cloth's own inner particle, from the sum of such halves.
SHARED vec3 self_couple_of(vec3 sum, float largest, float lightness) {
    precise vec3 couple = sum * (largest * lightness);
    return couple;
}

SHARED vec3 self_moved_by(vec3 impulse, float inverse_mass) {
    precise vec3 by = impulse * inverse_mass;
    return by;
}

/// Returns how far the restoring of a thickness moves a particle: away from the surface on which it lies (`normal`,
/// zero if none), since friction holds it along the surface.
SHARED vec3 self_led_by(vec3 by, vec3 normal) {
    precise vec3 away = normal * self_largest(ordered_dot(normal, by), 0.0f);
    return ordered_dot(normal, normal) > 0.0f ? away : by;
}

/// Returns a motion without the displacement by which a collider led the particle out of an overlap, which is no
/// velocity.
SHARED vec3 self_own_motion(vec3 moved, vec3 way_out) {
    precise vec3 own = moved - way_out;
    return own;
}

SHARED vec3 self_added(vec3 displacement, vec3 by) {
    precise vec3 sum = displacement + by;
    return sum;
}

/// Returns the number of integer units for the mass of a particle of the first cloth that moves by the largest
/// thickness. Impulses are summed as integers, so that the order of sums does not matter and opposite ones cancel.
SHARED float self_units_per_impulse(float thickness) {
    precise float units = 1073741824.0f / thickness;
    return units;
}

SHARED vec3 self_impulse_of(vec3 units, float thickness) {
    precise vec3 impulse = units * (thickness / 1073741824.0f);
    return impulse;
}

/// Returns a component in units, as two parts that are summed separately: first the lower one, then the upper one in
/// units of 2^20. A NaN gives 0, and larger values give 2^46.
SHARED ivec2 self_parts(float component, float units_per_impulse) {
    const float most = 70368744177664.0f, upper_unit = 1048576.0f;
    precise float units = component * units_per_impulse;
    float limited = units > most ? most : units < -most ? -most : units;
    bool is_number = limited >= -most && limited <= most;
    precise float scaled = (is_number ? limited : 0.0f) / upper_unit;
    int upper = int(scaled);
    precise float rest = (scaled - float(upper)) * upper_unit;
    return ivec2(int(rest), upper);
}

/// The parts of a vector's components.
struct SelfParts {
    ivec2 x, y, z;
};
SHARED SelfParts self_parts_of(vec3 impulse, float weight, float units_per_impulse) {
    precise vec3 by = impulse * weight;
    return SelfParts(self_parts(by.x, units_per_impulse), self_parts(by.y, units_per_impulse),
                     self_parts(by.z, units_per_impulse));
}
SHARED ivec2 self_difference(ivec2 a, ivec2 b) { return ivec2(a.x - b.x, a.y - b.y); }
SHARED SelfParts self_parts_left(SelfParts all, SelfParts taken) {
    return SelfParts(self_difference(all.x, taken.x), self_difference(all.y, taken.y), self_difference(all.z, taken.z));
}

/// The parts that a contact gives to each corner: those of the two primitives are opposite, to the last unit.
struct SelfShares {
    SelfParts a, b, c, d;
};
SHARED SelfShares self_shares(bool edges, vec4 weights, vec3 impulse, float units_per_impulse) {
    SelfParts none = SelfParts(ivec2(0, 0), ivec2(0, 0), ivec2(0, 0));
    SelfParts to = self_parts_of(impulse, 1.0f, units_per_impulse);
    SelfParts from = self_parts_left(none, to);
    SelfParts a = edges ? self_parts_of(impulse, weights.x, units_per_impulse) : from;
    SelfParts b = edges ? self_parts_left(from, a) : self_parts_of(impulse, weights.y, units_per_impulse);
    SelfParts c = self_parts_of(impulse, weights.z, units_per_impulse);
    SelfParts left = self_parts_left(to, c);
    SelfParts d = edges ? left : self_parts_left(left, b);
    return SelfShares(a, b, c, d);
}

/// Returns the words of a 64-bit integer with the same value as two sums of parts.
SHARED uvec2 self_words(uint lower_sum, uint upper_sum) {
    uint low = upper_sum << 20;
    int high = int(upper_sum) >> 12, sign = int(lower_sum) >> 31;
    uint sum = low + lower_sum;
    return uvec2(sum, uint(high + sign) + (sum < low ? 1u : 0u));
}

/// Returns the number nearest to a 64-bit integer in two words.
SHARED float self_number(uvec2 words) {
    bool negative = (words.y >> 31) != 0u;
    uint lower = negative ? ~words.x + 1u : words.x;
    uint upper = negative ? ~words.y + (words.x == 0u ? 1u : 0u) : words.y;
    precise float low = float(lower >> 16) * 65536.0f + float(lower & 65535u);
    precise float high = float(upper >> 16) * 65536.0f + float(upper & 65535u);
    precise float size = high * 4294967296.0f + low;
    return negative ? -size : size;
}

SHARED uint self_weight(float weight) {
    precise float units = abs(weight) * self_weight_units;
    return uint(units);
}
SHARED float self_holds(uint sum) {
    precise float holds = float(sum) / self_weight_units;
    return holds;
}

/// Returns the velocity (m per substep) of a particle after contact. `pushed` is the one that impulses gave it. If a
/// collider afterwards changed its motion to `moved`, the velocity is that motion without the part of the restored
/// thickness that the collider let through, which is none where the surface on which it lies (`normal`) bears it.
SHARED vec3 self_velocity(vec3 moved, vec3 pushed, vec3 made_good, vec3 normal) {
    precise vec3 change = moved - self_added(pushed, made_good);
    float squared = ordered_dot(change, change), against = self_least(ordered_dot(made_good, change), 0.0f);
    precise vec3 let_through = made_good - change * self_ratio(against, squared);
    precise vec3 velocity = moved - let_through;
    vec3 changed = ordered_dot(normal, change) > 0.0f ? moved : velocity;
    return squared > 0.0f ? changed : pushed;
}

/// Returns whether a collider touched a particle in this substep: before impulses, so that it lies on a surface
/// (`normal`, zero if none), or after them, so that it does not make the motion that they left it with.
SHARED bool self_was_touched(vec3 moved, vec3 pushed, vec3 made_good, vec3 normal) {
    vec3 left = self_added(pushed, made_good);
    bool lies = normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f;
    return lies || moved.x != left.x || moved.y != left.y || moved.z != left.z;
}

/// Returns how far a motion falls short of another, m.
SHARED float self_lag(vec3 made, vec3 wanted) {
    precise vec3 lacks = wanted - made;
    precise float lag = sqrt(ordered_dot(lacks, lacks));
    return lag;
}

/// Returns where a particle must start to end where its motion `made` takes it, with its velocity.
SHARED vec3 self_start(vec3 start, vec3 made, vec3 velocity) {
    precise vec3 moved = start + (made - velocity);
    return moved;
}

#endif
