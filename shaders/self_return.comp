// This pass ends a substep for those of a cloth's particles that contact has moved. It leaves them their velocity as the
// substep's displacement and shifts them, so that they end where contact let them: what it held back, or led apart, is
// no velocity. HISTORY has a method of second order go on from that velocity, and the cloth in backward Euler substeps
// (include/bdf2.h). BEFORE, in a frame's last substep, has other methods end the frame with that velocity, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants HISTORY|BEFORE BUFFERED
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfClothPush)
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(1, DisplacementOut, displacement_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacements;   // on the sheet
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer before;      // w: 1 where contact moved a particle
layout(set = 0, binding = 4, rgba32f) uniform readonly imageBuffer velocities;  // of those
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D position_in;
TRIPLE_OUT(6, PositionOut, position_out);
#if defined(HISTORY) || defined(BEFORE)
VECTOR_KEPT(7, DisplacementBefore, displacement_before);
#endif
#ifdef HISTORY
layout(set = 0, binding = 8, r32ui) uniform uimage2D line_control;
#endif

int place_of(ivec2 laid) { return laid.y * push.columns + laid.x; }

bool was_moved(ivec2 texel) { return imageLoad(before, place_of(push.first + texel)).w != 0.0f; }

void take(ivec2 texel) {
    ivec2 laid = push.first + texel;
    vec3 made = imageLoad(displacements, laid).xyz, velocity = imageLoad(velocities, place_of(laid)).xyz;
    vec4 start = imageLoad(position_in, texel);
    STORE_TRIPLE(position_out, texel, self_start(start.xyz, made, velocity), start.w);
    STORE_TRIPLE(displacement_out, texel, velocity, imageLoad(displacement_in, texel).w);
#if defined(HISTORY) || defined(BEFORE)
    STORE_VECTOR(displacement_before, texel, vec4(velocity, 0.0f));
#endif
#ifdef HISTORY
    // The load spares an atomic, as most particles that come here find the hold set.
    if (imageLoad(line_control, ivec2(control_hold, 0)).x < line_hold_contact)
        imageAtomicMax(line_control, ivec2(control_hold, 0), line_hold_contact);
#endif
}

void main() { FOR_STRIP_FOUND(texel, push.grid, was_moved(texel), take(texel)) }
