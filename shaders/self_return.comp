// This pass moves those of a cloth's particles that contact has moved on the sheet. HISTORY gives such a particle the
// velocity of the displacement that it is left with, and has the cloth go on in backward Euler substeps
// (include/bdf2.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants HISTORY BUFFERED
#include "shared/line_types.h"
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfClothPush)
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(1, DisplacementOut, displacement_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacements;  // on the sheet
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer before_in;  // w: 1 where contact moved a particle
layout(set = 0, binding = 6, std430) writeonly buffer BeforeOut { vec4 before_out[]; };
#ifdef HISTORY
VECTOR_KEPT(4, DisplacementBefore, displacement_before);
layout(set = 0, binding = 5, r32ui) uniform uimage2D line_control;
#endif

int place_of(ivec2 laid) { return laid.y * push.columns + laid.x; }

bool was_moved(ivec2 texel) { return imageLoad(before_in, place_of(push.first + texel)).w != 0.0f; }

void take(ivec2 texel) {
    ivec2 laid = push.first + texel;
    before_out[place_of(laid)].w = 0.0f;
    vec3 displacement = imageLoad(displacements, laid).xyz;
    STORE_VECTOR(displacement_out, texel, vec4(displacement, imageLoad(displacement_in, texel).w));
#ifdef HISTORY
    STORE_VECTOR(displacement_before, texel, vec4(displacement, 0.0f));
    // The load spares an atomic, as most particles that come here find the hold set.
    if (imageLoad(line_control, ivec2(control_hold, 0)).x < line_hold_contact)
        imageAtomicMax(line_control, ivec2(control_hold, 0), line_hold_contact);
#endif
}

void main() { FOR_STRIP_FOUND(texel, push.grid, was_moved(texel), take(texel)) }
