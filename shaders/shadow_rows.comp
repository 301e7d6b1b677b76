// This pass copies the shadow map for fragments: every entry holds a texel's depth and those of the three texels to its
// right. A surface then reads the sixteen texels that it needs with four loads (include/shadow_map.h), which pays
// because there are many times as many fragments as texels. An invocation goes along part of a row and loads each texel
// once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const int texels_each = 4;  // divides the map's side, a multiple of 4
layout(set = 0, binding = 0, r32f) uniform readonly image2D shadow_map;
layout(set = 0, binding = 1, std430) writeonly buffer ShadowRows { vec4 shadow_rows[]; };

float depth_at(int column, int row) { return imageLoad(shadow_map, ivec2(min(column, shadow_map_size - 1), row)).x; }

void main() {
    const int parts = shadow_map_size / texels_each;
    int part = int(gl_GlobalInvocationID.x), row = part / parts;
    if (row >= shadow_map_size) return;
    int column = part % parts * texels_each, end = column + texels_each;
    vec4 near = vec4(depth_at(column, row), depth_at(column + 1, row), depth_at(column + 2, row), 0.0);
    for (;;) {
        int place = row * shadow_map_size + column;
        vec4 far = vec4(depth_at(column + 3, row), depth_at(column + 4, row), depth_at(column + 5, row),
                        depth_at(column + 6, row));
        shadow_rows[place] = vec4(near.xyz, far.x);
        shadow_rows[place + 1] = vec4(near.yz, far.xy);
        shadow_rows[place + 2] = vec4(near.z, far.xyz);
        shadow_rows[place + 3] = far;
        near = far.yzww;
        column += 4;
        if (column >= end) break;
    }
}
