// This pass computes the statistics of a cloth, with an invocation and a record for each statistics_rows particles of a
// column. A particle includes the springs that it owns. Where `masked`, spring shares and masses come from images
// (holes, cuts). A cloth that `rests_bent` bends, and rests in the shape in which it starts.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/rest_bend.h"
#include "include/spring.h"
#include "include/statistics.h"
#include "include/contacts.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(StatisticsPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, std430) writeonly buffer Partials { StatisticsRecord partials[]; };
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 4, r32f) uniform readonly image2D mass_share;
layout(set = 0, binding = 9, r32f) uniform readonly image2D tension_row;
layout(set = 0, binding = 10, r32f) uniform readonly image2D tension_column;
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D end_excess;
// Each cloth has a texel. xyz: positions are summed relative to this point, m; w: thickness, m.
layout(set = 0, binding = 12, rgba32f) uniform readonly image2D statistics_reference;
layout(constant_id = 25) const bool turned = false;  // substeps turned the cloth so that it keeps its angular momentum
layout(set = 0, binding = 14, rgba32f) uniform readonly image2D angular_error;
layout(constant_id = 24) const bool rests_bent = false;
layout(set = 0, binding = 13, rgba32f) uniform readonly image2D rest_shape;
const bool collides = meshes_end > 0;
layout(constant_id = 28) const bool has_bend = false;
#include "include/rest_length.h"

vec4 reference_of_cloth() { return imageLoad(statistics_reference, ivec2(0, cloth_place())); }

/// Returns a particle's mass share. The inverse mass w would not do, since held particles have a mass too.
float mass_share_of(ivec2 texel) {
    if (masked) return LOAD(mass_share, texel).x;
    return border_mass_share(texel, push.grid);
}

/// The positions of a particle and of its neighbours.
struct Neighbours {
    vec4 here;
    vec3 right, below_left, below, below_right;
};

/// Returns the shares of the springs that a particle owns, by direction; 0 for those that leave the grid.
vec4 shares_of(ivec2 texel) {
    vec4 shares;
    if (masked)
        shares = LOAD(spring_shares, texel);
    else
        shares = vec4(border_share(texel, ivec2(1, 0), push.grid), border_share(texel, ivec2(0, 1), push.grid), 1.0f,
                      1.0f);
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

/// The edge between two particles at rest and now, m.
struct Edge {
    vec3 rest, now;
};

Edge edge_between(ivec2 from, ivec2 to) {
    precise vec3 rest = vec3(0.0f);
    if (rests_bent) rest = LOAD(rest_shape, to).xyz - LOAD(rest_shape, from).xyz;
    precise vec3 now = LOAD(position, to).xyz - LOAD(position, from).xyz;
    return Edge(rest, now);
}

Edge sum_of(Edge one, Edge other, float sign) {
    precise vec3 rest = other.rest + one.rest * sign;
    precise vec3 now = other.now + one.now * sign;
    return Edge(rest, now);
}

/// Returns the edge, or zero where the particles are not connected.
Edge if_there(Edge edge, float share) {
    bool is_there = share > 0.0f;
    return Edge(is_there ? edge.rest : vec3(0.0f), is_there ? edge.now : vec3(0.0f));
}

/// Returns how far an element deviates from its rest, m; `row` and `column`: the tangents at its place
/// (include/rest_bend.h).
vec3 beyond_rest_in(Edge difference, Edge row, Edge column) {
    vec3 target = vec3(0.0f);
    if (rests_bent) {
        vec4 coordinates = rest_coordinates(difference.rest, Tangents(row.rest, column.rest));
        target = rest_difference(coordinates, Tangents(row.now, column.now), difference.now);
    }
    return beyond_rest(difference.now, target);
}

/// Adds the bending elements whose middle is a particle, and the twist of the cell whose upper left corner it is.
/// Elements that leave the grid have a share of 0.
StatisticsRecord with_bending(StatisticsRecord record, ivec2 texel) {
    ivec2 left = texel - ivec2(1, 0), up = texel - ivec2(0, 1), right = texel + ivec2(1, 0),
          below = texel + ivec2(0, 1), across = texel + ivec2(1, 1);
    vec4 shares = shares_of(texel);
    float share_left = texel.x > 0 ? shares_of(left).x : 0.0f, share_up = texel.y > 0 ? shares_of(up).y : 0.0f;
    Edge to_left = edge_between(texel, left), to_right = edge_between(texel, right), to_up = edge_between(texel, up),
         to_below = edge_between(texel, below);
    Edge row = sum_of(if_there(to_left, share_left), if_there(to_right, shares.x), -1.0f),
         column = sum_of(if_there(to_up, share_up), if_there(to_below, shares.y), -1.0f);
    record = add_bending(record, beyond_rest_in(sum_of(to_left, to_right, 1.0f), row, column), push.half_bend.x,
                         bend_share(share_left, shares.x));
    record = add_bending(record, beyond_rest_in(sum_of(to_up, to_below, 1.0f), row, column), push.half_bend.y,
                         bend_share(share_up, shares.y));
    Edge lower = edge_between(below, across), far = edge_between(right, across);
    vec3 twisted = beyond_rest_in(sum_of(to_right, lower, -1.0f), sum_of(to_right, lower, 1.0f),
                                  sum_of(to_below, far, 1.0f));
    return add_bending(record, twisted, push.half_bend.z, twist_share(shares, shares_of(right), shares_of(below)));
}

StatisticsRecord statistics_of(ivec2 texel, Neighbours around) {
    vec3 at = around.here.xyz;
    vec3 moved = LOAD(displacement, texel).xyz;
    precise vec3 velocity = moved + LOAD(end_excess, texel).xyz;
    StatisticsRecord record = particle_statistics(at, moved, velocity, mass_share_of(texel), reference_of_cloth().xyz,
                                                  uint(texel.y * push.grid.x + texel.x));
    vec4 shares = shares_of(texel);
    record = with_spring(record, texel, at, around.right, 0, shares.x, LOAD(tension_row, texel).x);
    record = with_spring(record, texel, at, around.below, 1, shares.y, LOAD(tension_column, texel).x);
    record = with_spring(record, texel, at, around.below_right, 2, shares.z, 0.0f);
    record = with_spring(record, texel, at, around.below_left, 3, shares.w, 0.0f);
    if (has_bend) record = with_bending(record, texel);
    if (!collides) return record;
    // This is the deepest contact that the collision pass would find. That pass does not move held particles, so they
    // do not count.
    vec3 rest = vec3(0.0f, 0.0f, 0.0f);
    bool far = false;
    vec2 own = skin_of(placed(texel).y * push.grid.x + texel.x, vec2(reference_of_cloth().w, 0.0f));
    if (record.counts.x == 0u && around.here.w != 0.0f)
        record.extents.z =
            contact_with_all(push.collider_first, at, rest, own.x, 0.0f, 1.0e30f, false, false, far).depth;
    return record;
}

void main() {
    if (collides) read_colliders(push.collider_first);
    ivec2 texel = ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * uint(statistics_rows));
    StatisticsRecord record = empty_statistics();
    Neighbours around;
    around.here = LOAD(position, texel);
    around.right = LOAD(position, texel + ivec2(1, 0)).xyz;
    int end = min(texel.y + statistics_rows, push.grid.y);
    if (texel.x >= push.grid.x) return;
    if (turned && texel == ivec2(0)) record.errors.yzw = imageLoad(angular_error, ivec2(0, cloth_place())).xyz;
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
