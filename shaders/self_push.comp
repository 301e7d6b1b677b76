// Moves the particles by what the pairs push them, and keeps what they were to do before it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
layout(set = 0, binding = 1, rgba32f) uniform image2D displacements;
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) buffer Corrections { ivec4 corrections[]; };
layout(set = 0, binding = 5, std430) buffer Before { vec4 before[]; };

void main() {
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    for (int place = int(gl_GlobalInvocationID.x); place < push.grid.x * push.grid.y; place += stride) {
        int owner = owner_of(place);
        if (owner < 0) continue;
        ivec2 texel = texel_of(place);
        vec4 moved = imageLoad(displacements, texel);
        for (int go = push.round == 0 ? 1 : 0; go > 0; --go) before[place] = vec4(moved.xyz, 0.0f);
        ivec4 sum = corrections[place];
        if (sum.w == 0 || !(imageLoad(positions, texel).w > 0.0f)) continue;
        corrections[place] = ivec4(0, 0, 0, 0);
        float thickness = cloths[owner].thickness;
        vec3 corrected = self_corrected(moved.xyz, sum, thickness);
        imageStore(displacements, texel, vec4(self_bounded(corrected, before[place].xyz, thickness), moved.w));
        before[place].w = 1.0f;
    }
}
