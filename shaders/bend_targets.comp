// This pass finds the differences that the bending elements of a cloth have at rest, in the shape that it started in,
// turned as the cloth is turned now: an invocation for the elements whose middle, and the cell whose corner, a particle
// is (include/bend_target.h). Sides that are cut turn nothing. Every texel is written.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bend_types.h"
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/rest_bend.h"
#include "include/spring.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(BendTargetPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D rest_shape;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D bend_targets;

/// The edge between two particles at rest and now, m.
struct Edge {
    vec3 rest, now;
};

const Edge no_edge = Edge(vec3(0.0f), vec3(0.0f));

Edge edge_between(ivec2 from, ivec2 to) {
    precise vec3 rest = LOAD(rest_shape, to).xyz - LOAD(rest_shape, from).xyz;
    vec3 moved_from = vec3(0.0f), moved_to = vec3(0.0f);
    if (push.moved != 0) {
        moved_from = LOAD(displacement_in, from).xyz;
        moved_to = LOAD(displacement_in, to).xyz;
    }
    return Edge(rest, spring_edge(LOAD(position, from).xyz, LOAD(position, to).xyz, moved_from, moved_to));
}

/// Returns the way from one particle to another by way of the one between them, as far as both ends hang together.
Edge through(Edge to_first, bool has_first, Edge to_third, bool has_third) {
    Edge first = no_edge, third = no_edge;
    if (has_first) first = to_first;
    if (has_third) third = to_third;
    precise vec3 rest = third.rest - first.rest;
    precise vec3 now = third.now - first.now;
    return Edge(rest, now);
}

Edge sum_of(Edge one, Edge other) {
    precise vec3 rest = one.rest + other.rest;
    precise vec3 now = one.now + other.now;
    return Edge(rest, now);
}

vec3 target_of(vec3 difference, Edge row, Edge column) {
    return turned_difference(difference, Tangents(row.rest, column.rest), Tangents(row.now, column.now));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), last = push.grid - 1;
    if (texel.x > last.x || texel.y > last.y) return;
    ivec2 right = texel + ivec2(1, 0), below = texel + ivec2(0, 1);
    bool has_left = texel.x > 0, has_right = texel.x < last.x, has_up = texel.y > 0, has_down = texel.y < last.y;
    vec4 shares = LOAD(spring_shares, texel);
    Edge to_left = no_edge, to_right = no_edge, to_up = no_edge, to_down = no_edge;
    float share_left = 0.0f, share_up = 0.0f;
    if (has_left) {
        to_left = edge_between(texel, texel - ivec2(1, 0));
        share_left = LOAD(spring_shares, texel - ivec2(1, 0)).x;
    }
    if (has_right) to_right = edge_between(texel, right);
    if (has_up) {
        to_up = edge_between(texel, texel - ivec2(0, 1));
        share_up = LOAD(spring_shares, texel - ivec2(0, 1)).y;
    }
    if (has_down) to_down = edge_between(texel, below);
    Edge row = through(to_left, share_left > 0.0f, to_right, has_right && shares.x > 0.0f);
    Edge column = through(to_up, share_up > 0.0f, to_down, has_down && shares.y > 0.0f);
    vec3 along_row = vec3(0.0f), along_column = vec3(0.0f), twist = vec3(0.0f);
    if (has_left && has_right)
        along_row = target_of(second_difference(to_left.rest, to_right.rest), row, column);
    if (has_up && has_down)
        along_column = target_of(second_difference(to_up.rest, to_down.rest), row, column);
    if (has_right && has_down) {
        Edge lower = edge_between(below, below + ivec2(1, 0)), far = edge_between(right, right + ivec2(0, 1));
        twist = target_of(twist_difference(to_right.rest, lower.rest), sum_of(to_right, lower), sum_of(to_down, far));
    }
    imageStore(bend_targets, placed(texel), vec4(along_row, 0.0f));
    imageStore(bend_targets, placed(texel) + ivec2(push.grid.x, 0), vec4(along_column, 0.0f));
    imageStore(bend_targets, placed(texel) + ivec2(2 * push.grid.x, 0), vec4(twist, 0.0f));
}
