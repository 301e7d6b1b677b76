// The law of contact with a collider's surface.
#ifndef DRAPE_CONTACT_LAW_H
#define DRAPE_CONTACT_LAW_H

#include "include/vector.h"
#include "include/verlet.h"
#include "shared/collider_types.h"

/// Returns the displacement after contact: `depth` of the motion into the surface is taken away along `normal`, and the
/// motion relative to the surface along the tangent is reduced by friction * depth, at most to zero (Jakobsen 2001).
/// This is Coulomb's law, since what is taken away along the normal in a time is the impulse that the surface gives in
/// it: of a resting particle g cos(a) h^2. `displacement`, `surface` (the collider's own): m. The remainder is what
/// rounding lost: in a short substep it is a share of what friction takes, and does not average out.
SHARED CompensatedSum contact_displacement(vec3 displacement, vec3 surface, vec3 normal, float depth, float friction) {
    precise vec3 relative = displacement - surface;
    precise float along = ordered_dot(relative, normal);
    precise vec3 tangent = relative - normal * along;
    precise float squared = ordered_dot(tangent, tangent);
    precise float grip = friction * depth;
    precise vec3 pushed = normal * depth;
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    if (!(squared > 0.0f) || !(grip > 0.0f)) return compensated_add(displacement, pushed, none);
    precise float sliding = sqrt(squared);
    precise float kept = sliding > grip ? grip / sliding : 1.0f;
    precise vec3 change = pushed - tangent * kept;
    return compensated_add(displacement, change, none);
}

SHARED vec3 support_normal(Support support) { return vec3(support.plane.x, support.plane.y, support.plane.z); }

/// Returns the displacement that a surface allows a particle.
SHARED vec3 supported(vec3 displacement, Support support) {
    vec3 normal = support_normal(support), surface = vec3(support.grip.x, support.grip.y, support.grip.z);
    precise float depth = support.plane.w - ordered_dot(normal, displacement);
    vec3 held = contact_displacement(displacement, surface, normal, depth, support.grip.w).value;
    return depth > 0.0f ? held : displacement;
}

/// Returns the vector from where a particle started to where it is led.
SHARED vec3 way_between(vec3 start, vec3 led) {
    precise vec3 way = led - start;
    return way;
}

SHARED float largest_coordinate(vec3 at) {
    vec3 size = vec3(abs(at.x), abs(at.y), abs(at.z));
    float larger = size.x > size.y ? size.x : size.y;
    return larger > size.z ? larger : size.z;
}

/// Returns whether a displacement is no longer than the rounding of coordinates of this size.
SHARED bool is_rounding(vec3 start, vec3 way) {
    precise float rounded = largest_coordinate(start) * 1.2e-7f;
    return !(largest_coordinate(way) > rounded);
}

/// Returns a bound on what rounding does to the distance of a point from a collider, m.
SHARED float rounding_at(vec3 world, vec3 local) {
    precise float rounding = (largest_coordinate(world) + largest_coordinate(local)) * 2.4e-7f;
    return rounding;
}

/// How much of a contact's depth is of which kind, m.
struct Depth {
    float pressed;  // the particle's motion into the surface, which contact takes away and which friction is paid for
    float led;      // what leads it out of an overlap in which it began the substep: no velocity, and without friction
};

/// Returns how far a particle has moved into a surface: `by_motion`, which keeps its digits in a short substep but is
/// right to second order in its length alone, unless it is not within rounding of what positions show.
SHARED float moved_inward(float by_motion, float shown, float rounding) {
    precise float apart = by_motion - shown;
    return abs(apart) > rounding ? shown : by_motion;
}

/// Returns the depth of a contact. `before`: how deep the particle was when the substep began, negative outside;
/// `by_motion`, `shown`: how far it has moved into the surface since, by its motion and by its places; `recovery`: how
/// much of an overlap a substep resolves, so that it does not become speed. Contact leaves particles `rounding` deep,
/// but not where a mesh `deforms`: beside a kink of its field a fast wall would have them on its other side. One that
/// is within rounding of that lies on the surface: all of its motion inward is taken away, since in a short substep
/// that is less than positions show.
SHARED Depth contact_depth(float before, float by_motion, float shown, float recovery, float rounding, bool deforms) {
    precise float deep = before - (deforms ? 0.0f : rounding);
    float outside = deep < -rounding ? deep : 0.0f;
    float overlap = deep > rounding ? deep : 0.0f;
    float leads = overlap < recovery ? overlap : recovery;
    precise float depth = moved_inward(by_motion, shown, rounding) + outside + leads;
    if (!(depth > 0.0f)) return Depth(0.0f, 0.0f);
    float led = depth < leads ? depth : leads;
    precise float pressed = depth - led;
    return Depth(pressed, led);
}

#endif
