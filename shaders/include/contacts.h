// Contact of a particle with every collider of the scene. The includer calls read_colliders before anything else, and
// has GL_EXT_control_flow_attributes.
#include "include/colliders.h"
#include "include/skin.h"

/// Records of up to this many colliders are read before anything has branched: there the default device loads them
/// once, elsewhere again for every particle and number by number (docs/devices.md). Loops over them are unrolled, so
/// that each record is a handful of constants.
const int early_collider_count = 8;
ColliderRecord early_colliders[early_collider_count];

void read_colliders(int first) {
    [[unroll]] for (int i = 0; i < early_collider_count; ++i) {
        if (i < meshes_end) early_colliders[i] = colliders[first + i];
    }
}

/// The same records as texels. The bounds of the colliders after the early ones are read here, which on the default
/// device is several times as fast (docs/devices.md).
layout(set = 0, binding = 7, rgba32f) uniform readonly imageBuffer collider_texels;
const int collider_texel_count = 8, collider_shape_texel = 6, collider_motion_texel = 7;  // texels of a record

#if COLLIDER_KINDS != 6
#error "kind_of_collider takes the new kind for a capsule; near_early and contact_with_all leave it out"
#endif
int kind_of_collider(int i) {
    if (has_meshes)
        if (i >= capsules_end) return kind_mesh;
    return i < planes_end       ? kind_plane
           : i < spheres_end    ? kind_sphere
           : i < boxes_end      ? kind_box
           : i < ellipsoids_end ? kind_ellipsoid
                                : kind_capsule;
}

/// Returns a ball about collider i, counted from `first`, that contains the end of any particle that meets the
/// collider: centre and radius, m, without the thickness. `length`: how far the particle moves at most; below 0 if only
/// its end counts.
vec4 collider_ball(int first, int i, float length, float thickness) {
    int texel = (first + i) * collider_texel_count, kind = kind_of_collider(i);
    vec3 size = imageLoad(collider_texels, texel + collider_shape_texel).xyz;
    float motion = imageLoad(collider_texels, texel + collider_motion_texel).w;
    // Where the cloth is thinner, a shorter motion already counts as far (way_reach).
    bool far = length >= 0.0f && goes_far(kind, size, length, motion, has_skin ? 0.0f : thickness);
    precise float behind = (most_way(length, motion) + thickness) * 2.0f;
    float reach = far ? behind : thickness;
    precise float radius = bounding_radius(kind, size) + (reach - thickness);
    if (has_meshes)
        if (kind == kind_mesh) {
            precise float grown = radius + imageLoad(collider_texels, texel + collider_motion_texel).y;
            radius = grown;
        }
    return vec4(imageLoad(collider_texels, texel).w, imageLoad(collider_texels, texel + 1).w,
                imageLoad(collider_texels, texel + 2).w, radius);
}

layout(constant_id = 18) const bool leaves_out = true;  // skip colliders that are out of reach

/// Returns the next collider, from the i-th on, that a particle may meet; `end` if there is none.
int next_near(int first, int i, int end, vec3 start, vec3 displacement, float thickness, bool all_its_way) {
    vec3 now = moved_position(start, displacement);
    float length = all_its_way ? length_of(displacement) : -1.0f;
    while (leaves_out && i < end && !near_ball(collider_ball(first, i, length, thickness), now, now, thickness)) ++i;
    return i;
}

#define NEAR(kind, collider)                          \
    near = near || !beyond_reach(kind, collider, now, \
                                 way_reach(kind, size_of(collider), length, collider.way_out.w, thickness));
#ifndef ON_CONTACT
#define ON_CONTACT(number, contact, before)  // what the includer does with a contact, before the displacement changes
#endif
#define CONTACT(kind, collider)                                                                                       \
    went_far = went_far || goes_far(kind, size_of(collider), length_of(displacement), collider.way_out.w, thickness); \
    Contact contact = collider_contact(kind, collider, start, displacement, thickness, friction, recovery, follows);  \
    ON_CONTACT(i, contact, displacement)                                                                              \
    if (in_turn) displacement = contact.displacement;                                                                 \
    lost = contact.depth > deepest ? contact.lost : lost;                                                             \
    normal = contact.depth > deepest ? contact.normal : normal;                                                       \
    grip = contact.depth > deepest ? contact.grip : grip;                                                             \
    led = led_sum(led, contact.led);                                                                                  \
    deepest = contact.depth > deepest ? contact.depth : deepest;
#define EACH_EARLY(WORK, kind, begin, end) \
    [[unroll]] for (int i = begin; i < min(end, early_collider_count); ++i) { WORK(kind, early_colliders[i]) }
#define CONTACTS(kind, begin, end)                                                                                \
    EACH_EARLY(CONTACT, kind, begin, end)                                                                         \
    if (end > early_collider_count) { /* else lavapipe does not leave the loops out */                            \
        int i = next_near(first, max(begin, early_collider_count), end, start, displacement, thickness, in_turn); \
        for (; i < end; i = next_near(first, i + 1, end, start, displacement, thickness, in_turn)) {              \
            CONTACT(kind, colliders[first + i])                                                                   \
        }                                                                                                         \
    }

/// Returns whether a particle that ends at a point may meet one of the early colliders; if not, none of them moves it.
bool near_early(vec3 now, float length, float thickness) {
    bool near = false;
    EACH_EARLY(NEAR, kind_plane, 0, planes_end)
    EACH_EARLY(NEAR, kind_sphere, planes_end, spheres_end)
    EACH_EARLY(NEAR, kind_box, spheres_end, boxes_end)
    EACH_EARLY(NEAR, kind_ellipsoid, boxes_end, ellipsoids_end)
    EACH_EARLY(NEAR, kind_capsule, ellipsoids_end, capsules_end)
    if (has_meshes) {
        EACH_EARLY(NEAR, kind_mesh, capsules_end, meshes_end)
    }
    return near;
}

/// Returns the contact with all colliders from `first` on. With `in_turn`, each collider takes the displacement that
/// the earlier ones left; otherwise all take the given one, and only the depth at its end counts. Without `follows`, a
/// particle that goes so far that its path must be followed is judged by its end alone, and `went_far` becomes true.
/// Normal, grip and what was lost are those of the deepest contact. A sum of what was lost would be wrong: lavapipe
/// adds once more for lanes that have left a loop which others go on with.
Contact contact_with_all(int first, vec3 start, vec3 displacement, float thickness, float friction, float recovery,
                         bool in_turn, bool follows, inout bool went_far) {
    float deepest = 0.0f;
    vec3 normal = vec3(0.0f);
    vec4 grip = vec4(0.0f);
    vec3 led = vec3(0.0f), lost = vec3(0.0f);
    CONTACTS(kind_plane, 0, planes_end)
    // The loops within these branches would prevent lavapipe from skipping them.
    if (planes_end < spheres_end) {
        CONTACTS(kind_sphere, planes_end, spheres_end)
    }
    if (spheres_end < boxes_end) {
        CONTACTS(kind_box, spheres_end, boxes_end)
    }
    if (boxes_end < ellipsoids_end) {
        CONTACTS(kind_ellipsoid, boxes_end, ellipsoids_end)
    }
    if (ellipsoids_end < capsules_end) {
        CONTACTS(kind_capsule, ellipsoids_end, capsules_end)
    }
    if (has_meshes) {
        CONTACTS(kind_mesh, capsules_end, meshes_end)
    }
    return Contact(displacement, deepest, normal, grip, led, lost);
}
