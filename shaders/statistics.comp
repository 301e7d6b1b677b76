// This pass takes the statistics of a cloth, with an invocation and a record per statistics_rows particles of a column.
// A particle answers for the springs whose first particle it is. MASKED takes spring shares and masses from images
// (holes, cuts). COLLIDING measures contact with the scene's colliders, MESHES too, with triangle meshes among them.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#pragma variants MASKED COLLIDING|MESHES
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/statistics.h"
#ifdef MESHES
#define COLLIDING
#endif
#ifdef COLLIDING
#include "include/contacts.h"
#endif

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(StatisticsPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, std430) writeonly buffer Partials { StatisticsRecord partials[]; };
#ifdef MASKED
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 4, r32f) uniform readonly image2D mass_share;
#endif
layout(set = 0, binding = 9, r32f) uniform readonly image2D tension_row;
layout(set = 0, binding = 10, r32f) uniform readonly image2D tension_column;
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D end_excess;
// Each cloth has a texel. xyz: positions are summed relative to this point, m; w: thickness, m.
layout(set = 0, binding = 12, rgba32f) uniform readonly image2D statistics_reference;
#include "include/rest_length.h"

vec4 reference_of_cloth() { return imageLoad(statistics_reference, ivec2(0, cloth_place())); }

/// The inverse mass w would not do, since held particles have a mass too.
float mass_share_of(ivec2 texel) {
#ifdef MASKED
    return LOAD(mass_share, texel).x;
#else
    return border_mass_share(texel, push.grid);
#endif
}

/// The positions around a particle, and of the particle itself.
struct Neighbours {
    vec4 here;
    vec3 right, below_left, below, below_right;
};

/// Returns the shares of the springs that a particle owns, by direction; 0 for those that leave the grid.
vec4 shares_of(ivec2 texel) {
#ifdef MASKED
    vec4 shares = LOAD(spring_shares, texel);
#else
    vec4 shares = vec4(border_share(texel, ivec2(1, 0), push.grid), border_share(texel, ivec2(0, 1), push.grid), 1.0f,
                       1.0f);
#endif
    bool right = texel.x + 1 < push.grid.x, below = texel.y + 1 < push.grid.y;
    return vec4(right ? shares.x : 0.0f, below ? shares.y : 0.0f, right && below ? shares.z : 0.0f,
                texel.x > 0 && below ? shares.w : 0.0f);
}

/// `owner`: the spring's first particle, which is at `first`, m.
StatisticsRecord with_spring(StatisticsRecord record, ivec2 owner, vec3 first, vec3 second, int direction, float share,
                             float tension) {
    float rest = length_at_rest(push.rest_length[direction], owner, direction);
    return add_spring_strain(record, first, second, rest, push.half_stiffness[direction],
                             record.counts.x == 0u ? share : 0.0f, push.compression, tension, direction >= 2);
}

StatisticsRecord statistics_of(ivec2 texel, Neighbours around) {
    vec3 at = around.here.xyz;
    precise vec3 velocity = LOAD(displacement, texel).xyz + LOAD(end_excess, texel).xyz;
    StatisticsRecord record = particle_statistics(at, velocity, mass_share_of(texel), reference_of_cloth().xyz,
                                                  uint(texel.y * push.grid.x + texel.x));
    vec4 shares = shares_of(texel);
    record = with_spring(record, texel, at, around.right, 0, shares.x, LOAD(tension_row, texel).x);
    record = with_spring(record, texel, at, around.below, 1, shares.y, LOAD(tension_column, texel).x);
    record = with_spring(record, texel, at, around.below_right, 2, shares.z, 0.0f);
    record = with_spring(record, texel, at, around.below_left, 3, shares.w, 0.0f);
#ifdef COLLIDING
    // This is the deepest contact that the collision pass would find. It does not move held particles, so those do not
    // count.
    vec3 rest = vec3(0.0f, 0.0f, 0.0f);
    bool far = false;
    vec2 own = skin_of(placed(texel).y * push.grid.x + texel.x, vec2(reference_of_cloth().w, 0.0f));
    if (record.counts.x == 0u && around.here.w != 0.0f)
        record.extents.z =
            contact_with_all(push.collider_first, at, rest, own.x, 0.0f, 1.0e30f, false, false, far).depth;
#endif
    return record;
}

void main() {
#ifdef COLLIDING
    read_colliders(push.collider_first);
#endif
    ivec2 texel = ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * uint(statistics_rows));
    StatisticsRecord record = empty_statistics();
    Neighbours around;
    around.here = LOAD(position, texel);
    around.right = LOAD(position, texel + ivec2(1, 0)).xyz;
    int end = min(texel.y + statistics_rows, push.grid.y);
    if (texel.x >= push.grid.x) return;
    for (;;) {
        vec4 below = LOAD(position, texel + ivec2(0, 1));
        around.below_left = LOAD(position, texel + ivec2(-1, 1)).xyz;
        around.below = below.xyz;
        around.below_right = LOAD(position, texel + ivec2(1, 1)).xyz;
        record = joined(record, statistics_of(texel, around));
        around.here = below;
        around.right = around.below_right;
        ++texel.y;
        if (texel.y >= end) break;
    }
    partials[int(cloth_place() * gl_NumWorkGroups.y + gl_GlobalInvocationID.y) * push.grid.x + texel.x] =
        record;
}
