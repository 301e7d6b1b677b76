// This pass measures how far each body is from where a coarser run, or one beside, has it: the squared distance of the
// centres of mass, m^2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/body_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/body_difference.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GridPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D bodies;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D coarse_bodies;
layout(set = 0, binding = 2, std430) writeonly buffer Distances { float distances[]; };

void main() {
    int number = int(gl_GlobalInvocationID.x);
    if (number >= push.grid.x) return;
    ivec2 place = ivec2(body_position, number), remainder = ivec2(body_remainder, number);
    distances[number] =
        body_distance(imageLoad(bodies, place).xyz, imageLoad(bodies, remainder).xyz,
                      imageLoad(coarse_bodies, place).xyz, imageLoad(coarse_bodies, remainder).xyz);
}
