// This pass begins a search for the pairs of cells that may meet, where the substep needs one: it sets the sizes of the
// search's passes. One invocation works.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 1, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"

/// Returns the workgroups of a pass with an invocation per entry.
uint groups_for(int count) { return uint((count + workgroup_width - 1) / workgroup_width); }

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    sizes[self_size_kept].x = groups_of(uint(push.grid.x * push.grid.y));
    for (int level = 1; level <= push.top; ++level) {
        int count = self_tree_count(push.grid, level);
        sizes[self_size_levels + level - 1].x = count <= self_tree_tail ? 1u : min(groups_for(count), self_most_groups);
    }
    sizes[self_size_blocks].x = groups_for(self_tree_count(push.grid, 1));
    record[0].block_count = 0u;
    record[0].candidate_count = 0u;
    record[0].travel = vec4(0.0f, 0.0f, 0.0f, 0.0f);
}
