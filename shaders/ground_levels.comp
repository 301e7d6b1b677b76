// This pass makes the coarser maps of the columns above the floor (include/ground_columns.h), with an invocation for
// each of their columns.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"
#include "include/ground_columns.h"

layout(local_size_x = workgroup_width) in;
layout(set = 0, binding = 0, std430) buffer Columns { uint columns[]; };

void main() {
    int place = int(gl_GlobalInvocationID.x) + ground_level(1), level = 1;
    if (place >= ground_level(ground_levels)) return;
    while (place >= ground_level(level + 1)) ++level;
    int index = place - ground_level(level), side = ground_side >> level, block = 1 << level;
    ivec2 first = ivec2(index % side, index / side) * block;
    uint low = no_height, high = 0u;
    for (int y = 0; y < block; ++y)
        for (int x = 0; x < block; ++x) {
            int column = (first.y + y) * ground_side + first.x + x;
            low = min(low, columns[2 * column]);
            high = max(high, columns[2 * column + 1]);
        }
    columns[2 * place] = low;
    columns[2 * place + 1] = high;
}
