// This pass moves particles by the pulls of the elements whose tangents they define, in cloth that rests bent
// (include/bend_pull.h). Explicit steps gather these pulls themselves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bend_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/rest_bend.h"
#include "include/spring.h"
#include "include/verlet.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
#include "include/bend_target.h"
#include "include/bend_pull.h"

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 moved = LOAD(displacement_in, texel);
    float weight = dragged_weight(LOAD(position, texel).w, moved.w);
    STORE_VECTOR(displacement_out, texel, vec4(moved_by(moved.xyz, bend_pull(texel), weight), moved.w));
}
