// The states of cloths that are simulated together (engine/cloth/together.h) lie below each other in the same images,
// each at its place. A workgroup's z selects the cloth. Where only some cloths take a step, `present` lists them: first
// their places, by z; then, by place, whether the cloth is among them.
#ifndef DRAPE_PRESENT_H
#define DRAPE_PRESENT_H

layout(constant_id = 31) const bool has_present = false;
layout(set = 0, binding = 31, std430) readonly buffer Present { uint present[]; };

uint cloth_place() {
    uint place = gl_WorkGroupID.z;
    if (has_present) place = present[gl_WorkGroupID.z];
    return place;
}
/// Returns how many cloths are simulated together, whether present or not.
int cloths_together() {
    int count = int(gl_NumWorkGroups.z);
    if (has_present) count = present.length() / 2;
    return count;
}
/// Returns whether the cloth of a place takes the step, for passes over lists that contain all cloths.
bool is_present(uint place) {
    bool is = true;
    if (has_present) is = present[present.length() / 2 + int(place)] != 0u;
    return is;
}

#endif
