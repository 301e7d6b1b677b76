// Contact of a particle with every collider of the scene. The includer calls read_colliders first of all, and has
// GL_EXT_control_flow_attributes.
#include "include/colliders.h"

/// Most colliders whose records are read where nothing has branched yet: the default device loads there once what else
/// it loads for every particle anew, number by number (docs/devices.md). Loops over them are unrolled, so that each is
/// a handful of constants.
const int early_collider_count = 8;
ColliderRecord early_colliders[early_collider_count];

void read_colliders(int first) {
    [[unroll]] for (int i = 0; i < early_collider_count; ++i) {
        if (i < capsules_end) early_colliders[i] = colliders[first + i];
    }
}

#define NEAR(kind, collider) near = near || !beyond_reach(kind, collider, now, thickness);
#define CONTACT(kind, collider)                                                                             \
    Contact contact = collider_contact(kind, collider, start, displacement, thickness, friction, recovery); \
    if (in_turn) displacement = contact.displacement;                                                       \
    deepest = contact.depth > deepest ? contact.depth : deepest;
#define EACH_EARLY(WORK, kind, begin, end) \
    [[unroll]] for (int i = begin; i < min(end, early_collider_count); ++i) { WORK(kind, early_colliders[i]) }
#define EACH(WORK, kind, begin, end)                               \
    EACH_EARLY(WORK, kind, begin, end)                             \
    for (int i = max(begin, early_collider_count); i < end; ++i) { \
        WORK(kind, colliders[first + i])                           \
    }
#define EACH_COLLIDER(WORK)                                                                        \
    EACH(WORK, kind_plane, 0, planes_end)                                                          \
    EACH(WORK, kind_sphere, planes_end, spheres_end)                                               \
    EACH(WORK, kind_box, spheres_end, boxes_end)                                                   \
    if (boxes_end < ellipsoids_end) { /* else a loop within it keeps lavapipe from leaving this one out */ \
        EACH(WORK, kind_ellipsoid, boxes_end, ellipsoids_end)                                      \
    }                                                                                              \
    EACH(WORK, kind_capsule, ellipsoids_end, capsules_end)

/// Whether a point may be nearer than the thickness to any collider from `first` on; if not, contact leaves it.
bool near_any(int first, vec3 now, float thickness) {
    bool near = false;
    EACH_COLLIDER(NEAR)
    return near;
}

/// Contact with every collider from `first` on. `in_turn`: each takes the displacement that those before it left, else
/// the given one, and only the depth counts.
Contact contact_with_all(int first, vec3 start, vec3 displacement, float thickness, float friction, float recovery,
                         bool in_turn) {
    float deepest = 0.0f;
    EACH_COLLIDER(CONTACT)
    return Contact(displacement, deepest);
}
