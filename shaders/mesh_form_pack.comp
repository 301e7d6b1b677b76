// This pass packs the distances that mesh_form.comp computed into the texels of a field, four samples in each. Each
// invocation packs one sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "shared/form_types.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(FormPush)
layout(set = 0, binding = 0, std430) buffer MeshFields { vec4 mesh_fields[]; };
layout(set = 0, binding = 1, std430) readonly buffer FormDistances { vec2 form_distances[]; };
#include "include/form_sample.h"

vec2 distances_of(int x, int y, int z, int up, int far) {
    return form_distances[push.first_distance + sample_beside(push, x, y, z, up, far)];
}

void main() {
    int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y), z = int(gl_GlobalInvocationID.z);
    if (x >= push.size.x) return;
    vec2 here = distances_of(x, y, z, 0, 0), up = distances_of(x, y, z, 1, 0), far = distances_of(x, y, z, 0, 1),
         both = distances_of(x, y, z, 1, 1);
    int texel = push.size.w + 3 * sample_beside(push, x, y, z, 0, 0);
    mesh_fields[texel] = vec4(here.x, up.x, far.x, both.x);
    mesh_fields[texel + 1] = vec4(here.y, up.y, far.y, both.y);
    // The second texel in the field's header contains the share of the frame that a substep takes.
    if (x == 0 && y == 0 && z == 0) mesh_fields[push.size.w - 1].w = push.substep;
}
