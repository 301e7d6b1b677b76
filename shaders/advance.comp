// Ends a frame: X += d, so that the position image holds the state that is drawn and read back. HOME: after an odd
// number of explicit steps; both go back from the spare images to those that the next frame starts from.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants HOME
#include "shared/simulation_types.h"
#include "include/verlet.h"
#include "include/substep_state.h"

layout(push_constant) uniform Push { GridPush push; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 moved = imageLoad(displacement_in, texel);
    advance_position(texel, imageLoad(position_in, texel), moved.xyz);
#ifdef HOME
    imageStore(displacement_out, texel, moved);
#endif
}
