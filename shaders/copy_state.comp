// This pass copies a field of the state of those cloths together that are present. The image has one `integer`, one
// float (`scalar`), or four floats per texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#include "include/together.h"
layout(constant_id = 24) const bool integer = false;
layout(constant_id = 25) const bool scalar = false;
layout(set = 0, binding = 0, r32ui) uniform readonly uimage2D source_integer;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D target_integer;
layout(set = 0, binding = 0, r32f) uniform readonly image2D source_scalar;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D target_scalar;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D source;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    if (integer)
        imageStore(target_integer, placed(texel), LOAD(source_integer, texel));
    else if (scalar)
        imageStore(target_scalar, placed(texel), LOAD(source_scalar, texel));
    else
        imageStore(target, placed(texel), LOAD(source, texel));
}
