// This pass computes the displacement that leads a cloth apart from those that it started through and still crosses,
// with one invocation per cloth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_apart.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, std430) readonly buffer Crossed { SelfCrossed crossed[]; };
layout(set = 0, binding = 1, std430) readonly buffer Crossings { SelfCrossings crossings[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Led { vec4 led[]; };
layout(set = 0, binding = 3, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 4, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"

void main() {
    int cloth = int(gl_GlobalInvocationID.x), count = 0;
    if (cloth >= push.cloth_count) return;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < push.crossed_count; ++k) {
        sum = self_led_apart(sum, crossed[k], cloth, self_lacking(crossings[k], self_parting(push.step)));
        count += crossings[k].count;
    }
    led[cloth] = vec4(sum, 0.0f);
    if (cloth > 0) return;
    record[0].crossing_count = uint(count);
    dispatch(self_size_push, count > 0 ? uint(push.grid.x * push.grid.y) : 0u);
}
