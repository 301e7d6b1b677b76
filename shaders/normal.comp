// Normals of a cloth: area-weighted mean over the triangles around each particle, for drawing.
// MASKED: the cell image says which triangles exist (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED
#include "shared/simulation_types.h"
#include "include/triangles.h"
#include "include/wind.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { GridPush push; };
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D normal;
#ifdef MASKED
layout(set = 0, binding = 2, r32ui) uniform readonly uimage2D cells;
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec3 sum = empty_sum();
    for (int k = 0; k < triangles_around_particle; ++k) {
        ivec4 around = triangle_around(k);
        ivec2 cell = texel + around.xy;
        if (!cell_inside(cell, push.grid)) continue;
#ifdef MASKED
        if ((imageLoad(cells, placed_cell(cell)).x & uint(around.z)) == 0u) continue;
#endif
        sum = add_area_vector(sum, LOAD(position, cell + triangle_corner(around.z, 0)).xyz,
                              LOAD(position, cell + triangle_corner(around.z, 1)).xyz,
                              LOAD(position, cell + triangle_corner(around.z, 2)).xyz);
    }
    imageStore(normal, placed(texel), vec4(unit_or_zero(sum), 0.0f));
}
