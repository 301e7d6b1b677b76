// This pass begins a substep's contact. It finds the motion that all particles are measured against, which a few
// samples have in common, or none where some particles are always held. It also resets the records of the passes to
// come. One invocation works.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants CROSSED
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacements;
layout(set = 0, binding = 1, std430) readonly buffer Cloths { SelfCloth cloths[]; };
layout(set = 0, binding = 2, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 3, std430) buffer Sizes { uvec4 sizes[]; };
#ifdef CROSSED
layout(set = 0, binding = 4, std430) writeonly buffer Crossings { SelfCrossings crossings[]; };
#endif

vec3 sample_of(int k) {
    SelfCloth cloth = cloths[k / (self_samples * self_samples)];
    return imageLoad(displacements, cloth.first + self_sample(cloth.grid, k % (self_samples * self_samples))).xyz;
}

void main() {
    int samples = self_samples * self_samples * push.cloth_count;
    int count = gl_GlobalInvocationID.x == 0u ? samples : 0;
    precise vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < count; ++k) sum = sum + sample_of(k);
    vec3 mean = self_mean(sum, push.cloth_count);
    float least = 1.0f;
    for (int k = 0; k < count; ++k) least = self_least(least, self_part_made(sample_of(k), mean));
    if (gl_GlobalInvocationID.x > 0u) return;
    vec3 made = self_common_motion(mean, least);
    record[0].carried = vec4(push.held != 0 ? vec3(0.0f, 0.0f, 0.0f) : made, 0.0f);
    record[0].travel = vec4(self_travelled(record[0].travel.xyz, record[0].mean.xyz), 0.0f);
    record[0].mean = vec4(mean, 0.0f);
    record[0].point_count = 0u;
    record[0].edge_count = 0u;
    record[0].near_point_count = 0u;
    record[0].near_edge_count = 0u;
    record[0].cell_count = 0u;
    record[0].touching_point_count = 0u;
    record[0].touching_edge_count = 0u;
#ifdef CROSSED
    for (int k = 0; k < push.crossed_count; ++k) crossings[k] = SelfCrossings(0, 0);
#endif
    for (int k = self_size_of_substep; k < self_size_count; ++k) sizes[k] = uvec4(0u, 1u, 1u, 0u);
    if (push.first == 0) return;
    sizes[self_size_search].x = 1u;
    record[0].most_pairs = 0u;
    record[0].most_near = 0u;
    record[0].most_cells = 0u;
    record[0].most_touching = 0u;
    record[0].most_lag = 0u;
    record[0].unproved = 0u;
    record[0].truncated = 0u;
}
