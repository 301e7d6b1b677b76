// This pass lays those of a cloth's particles on the sheet again that colliders have moved since all were laid there.
// It tells them by a displacement that differs from the sheet's in any bit.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfClothPush)
#define STATE_COLUMNS push.sheet.x
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;  // the sheet's; w: bits (self_sheet.h)
TRIPLE_OUT(2, DisplacementsOut, displacements_out);

bool has_moved(ivec2 texel) {
    ivec3 is = floatBitsToInt(imageLoad(displacement, texel).xyz);
    ivec3 was = floatBitsToInt(imageLoad(displacements_in, push.first + texel).xyz);
    ivec3 change = is ^ was;
    return (change.x | change.y | change.z) != 0;
}

void lay(ivec2 texel) {
    ivec2 laid = push.first + texel;
    STORE_TRIPLE(displacements_out, laid, imageLoad(displacement, texel).xyz, imageLoad(displacements_in, laid).w);
}

void main() { FOR_STRIP_FOUND(texel, push.grid, has_moved(texel), lay(texel)) }
