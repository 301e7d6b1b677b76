// Lists the pairs of cells of a cloth, neighbours and those two columns or rows apart, whose triangles and edges this
// substep may bring together: those about which it is not flat, or that it does not keep apart.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/self_ring.h"

layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { SelfContactPush push; };
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) readonly buffer Meetings { uint meetings[]; };
layout(set = 0, binding = 5, std430) buffer Cells { ivec2 cells[]; };
layout(set = 0, binding = 6, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 7, std430) buffer Sizes { uvec4 sizes[]; };
#include "include/self_lists.h"

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

vec3 at(ivec2 texel) { return imageLoad(positions, texel).xyz; }
vec3 moved(ivec2 texel) {
    return self_relative_motion(imageLoad(displacements, texel).xyz, carried);
}

/// Particles of a column, over the cloth's edge the last one again.
SelfColumn column_at(ivec2 first, ivec2 last) {
    return SelfColumn(at(first), at(ivec2(first.x, min(first.y + 1, last.y))),
                      at(ivec2(first.x, min(first.y + 2, last.y))), at(ivec2(first.x, min(first.y + 3, last.y))));
}
SelfColumn column_moved(ivec2 first, ivec2 last) {
    return SelfColumn(moved(first), moved(ivec2(first.x, min(first.y + 1, last.y))),
                      moved(ivec2(first.x, min(first.y + 2, last.y))), moved(ivec2(first.x, min(first.y + 3, last.y))));
}

/// Of the 3 x 3 particles from a patch's first on.
SelfPatch patch_of(SelfColumns x) {
    return SelfPatch(x.b.b, x.a.b, x.c.b, x.b.a, x.b.c, x.a.a, x.c.a, x.a.c, x.c.c);
}

/// Bits of the pairs of cells that a cell stands for and that the cloth keeps apart.
uint kept_apart(SelfCloth cloth, ivec2 cell, bool inside) {
    ivec2 last = cloth.first + cloth.grid - 1;
    ivec2 b = ivec2(min(cell.x + 1, last.x), cell.y), c = ivec2(min(cell.x + 2, last.x), cell.y),
          d = ivec2(min(cell.x + 3, last.x), cell.y);
    SelfColumns x =
        SelfColumns(column_at(cell, last), column_at(b, last), column_at(c, last), column_at(d, last));
    SelfColumns motions =
        SelfColumns(column_moved(cell, last), column_moved(b, last), column_moved(c, last), column_moved(d, last));
    bool flat_there = inside && self_patch_lies_flat(push, cloth, patch_of(x), patch_of(motions));
    return self_close_apart(push, cloth, x, motions) | (flat_there ? (1u << self_neighbour_pairs) - 1u : 0u);
}

/// Bits of the pairs of cells at most two columns and rows apart that a cell of a cloth stands for and that exist.
uint close_pairs_of(SelfCloth cloth, ivec2 own) {
    uint bits = 0u;
    for (int k = 0; k < self_close_pairs; ++k) {
        ivec4 pair = self_close_pair(k);
        bool exists = own.x + max(pair.x, pair.z) < cloth.grid.x && own.y + max(pair.y, pair.w) < cloth.grid.y;
        bits |= exists ? 1u << k : 0u;
    }
    return bits;
}

/// Those of them that are not ruled out by how the cloth lies there.
uint near_pairs(ivec2 texel) {
    int owner = owner_of(place_of(texel));
    bool meets = owner >= 0 && meetings[max(owner, 0) * (push.cloth_count + 1)] != self_meets_not;
    SelfCloth cloth = cloth_at(texel);
    ivec2 own = texel - cloth.first;
    bool inside = own.x + 2 < cloth.grid.x && own.y + 2 < cloth.grid.y;
    return meets ? close_pairs_of(cloth, own) & ~kept_apart(cloth, texel, inside) : 0u;
}

void judge(ivec2 texel) {
    uint near = near_pairs(texel), count = uint(bitCount(near));
    uint place = 0u;
    if (count > 0u) place = place_after(atomicAdd(record[0].cell_count, count), count);
    for (;;) {
        ivec4 pair = self_close_pair(max(findLSB(near), 0));
        ivec2 a = texel + ivec2(pair.x, pair.y), b = texel + ivec2(pair.z, pair.w);
        if (near != 0u && place < uint(push.cell_room)) cells[place] = ivec2(place_of(a), place_of(b));
        ++place;
        near &= max(near, 1u) - 1u;
        if (near == 0u) break;
    }
}

void main() {
    carried = record[0].carried.xyz;
    FOR_EVERY(place, push.grid.x * push.grid.y, judge(texel_of(place)))
    dispatch(self_size_primitives, reached);
}
