// This pass ends a substep for those of a cloth's particles that contact has moved. It leaves them their velocity as the
// substep's displacement and shifts them, so that they end where contact let them: what it held back, or led apart, is
// no velocity. HISTORY has the cloth go on in backward Euler substeps (include/bdf2.h). HISTORY and, in a frame's last
// substep of other methods, BEFORE change the displacement of the substep before as contact has changed this one's, so
// that the two tell the same acceleration by springs as without contact.
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
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer before;      // w: what moved a particle
layout(set = 0, binding = 4, rgba32f) uniform readonly imageBuffer velocities;  // of those
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D positions;       // on the sheet
TRIPLE_OUT(6, PositionOut, position_out);
#if defined(HISTORY) || defined(BEFORE)
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D displacement_before_in;
TRIPLE_OUT(9, DisplacementBeforeOut, displacement_before_out);
#endif
#ifdef HISTORY
layout(set = 0, binding = 8, r32ui) uniform uimage2D line_control;
#endif

int place_of(ivec2 laid) { return laid.y * push.columns + laid.x; }

bool was_moved(ivec2 texel) { return imageLoad(before, place_of(push.first + texel)).w != 0.0f; }

void take(ivec2 texel) {
    ivec2 laid = push.first + texel;
    vec3 made = imageLoad(displacements, laid).xyz, velocity = imageLoad(velocities, place_of(laid)).xyz;
    vec4 start = imageLoad(positions, laid);
    STORE_TRIPLE(position_out, texel, self_start(start.xyz, made, velocity), start.w);
    STORE_TRIPLE(displacement_out, texel, velocity, imageLoad(displacement_in, texel).w);
#if defined(HISTORY) || defined(BEFORE)
    vec3 last = imageLoad(displacement_before_in, texel).xyz;
    vec4 wanted = imageLoad(before, place_of(laid));
    if (wanted.w == self_pushed)
        STORE_TRIPLE(displacement_before_out, texel, self_changed_alike(last, wanted.xyz, velocity), 0.0f);
#endif
#ifdef HISTORY
    // The load spares an atomic, as most particles that come here find the hold set.
    if (imageLoad(line_control, ivec2(control_hold, 0)).x < line_hold_contact)
        imageAtomicMax(line_control, ivec2(control_hold, 0), line_hold_contact);
#endif
}

void main() { FOR_STRIP_FOUND(texel, push.grid, was_moved(texel), take(texel)) }
