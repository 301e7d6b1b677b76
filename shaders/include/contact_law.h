// The law of contact with a collider's surface.
#ifndef DRAPE_CONTACT_LAW_H
#define DRAPE_CONTACT_LAW_H

#include "include/vector.h"
#include "shared/collider_types.h"

/// Returns the displacement after contact: the particle is moved out by `depth` along `normal`, and its motion relative
/// to the surface along the tangent is reduced by friction * depth, at most to zero (Jakobsen 2001; with depth g cos(a)
/// h^2 of a resting particle this is Coulomb's law). `displacement`, `surface` (the collider's own): m.
SHARED vec3 contact_displacement(vec3 displacement, vec3 surface, vec3 normal, float depth, float friction) {
    precise vec3 relative = displacement - surface;
    precise float along = ordered_dot(relative, normal);
    precise vec3 tangent = relative - normal * along;
    precise float squared = ordered_dot(tangent, tangent);
    precise float grip = friction * depth;
    precise vec3 pushed = displacement + normal * depth;
    if (!(squared > 0.0f) || !(grip > 0.0f)) return pushed;
    precise float sliding = sqrt(squared);
    precise float kept = sliding > grip ? grip / sliding : 1.0f;
    precise vec3 slowed = pushed - tangent * kept;
    return slowed;
}

SHARED vec3 support_normal(Support support) { return vec3(support.plane.x, support.plane.y, support.plane.z); }

/// Returns the displacement that a surface allows a particle.
SHARED vec3 supported(vec3 displacement, Support support) {
    vec3 normal = support_normal(support), surface = vec3(support.grip.x, support.grip.y, support.grip.z);
    precise float depth = support.plane.w - ordered_dot(normal, displacement);
    vec3 held = contact_displacement(displacement, surface, normal, depth, support.grip.w);
    return depth > 0.0f ? held : displacement;
}

/// Returns the vector from where a particle started to where it is led.
SHARED vec3 way_between(vec3 start, vec3 led) {
    precise vec3 way = led - start;
    return way;
}

/// Returns whether a displacement is no longer than the rounding of coordinates of this size.
SHARED bool is_rounding(vec3 start, vec3 way) {
    vec3 from = vec3(abs(start.x), abs(start.y), abs(start.z)), by = vec3(abs(way.x), abs(way.y), abs(way.z));
    float farther = from.x > from.y ? from.x : from.y, longer = by.x > by.y ? by.x : by.y;
    precise float rounded = (farther > from.z ? farther : from.z) * 1.2e-7f;
    return !((longer > by.z ? longer : by.z) > rounded);
}

#endif
