// Lists the pairs of cells whose triangles and edges this substep may bring together: of the candidates those whose boxes
// are near enough, and neighbours where the cloth is not flat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, std430) readonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 3, std430) readonly buffer Candidates { ivec2 candidates[]; };
layout(set = 0, binding = 4, std430) buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 5, std430) buffer Record { SelfRecord record[]; };

vec3 at(ivec2 texel) { return imageLoad(position, texel).xyz; }
vec3 moved(ivec2 texel) {
    return self_relative_motion(imageLoad(displacement, texel).xyz, record[0].carried.xyz);
}

bool lies_flat(ivec2 cell) {
    ivec2 m = cell + ivec2(1, 1);
    ivec2 l = m + ivec2(-1, 0), r = m + ivec2(1, 0), u = m + ivec2(0, -1), d = m + ivec2(0, 1);
    ivec2 ur = m + ivec2(1, -1), dl = m + ivec2(-1, 1), dr = m + ivec2(1, 1);
    return self_patch_lies_flat(push, SelfPatch(at(m), at(l), at(r), at(u), at(d), at(cell), at(ur), at(dl), at(dr)),
                                SelfPatch(moved(m), moved(l), moved(r), moved(u), moved(d), moved(cell), moved(ur),
                                          moved(dl), moved(dr)));
}

/// Bits of the pairs of neighbours that a cell stands for and that exist.
uint neighbours_of(ivec2 own) {
    uint bits = 0u;
    for (int k = 0; k < self_neighbour_pairs; ++k) {
        ivec4 pair = self_neighbour_pair(k);
        bool exists = own.x + max(pair.x, pair.z) < push.grid.x && own.y + max(pair.y, pair.w) < push.grid.y;
        bits |= exists ? 1u << k : 0u;
    }
    return bits;
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    int stride = int(gl_NumWorkGroups.x) * workgroup_width;
    int count = self_listed(record[0].candidate_count, push.cell_room);
    for (int i = index; i < count; i += stride) {
        ivec2 pair = candidates[i];
        int meets = self_boxes_meet(boxes[pair.x], boxes[pair.y], push, 0.0f) ? 1 : 0;
        for (; meets > 0; --meets) {
            uint place = atomicAdd(record[0].cell_count, 1u);
            if (place < uint(push.cell_room)) cells[place] = pair;
        }
    }
    ivec2 own = ivec2(index % push.grid.x, index / push.grid.x);
    bool inside = own.x + 2 < push.grid.x && own.y + 2 < push.grid.y;
    uint near = own.y >= push.grid.y || (inside && lies_flat(own)) ? 0u : neighbours_of(own);
    uint place = 0u;
    for (int go = near != 0u ? 1 : 0; go > 0; --go) place = atomicAdd(record[0].cell_count, uint(bitCount(near)));
    for (; near != 0u; near &= near - 1u) {
        ivec4 pair = self_neighbour_pair(findLSB(near));
        ivec2 a = own + ivec2(pair.x, pair.y), b = own + ivec2(pair.z, pair.w);
        if (place < uint(push.cell_room)) cells[place] = ivec2(a.y * push.grid.x + a.x, b.y * push.grid.x + b.x);
        ++place;
    }
}
