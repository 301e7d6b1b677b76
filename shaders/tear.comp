// This pass computes the loads of the springs along rows and columns at the end of a frame, relative to what they bear,
// and counts those above their limit. Where `masked`, springs that are gone are left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/cut_types.h"
#include "include/tear.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(TearPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D tear_limits;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D tear_loads;  // x: of the row's spring, y: the column's
layout(set = 0, binding = 3, std430) buffer Count { uint count[]; };         // number of springs above their limit
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D spring_shares;
#define LOAD(name, texel) imageLoad(name, texel)
#include "include/rest_length.h"

vec3 particle(ivec2 at) { return imageLoad(position, at).xyz; }

vec4 shares_of(ivec2 at) {
    if (masked) return imageLoad(spring_shares, at);
    return vec4(1.0f);
}

/// Returns the summed strains of a cell's diagonals; 0 outside the grid.
float cell_diagonals(ivec2 cell) {
    if (cell.x < 0 || cell.y < 0 || cell.x + 1 >= push.grid.x || cell.y + 1 >= push.grid.y) return 0.0f;
    ivec2 right = cell + ivec2(1, 0);
    vec2 rest = vec2(length_at_rest(push.rest_diagonal, cell, 2), length_at_rest(push.rest_diagonal, right, 3));
    return diagonal_strains(particle(cell), particle(right), particle(cell + ivec2(0, 1)), particle(cell + ivec2(1, 1)),
                            shares_of(cell).z, shares_of(right).w, rest, push.compression);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 limits = imageLoad(tear_limits, texel);
    vec4 shares = shares_of(texel);
    vec3 here = particle(texel);
    float beside = 0.0f, above = 0.0f, left = 0.0f;
    if (limits.z != 0.0f || limits.w != 0.0f) {
        beside = cell_diagonals(texel);
        above = cell_diagonals(texel - ivec2(0, 1));
        left = cell_diagonals(texel - ivec2(1, 0));
    }
    float along_row = 0.0f, along_column = 0.0f;
    if (texel.x + 1 < push.grid.x && shares.x != 0.0f) {
        precise float diagonals = above + beside;
        float rest = length_at_rest(push.rest_row, texel, 0);
        along_row = tear_load(balancing_strain(here, particle(texel + ivec2(1, 0)), rest, push.compression),
                              diagonals, limits.z, limits.x);
    }
    if (texel.y + 1 < push.grid.y && shares.y != 0.0f) {
        precise float diagonals = left + beside;
        float rest = length_at_rest(push.rest_column, texel, 1);
        along_column = tear_load(balancing_strain(here, particle(texel + ivec2(0, 1)), rest, push.compression),
                                 diagonals, limits.w, limits.y);
    }
    imageStore(tear_loads, texel, vec4(along_row, along_column, 0.0f, 0.0f));
    uint overloaded = (along_row > 1.0f ? 1u : 0u) + (along_column > 1.0f ? 1u : 0u);
    if (overloaded > 0u) atomicAdd(count[0], overloaded);
}
