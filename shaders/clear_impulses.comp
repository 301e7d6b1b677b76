// This pass begins the sums of a frame's impulses. One workgroup clears a cloth's.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/impulse_types.h"
#include "shared/simulation_types.h"
#include "include/present.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(ClearImpulsesPush)
layout(set = 0, binding = 0, r32ui) uniform writeonly uimage2D impulses;

void main() {
    int row = int(gl_GlobalInvocationID.x);
    while (row < push.rows) {
        for (int column = 0; column < impulse_columns; ++column) {
            uint cleared = row == impulse_head && column == 0 ? floatBitsToUint(push.units) : 0u;
            imageStore(impulses, ivec2(column, int(cloth_place()) * push.rows + row), uvec4(cleared, 0u, 0u, 0u));
        }
        row += workgroup_width;
    }
}
