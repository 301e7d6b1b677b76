// Moves every particle out of every collider, with friction; specialised to the kinds that the scene has. HISTORY: what
// is touched is at once as fast as it is left, and the cloth goes on in backward Euler substeps (include/bdf2.h). LED: on
// from what the edges of boxes left (box_edges.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#pragma variants HISTORY LED BUFFERED
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/contacts.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 16) const int round_count = 1;  // 1 when the scene has one collider: nothing can overlap
layout(constant_id = 17) const int strip_rows = 1;   // particles of a column that an invocation looks after, 32 at most
layout(push_constant) uniform Push { CollisionPush push; };
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, DisplacementOut, displacement_out);
#ifdef HISTORY
VECTOR_KEPT(3, DisplacementBefore, displacement_before);
layout(set = 0, binding = 4, r32ui) uniform uimage2D control;
#endif
#ifdef LED
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D lifted;
#endif

/// Where a particle is about to go; w of `led`: whether an edge of a box led it there.
vec4 led_displacement(ivec2 texel, vec4 moved) {
#ifdef LED
    return LOAD(lifted, texel);
#else
    return vec4(moved.xyz, 0.0f);
#endif
}

/// Which particles of a strip of a column may touch a collider, or have: bit k is row k.
uint near_rows(int column, int first, int count) {
    uint rows = 0u;
    for (int k = 0; k < count; ++k) {
        ivec2 texel = ivec2(column, first + k);
        vec4 start = LOAD(position, texel), led = led_displacement(texel, LOAD(displacement_in, texel));
        bool near = led.w > 0.0f || near_any(push.first, moved_position(start.xyz, led.xyz), push.contact.x);
        rows |= near && start.w != 0.0f ? 1u << k : 0u;
    }
    return rows;
}

void meet_all(ivec2 texel) {
    vec4 start = LOAD(position, texel), moved = LOAD(displacement_in, texel), led = led_displacement(texel, moved);
    vec3 displacement = led.xyz;
    bool touched = led.w > 0.0f;
    // Out of one collider may be into another: repeat until nothing is touched any more.
    for (int round = 0; round < round_count; ++round) {
        Contact contact = contact_with_all(push.first, start.xyz, displacement, push.contact.x, push.contact.y,
                                           push.contact.w, true);
        displacement = contact.displacement;
        touched = touched || contact.depth > 0.0f;
        if (!(contact.depth > push.contact.z)) break;
    }
    if (!touched) return;
    STORE_VECTOR(displacement_out, texel, vec4(displacement, moved.w));
#ifdef HISTORY
    STORE_VECTOR(displacement_before, texel, vec4(displacement, 0.0f));
    // Most that come here find it done.
    if (imageLoad(control, ivec2(control_hold, gl_WorkGroupID.z)).x < line_hold_contact)
        imageAtomicMax(control, ivec2(control_hold, gl_WorkGroupID.z), line_hold_contact);
#endif
}

void main() {
    read_colliders(push.first);
    int column = int(gl_GlobalInvocationID.x), first = int(gl_GlobalInvocationID.y) * strip_rows;
    if (column >= push.grid.x || first >= push.grid.y) return;
    int count = min(strip_rows, push.grid.y - first);
    // The default device runs a loop's body at least once for all lanes: here once for a strip, not for a particle.
    for (uint rows = near_rows(column, first, count); rows != 0u; rows &= rows - 1u)
        meet_all(ivec2(column, first + findLSB(rows)));
}
