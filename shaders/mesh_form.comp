// This pass computes, for every sample of the field of a mesh that deforms, the distances to the mesh at the frame's
// start and end, and how far the surface near it moves. Each invocation computes one sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "shared/form_types.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(FormPush)
layout(set = 0, binding = 0, std430) readonly buffer FormNodes { FormNode form_nodes[]; };
layout(set = 0, binding = 1, std430) readonly buffer FormCorners { vec4 form_corners[]; };
layout(set = 0, binding = 2, std430) readonly buffer FormGuesses { uint form_guesses[]; };
layout(set = 0, binding = 3, std430) readonly buffer FormSides { uint form_sides[]; };
layout(set = 0, binding = 4, std430) buffer MeshFields { vec4 mesh_fields[]; };
layout(set = 0, binding = 5, std430) writeonly buffer FormDistances { vec2 form_distances[]; };
#include "include/forms.h"

void main() {
    int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y), z = int(gl_GlobalInvocationID.z);
    if (x >= push.size.x) return;
    FormSample found = form_sample(push, x, y, z);
    int sample_number = (z * push.size.y + y) * push.size.x + x;
    form_distances[push.first_distance + sample_number] = vec2(found.begin, found.end);
    mesh_fields[push.size.w + 3 * sample_number + 2] = vec4(found.way, 0.0f);
}
