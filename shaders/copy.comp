// This pass copies a buffer, to measure a GPU's memory bandwidth: unlike a copy command, it moves what a pass can move.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"

layout(local_size_x = workgroup_width) in;
layout(set = 0, binding = 0, std430) readonly buffer Source { vec4 source[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Target { vec4 target[]; };

void main() {
    uint i = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * uint(workgroup_width)) + gl_GlobalInvocationID.x;
    if (i < uint(source.length())) target[i] = source[i];
}
