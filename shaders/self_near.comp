// This pass lists the pairs of cells, none close in their cloth, whose triangles and edges this substep may bring
// together: the candidates whose boxes are near enough.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_tree.h"
layout(set = 0, binding = 1, std430) readonly buffer Candidates { ivec2 candidates[]; };
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 6, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"

void judge(ivec2 pair) {
    float thickness = self_mean_thickness(cloth_at(texel_of(pair.x)), cloth_at(texel_of(pair.y)));
    if (self_boxes_meet(box_at(pair.x), box_at(pair.y), push, thickness)) {
        uint place = place_after(atomicAdd(record[0].cell_count, 1u), 1u);
        if (place < uint(push.cell_capacity)) cells[place] = pair;
    }
}

void main() {
    int count = self_listed(record[0].candidate_count, push.cell_capacity);
    FOR_EVERY(i, count, judge(candidates[i]))
    dispatch(self_size_primitives, reached);
}
