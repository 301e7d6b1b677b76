// This pass measures the stretch error within a substep. An invocation takes residual_rows particles of a column, each
// with the stretch springs that it owns, and each workgroup writes a record. Where `masked`, the spring shares come
// from an image (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/residual.h"
#include "include/spring.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(ResidualPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, r32f) uniform readonly image2D tension_row;
layout(set = 0, binding = 3, r32f) uniform readonly image2D tension_column;
layout(set = 0, binding = 4, std430) writeonly buffer Residuals { ResidualRecord residuals[]; };
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D spring_shares;
#define LOAD(name, texel) imageLoad(name, texel)
#include "include/rest_length.h"

#define RECORD ResidualRecord
#include "include/workgroup_reduction.h"

ResidualRecord with_spring(ResidualRecord record, ivec2 first, ivec2 offset, float rest_length, int channel,
                           float tension) {
    ivec2 second = first + offset;
    if (first.x >= push.grid.x || second.x >= push.grid.x || second.y >= push.grid.y) return record;
    float share = 1.0f;
    if (masked) share = imageLoad(spring_shares, first)[channel];
    vec3 edge = spring_edge(imageLoad(position, first).xyz, imageLoad(position, second).xyz,
                            imageLoad(displacement, first).xyz, imageLoad(displacement, second).xyz);
    return add_residual(record, edge, length_at_rest(rest_length, first, channel), share, push.compression, tension);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * uint(residual_rows));
    ResidualRecord record = empty_residual();
    for (int row = 0, rows = rows_of(texel, residual_rows, push.grid);;) {
        record = with_spring(record, texel, ivec2(1, 0), push.rest_length.x, 0, imageLoad(tension_row, texel).x);
        record = with_spring(record, texel, ivec2(0, 1), push.rest_length.y, 1, imageLoad(tension_column, texel).x);
        ++texel.y;
        if (++row >= rows) break;
    }
    record = joined_over_workgroup(record);
    if (gl_LocalInvocationIndex == 0u) residuals[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = record;
}
