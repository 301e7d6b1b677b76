// This pass enters a cloth into the columns above the floor (include/ground_columns.h), with an invocation per
// triangle. Where the cloth is `cut`, there are vertices on its cut springs, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"
#include "shared/cut_types.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GroundColumnsPush)
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 2, std430) readonly buffer Triangles { uint triangles[]; };
layout(set = 0, binding = 3, std430) buffer Columns { uint columns[]; };
#include "include/cloth_vertex.h"

void enter(vec3 world) {
    vec4 point = vec4(world, 1.0);
    vec2 place = vec2(dot(push.rows[0], point), dot(push.rows[1], point));
    float height = max(dot(push.rows[2], point), 0.0);
    bool within = all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(ground_side)));
    if (!within) return;
    int column = int(place.y) * ground_side + int(place.x);
    atomicMin(columns[2 * column], floatBitsToUint(height));
    atomicMax(columns[2 * column + 1], floatBitsToUint(height));
}

void main() {
    uint first = 3u * gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= push.grid.z) return;
    vec3 corner = vertex_position(triangles[first]);
    vec3 along = vertex_position(triangles[first + 1u]) - corner,
         across = vertex_position(triangles[first + 2u]) - corner;
    float part = 1.0 / float(push.grid.w);
    for (uint i = 0u; i <= push.grid.w; ++i)
        for (uint j = 0u; i + j <= push.grid.w; ++j)
            enter(corner + (float(i) * part) * along + (float(j) * part) * across);
}
