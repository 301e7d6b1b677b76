// This pass ends a frame: X += d, so that the position image holds the state that is drawn and read back. HOME brings
// position and displacement back from the spare images, where an odd number of explicit steps leaves them, to those
// that the next frame starts from. EXCESS keeps how much faster the cloth is at the frame's end than in its last
// substep.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants HOME EXCESS BUFFERED
#include "shared/simulation_types.h"
#include "include/end_velocity.h"
#include "include/push.h"
#include "include/verlet.h"
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#ifndef HOME
#define IN_PLACE
#endif
#include "include/strips.h"
#include "include/substep_state.h"

layout(constant_id = 0) const bool touches = false;
#ifdef EXCESS
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D displacement_before;  // of the substep before the last
VECTOR_OUT(10, EndExcessOut, end_excess_out);
#endif

void finish(ivec2 texel) {
    vec4 moved = LOAD(displacement_in, texel);
    advance_position(texel, LOAD(position_in, texel), moved.xyz);
#ifdef EXCESS
    vec3 excess = end_excess(moved.xyz, LOAD(displacement_before, texel).xyz, touches ? contact_excess : free_excess);
    STORE_VECTOR(end_excess_out, texel, vec4(excess, 0.0f));
#endif
#ifdef HOME
    STORE_VECTOR(displacement_out, texel, moved);
    STORE_VECTOR(displacement_remainder_out, texel, LOAD(displacement_remainder_in, texel));
#endif
}

void main() { FOR_STRIP(texel, push.grid, finish(texel)) }
