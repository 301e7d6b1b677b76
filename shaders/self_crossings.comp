// This pass counts the pairs of near cells in which cloths that started through each other still cross, and sums the
// speeds at which they separate there, as integers, so that the order does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_apart.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 6, std430) readonly buffer Meetings { uint meetings[]; };
layout(set = 0, binding = 7, std430) readonly buffer Crossed { SelfCrossed crossed[]; };
layout(set = 0, binding = 8, std430) buffer Crossings { SelfCrossings crossings[]; };

SelfCell cell_at(ivec2 texel) {
    return SelfCell(imageLoad(positions, texel).xyz, imageLoad(positions, texel + ivec2(1, 0)).xyz,
                    imageLoad(positions, texel + ivec2(0, 1)).xyz, imageLoad(positions, texel + ivec2(1, 1)).xyz,
                    uint(imageLoad(displacements, texel).w));
}

void judge_crossed(SelfCrossed pair, int which, ivec2 cells_of) {
    bool swapped = owner_of(cells_of.x) != pair.cloths.x;
    ivec2 first = texel_of(swapped ? cells_of.y : cells_of.x), second = texel_of(swapped ? cells_of.x : cells_of.y);
    if (self_cells_cross(cell_at(first), cell_at(second))) {
        int parts = self_parting_of(pair.way.xyz, imageLoad(displacements, first).xyz,
                                 imageLoad(displacements, second).xyz, self_parting(push.step));
        atomicAdd(crossings[which].count, 1);
        atomicAdd(crossings[which].sum, parts);
    }
}

void judge(int entry) {
    ivec2 pair = cells[entry];
    uint meeting = meetings[owner_of(pair.x) * push.cloth_count + owner_of(pair.y)];
    // On the default device only a loop can skip code, so this is a loop of no round or one.
    int rounds = meeting >= self_meets_apart ? 1 : 0, which = int(max(meeting, self_meets_apart) - self_meets_apart);
    for (int k = 0; k < rounds; ++k) judge_crossed(crossed[which], which, pair);
}

void main() {
    int count = self_listed(record[0].cell_count, push.cell_capacity);
    FOR_EVERY(i, count, judge(i))
}
