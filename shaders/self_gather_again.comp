// This pass lays those of a cloth's particles on the sheet again that colliders have moved since all were laid there.
// It tells them by a displacement that differs from the sheet's in any bit. Where a collider led one out of an overlap,
// it started elsewhere on the sheet, and the way from there is part of its displacement: contact makes a motion of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants BUFFERED
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "include/contact_law.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfClothPush)
#define STATE_COLUMNS push.columns
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;  // the sheet's; w: bits (self_sheet.h)
TRIPLE_OUT(2, DisplacementsOut, displacements_out);
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D positions;  // the sheet's
layout(set = 0, binding = 5, std430) buffer Before { vec4 before[]; };     // w: self_pushed and those beside it
layout(set = 0, binding = 6, std430) writeonly buffer LedWays { vec4 led_ways[]; };

bool has_moved(ivec2 texel) {
    ivec3 is = floatBitsToInt(imageLoad(displacement, texel).xyz);
    ivec3 was = floatBitsToInt(imageLoad(displacements_in, push.first + texel).xyz);
    ivec3 change = is ^ was;
    return (change.x | change.y | change.z) != 0;
}

void lay(ivec2 texel) {
    ivec2 laid = push.first + texel;
    STORE_TRIPLE(displacements_out, laid, imageLoad(displacement, texel).xyz, imageLoad(displacements_in, laid).w);
    vec3 start = imageLoad(positions, laid).xyz, way = way_between(start, imageLoad(position, texel).xyz);
    if (!is_rounding(start, way)) {
        int place = laid.y * push.columns + laid.x;
        led_ways[place] = vec4(way, 0.0f);
        before[place].w = before[place].w != 0.0f ? self_pushed_and_led : self_led_out;
    }
}

void main() { FOR_STRIP_FOUND(texel, push.grid, has_moved(texel), lay(texel)) }
