// Lists the pairs of cells whose triangles and edges this substep may bring together: of the candidates those whose boxes
// are near enough, and neighbours where the cloth is not flat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 5, std430) readonly buffer Candidates { ivec2 candidates[]; };
layout(set = 0, binding = 6, std430) buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 8, std430) readonly buffer Meetings { uint meetings[]; };

vec3 at(ivec2 texel) { return imageLoad(positions, texel).xyz; }
vec3 moved(ivec2 texel) {
    return self_relative_motion(imageLoad(displacements, texel).xyz, record[0].carried.xyz);
}

bool lies_flat(SelfCloth cloth, ivec2 cell) {
    ivec2 m = cell + ivec2(1, 1);
    ivec2 l = m + ivec2(-1, 0), r = m + ivec2(1, 0), u = m + ivec2(0, -1), d = m + ivec2(0, 1);
    ivec2 ur = m + ivec2(1, -1), dl = m + ivec2(-1, 1), dr = m + ivec2(1, 1);
    return self_patch_lies_flat(
        push, cloth, SelfPatch(at(m), at(l), at(r), at(u), at(d), at(cell), at(ur), at(dl), at(dr)),
        SelfPatch(moved(m), moved(l), moved(r), moved(u), moved(d), moved(cell), moved(ur), moved(dl), moved(dr)));
}

/// Bits of the pairs of neighbours that a cell of a cloth stands for and that exist.
uint neighbours_of(SelfCloth cloth, ivec2 own) {
    uint bits = 0u;
    for (int k = 0; k < self_neighbour_pairs; ++k) {
        ivec4 pair = self_neighbour_pair(k);
        bool exists = own.x + max(pair.x, pair.z) < cloth.grid.x && own.y + max(pair.y, pair.w) < cloth.grid.y;
        bits |= exists ? 1u << k : 0u;
    }
    return bits;
}

/// Those of them that are not ruled out by how flat the cloth is there.
uint near_neighbours(ivec2 texel) {
    int owner = owner_of(place_of(texel));
    if (owner < 0 || meetings[owner * (push.cloth_count + 1)] == 0u) return 0u;
    SelfCloth cloth = cloths[owner];
    ivec2 own = texel - cloth.first;
    bool inside = own.x + 2 < cloth.grid.x && own.y + 2 < cloth.grid.y;
    return inside && lies_flat(cloth, texel) ? 0u : neighbours_of(cloth, own);
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    int count = self_listed(record[0].candidate_count, push.cell_room);
    for (int i = index; i < count; i += stride) {
        ivec2 pair = candidates[i];
        float thickness = self_mean_thickness(cloth_at(texel_of(pair.x)), cloth_at(texel_of(pair.y)));
        int meets = self_boxes_meet(boxes[pair.x], boxes[pair.y], push, thickness, 0.0f) ? 1 : 0;
        for (; meets > 0; --meets) {
            uint place = atomicAdd(record[0].cell_count, 1u);
            if (place < uint(push.cell_room)) cells[place] = pair;
        }
    }
    for (int own = index; own < push.grid.x * push.grid.y; own += stride) {
        ivec2 texel = texel_of(own);
        uint near = near_neighbours(texel);
        uint place = 0u;
        for (int go = near != 0u ? 1 : 0; go > 0; --go) place = atomicAdd(record[0].cell_count, uint(bitCount(near)));
        for (; near != 0u; near &= near - 1u) {
            ivec4 pair = self_neighbour_pair(findLSB(near));
            ivec2 a = texel + ivec2(pair.x, pair.y), b = texel + ivec2(pair.z, pair.w);
            if (place < uint(push.cell_room)) cells[place] = ivec2(place_of(a), place_of(b));
            ++place;
        }
    }
}
