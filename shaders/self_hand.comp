// This pass hands those of a cloth's particles that contact has moved on the sheet to the colliders.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfClothPush)
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(1, DisplacementOut, displacement_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacements;  // on the sheet
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer before;     // w: 1 where contact moved a particle

bool was_moved(ivec2 texel) {
    ivec2 laid = push.first + texel;
    return imageLoad(before, laid.y * push.sheet.x + laid.x).w != 0.0f;
}

void hand(ivec2 texel) {
    vec3 displacement = imageLoad(displacements, push.first + texel).xyz;
    STORE_TRIPLE(displacement_out, texel, displacement, imageLoad(displacement_in, texel).w);
}

void main() { FOR_STRIP_FOUND(texel, push.grid, was_moved(texel), hand(texel)) }
