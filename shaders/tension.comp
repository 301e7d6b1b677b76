// This pass computes the tension of the stretch springs that explicit steps gather, as the extension that it would
// cause, with which the statistics compare the strain. Every texel that owns a spring is written. A cloth with
// `own_rest` has the rest lengths of its springs in an image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/explicit.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(TensionPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, r32f) uniform writeonly image2D tension_row;
layout(set = 0, binding = 3, r32f) uniform writeonly image2D tension_column;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D spring_shares;
#include "include/rest_length.h"

float tension_to(ivec2 first, ivec2 second, int channel) {
    float rest_length = length_at_rest(push.rest_length[channel], first, channel);
    precise vec3 edge = LOAD(position, second).xyz - LOAD(position, first).xyz;
    precise vec3 closing = LOAD(displacement, second).xyz - LOAD(displacement, first).xyz;
    return gathered_tension(edge, closing, rest_length, push.used_share[channel], push.compression,
                            push.strain_damping);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    if (texel.x + 1 < push.grid.x) {
        float along_row = tension_to(texel, texel + ivec2(1, 0), 0);
        imageStore(tension_row, placed(texel), vec4(along_row, 0.0f, 0.0f, 0.0f));
    }
    if (texel.y + 1 < push.grid.y) {
        float along_column = tension_to(texel, texel + ivec2(0, 1), 1);
        imageStore(tension_column, placed(texel), vec4(along_column, 0.0f, 0.0f, 0.0f));
    }
}
