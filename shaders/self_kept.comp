// This pass makes the boxes with which cells are looked for in this substep and those to come: they follow the cells'
// present motion, and have a margin.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/self_tree.h"
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements;
#include "include/self_cloths.h"
layout(set = 0, binding = 4, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 5, std430) buffer Kept { SelfBox kept[]; };

vec3 mean;  // record[0].mean, read where nothing has branched yet (docs/devices.md)

void keep(int place) {
    SelfBox box = self_no_box();
    if (owner_of(place) >= 0)
        box = self_kept_box(box_at(place), imageLoad(displacements, texel_of(place)).xyz, mean, push.margin);
    kept[place] = box;
}

void main() {
    mean = record[0].mean.xyz;
    FOR_EVERY(place, push.grid.x * push.grid.y, keep(place))
}
