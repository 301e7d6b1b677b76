// This pass computes the boxes over the sheet at the start of a substep, one per particle for the cell whose first
// corner it is. It resets the lists, by first corner, of what pairs bore, and stores the motions that the particles
// would make without contact. Where a cell has left the box with which it was last searched for, there is a new search,
// for which the last workgroup to finish sets the sizes of passes. Where some cloths `crossed` when they started, the
// pass also resets what is found about those.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
#include "include/every.h"
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) writeonly buffer Boxes { SelfBox boxes[]; };
layout(set = 0, binding = 5, std430) writeonly buffer FirstBorne { uint first_borne[]; };
layout(set = 0, binding = 6, std430) writeonly buffer Shares { uint shares[]; };
layout(set = 0, binding = 7, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 8, std430) writeonly buffer Before { vec4 before[]; };
layout(set = 0, binding = 9, rgba32f) uniform readonly imageBuffer kept;  // boxes of the last search
layout(set = 0, binding = 10, std430) buffer Sizes { uvec4 sizes[]; };
layout(constant_id = 24) const bool crossed = false;
layout(set = 0, binding = 11, std430) writeonly buffer Crossings { SelfCrossings crossings[]; };
layout(set = 0, binding = 12, std430) writeonly buffer ClothShares { uint cloth_shares[]; };
void reset_share(int word) { cloth_shares[word] = word % self_cloth_words == 0 ? 0u : floatBitsToUint(1.0f); }
void forget_crossings(int k) { crossings[k] = SelfCrossings(0, 0); }

#include "include/self_carried.h"
vec3 first_travel;  // the first record's, read early
vec3 travel_at(int place) {
    vec3 travel = first_travel;
    if (member_count > 1) travel = record[member_at(place)].travel.xyz;
    return travel;
}
bool searches = false;

SelfBox particle_box(ivec2 texel) {
    return self_point_box(imageLoad(positions, texel).xyz,
                          self_relative_motion(imageLoad(displacements, texel).xyz, carried_at(texel)));
}

SelfBox cell_box(ivec2 texel, SelfCloth cloth) {
    bool right = texel.x - cloth.first.x + 1 < cloth.grid.x;
    bool below = texel.y - cloth.first.y + 1 < cloth.grid.y;
    SelfBox box = particle_box(texel);
    if (right) box = self_joined(box, particle_box(texel + ivec2(1, 0)));
    if (below) box = self_joined(box, particle_box(texel + ivec2(0, 1)));
    if (right && below) box = self_joined(box, particle_box(texel + ivec2(1, 1)));
    return box;
}

/// Returns whether a cell has left the box with which it was searched for, or may have by rounding. The travel that all
/// cells have made since then brings none nearer to another, so it does not count. The code has no && or ||, which
/// would branch.
bool has_left(SelfBox box, SelfBox was, vec3 travel) {
    vec3 least = vec3(push.least);
    precise vec3 above = (box.lower.xyz - travel) - was.lower.xyz;
    precise vec3 below = was.upper.xyz - (box.upper.xyz - travel);
    bvec2 inside = bvec2(all(greaterThanEqual(above, least)), all(greaterThanEqual(below, least)));
    return !all(inside);
}

void begin(int place, int count) {
    int owner = owner_of(place);
    SelfBox box = self_no_box();
    if (owner >= 0) box = cell_box(texel_of(place), cloth_at(texel_of(place)));
    boxes[place] = box;
    SelfBox was = SelfBox(imageLoad(kept, 2 * place), imageLoad(kept, 2 * place + 1));
    bool left = has_left(box, was, travel_at(place));
    left = owner >= 0 ? left : false;
    searches = left ? true : searches;
    before[place] = vec4(imageLoad(displacements, texel_of(place)).xyz, 0.0f);
    for (int chain = 0; chain < self_chains; ++chain) first_borne[place * self_chains + chain] = self_no_entry;
    for (int round = 0; round < self_rounds; ++round) shares[round * count + place] = floatBitsToUint(1.0f);
}

void begin_search() {
    uvec2 tiles = (uvec2(push.grid) - 1u) / uint(self_tile_cells) + 1u;
    sizes[self_size_tree] = uvec4(tiles, 1u, 0u);
    sizes[self_size_blocks].x = uint((self_tree_count(push.grid, 1) + workgroup_width - 1) / workgroup_width);
    record[0].block_count = 0u;
    record[0].candidate_count = 0u;
    for (int member = 0; member < member_count; ++member) record[member].travel = vec4(0.0f, 0.0f, 0.0f, 0.0f);
}

/// The last workgroup to finish knows what all have asked for.
void end_workgroup() {
    uint ended = atomicAdd(sizes[self_size_search].w, 1u) + 1u;
    memoryBarrierBuffer();
    if (ended == gl_NumWorkGroups.x && atomicOr(sizes[self_size_search].x, 0u) != 0u) begin_search();
}

void main() {
    load_carried();
    first_travel = record[0].travel.xyz;
    int count = push.grid.x * push.grid.y;
    FOR_EVERY(place, count, begin(place, count))
    FOR_EVERY(word, cloth_count * self_cloth_words, reset_share(word))
    if (crossed) {
        FOR_EVERY(k, push.crossed_count, forget_crossings(k))
    }
    if (searches && sizes[self_size_search].x == 0u) atomicMax(sizes[self_size_search].x, 1u);
    memoryBarrierBuffer();
    barrier();
    if (gl_LocalInvocationIndex == 0u) end_workgroup();
}
