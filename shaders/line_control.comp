// This pass decides for each cloth of a dispatch whether the coming substep is BDF2 or backward Euler.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "include/bdf2.h"
#include "include/push.h"

layout(local_size_x = 1) in;
PUSH_CONSTANTS(LineControlPush)
layout(set = 0, binding = 0, r32ui) uniform readonly uimage2D line_control_in;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D line_control_out;

uint control_at(int texel) { return imageLoad(line_control_in, ivec2(texel, gl_WorkGroupID.z)).x; }

void store_control(int texel, uint value) { imageStore(line_control_out, ivec2(texel, gl_WorkGroupID.z), uvec4(value, 0u, 0u, 0u)); }

void main() {
    LineControl next = next_control(
        LineControl(control_at(control_order), control_at(control_wrong_lines), control_at(control_hold)),
        push.most_wrong);
    store_control(control_order, next.order);
    store_control(control_wrong_lines, next.wrong_lines);
    store_control(control_hold, next.hold);
}
