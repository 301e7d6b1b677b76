// This pass copies a field of the state of cloths together, of those that are present. SCALAR copies images of one
// float, INTEGER of one integer; else they have four floats.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SCALAR|INTEGER
#include "shared/simulation_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#include "include/together.h"
#ifdef INTEGER
layout(set = 0, binding = 0, r32ui) uniform readonly uimage2D source;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D target;
#elif defined(SCALAR)
layout(set = 0, binding = 0, r32f) uniform readonly image2D source;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D target;
#else
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D source;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x < push.grid.x && texel.y < push.grid.y) imageStore(target, placed(texel), LOAD(source, texel));
}
