// This pass runs before a frame with substeps of another length. It replaces the state's history by the one that
// substeps of that length would have left; in `second_order` also the line solver's history.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/closed_loop_types.h"
#include "shared/simulation_types.h"
#include "include/end_velocity.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(ChangeSubstepPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D displacement_in;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D displacement_out;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D displacement_remainder;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D end_excess_in;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D end_excess_out;
layout(set = 0, binding = 5, std430) readonly buffer Attempt { SubstepChange attempt[]; };
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 6, rgba32f) uniform writeonly image2D displacement_before;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D velocity_excess;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    SubstepChange change = attempt[push.cloth + int(cloth_place())];
    ChangedSubstep changed =
        changed_substep(LOAD(displacement_in, texel).xyz, LOAD(end_excess_in, texel).xyz, change);
    imageStore(displacement_out, placed(texel), vec4(changed.displacement, 0.0f));
    imageStore(displacement_remainder, placed(texel), vec4(0.0f, 0.0f, 0.0f, 0.0f));
    imageStore(end_excess_out, placed(texel), vec4(changed.excess, 0.0f));
    if (!second_order) return;
    imageStore(displacement_before, placed(texel), vec4(changed.before, 0.0f));
    imageStore(velocity_excess, placed(texel), vec4(changed.excess_before, 0.0f));
}
