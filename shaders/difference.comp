// This pass measures how far a frame is from that of a coarser run. An invocation takes difference_rows particles of a
// column, and each workgroup writes a record.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/difference.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D coarse_position;
layout(set = 0, binding = 2, std430) writeonly buffer Partials { DifferenceRecord partials[]; };

#define RECORD DifferenceRecord
#include "include/workgroup_reduction.h"

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * uint(difference_rows));
    DifferenceRecord record = empty_difference();
    for (int row = 0, rows = rows_of(texel, difference_rows, push.grid);;) {
        vec4 at = LOAD(position, texel);  // w: 0 outside the grid
        record = joined(record, particle_difference(at.w, at.xyz, LOAD(coarse_position, texel).xyz));
        ++texel.y;
        if (++row >= rows) break;
    }
    record = joined_over_workgroup(record);
    if (gl_LocalInvocationIndex == 0u)
        partials[(cloth_place() * gl_NumWorkGroups.y + gl_WorkGroupID.y) * gl_NumWorkGroups.x + gl_WorkGroupID.x] =
            record;
}
