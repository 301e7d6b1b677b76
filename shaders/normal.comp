// This pass computes the normals of a cloth, for drawing: the area-weighted mean over the triangles around each
// particle. Where `masked`, the cell image says which triangles exist (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/wind.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D normal;
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 2, r32ui) uniform readonly uimage2D cells;

#include "include/neighbourhood.h"

vec3 positions[neighbourhood_count];

void load_member(int place, ivec2 at) { positions[place] = LOAD(position, at).xyz; }

ivec2 texel;
vec3 sum = empty_sum();

void add_triangle(int k) {
    ivec4 around = triangle_around(k);
    vec3 more = add_area_vector(sum, positions[corner_in_neighbourhood(around, 0)],
                                positions[corner_in_neighbourhood(around, 1)],
                                positions[corner_in_neighbourhood(around, 2)]);
    if (triangle_exists(texel, around)) sum = more;
}

void main() {
    texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    FOR_NEIGHBOURHOOD(texel, load_member)
    FOR_TRIANGLES(add_triangle)
    imageStore(normal, placed(texel), vec4(unit_or_zero(sum), 0.0f));
}
