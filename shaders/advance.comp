// This pass ends a frame: X += d, so that the position image holds the state that is drawn and read back. Where
// `comes_home`, position and displacement return from the spare images, in which an odd number of explicit steps leaves
// them, to those from which the next frame starts; likewise the line method's control after an odd number of substeps.
// The pass may also store how much faster the cloth is at the frame's end than in its last substep.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/end_velocity.h"
#include "include/push.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(AdvancePush)
#define TOGETHER
layout(constant_id = 24) const bool comes_home = false;
const bool in_place = !comes_home;
#include "include/strips.h"
#include "include/substep_state.h"

layout(constant_id = 25) const bool keeps_excess = false;
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D displacement_before;  // of the substep before the last
VECTOR_OUT(10, end_excess_out);

layout(constant_id = 26) const bool control_comes_home = false;
layout(set = 0, binding = 11, r32ui) uniform readonly uimage2D line_control_in;
layout(set = 0, binding = 12, r32ui) uniform writeonly uimage2D line_control_out;

void bring_control_home() {
    int texel = int(gl_GlobalInvocationID.x);
    ivec2 at = ivec2(texel, cloth_place());
    if (texel < control_texel_count && gl_GlobalInvocationID.y == 0u)
        imageStore(line_control_out, at, imageLoad(line_control_in, at));
}

void finish(ivec2 texel) {
    vec4 moved = LOAD(displacement_in, texel);
    advance_position(texel, LOAD(position_in, texel), moved.xyz);
    if (keeps_excess) {
        vec3 excess = end_excess(moved.xyz, LOAD(displacement_before, texel).xyz, push.half_share);
        STORE_VECTOR(end_excess_out, texel, vec4(excess, 0.0f));
    }
    if (!comes_home) return;
    STORE_VECTOR(displacement_out, texel, moved);
    STORE_VECTOR(displacement_remainder_out, texel, LOAD(displacement_remainder_in, texel));
}

void main() {
    if (control_comes_home) bring_control_home();
    FOR_STRIP(texel, push.grid, finish(texel))
}
