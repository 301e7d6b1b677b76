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

void main() {
    read_colliders(push.first);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 start = LOAD(position, texel);
    if (start.w == 0.0f) return;
    vec4 moved = LOAD(displacement_in, texel);
    vec3 displacement = moved.xyz;
    bool touched = false;
#ifdef LED
    vec4 led = LOAD(lifted, texel);
    displacement = led.xyz;
    touched = led.w > 0.0f;
#endif
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
