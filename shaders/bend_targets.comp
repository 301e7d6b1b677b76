// This pass computes the rest differences of the bending elements of a cloth that rests bent (include/rest_bend.h). For
// the elements whose middle is its particle, and for the cell whose corner it is, an invocation writes the differences
// at rest, turned as the particles are predicted to be, and the pulls on their tangents for the particles' places when
// the substep began. Both are treated as constant within the substep. Sides that are cut belong to no tangent. Every
// texel is written. In `second_order` the control says whether this substep is BDF2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bend_types.h"
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/rest_bend.h"
#include "include/spring.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(BendTargetPush)
#define TOGETHER
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D rest_shape;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D bend_targets;
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 5, r32ui) uniform readonly uimage2D line_control;
layout(constant_id = 0) const bool advance = false;  // as in explicit.comp

/// The edge between two particles at rest, when the substep began and now, m.
struct Edge {
    vec3 rest, start, now;
};

const Edge no_edge = Edge(vec3(0.0f), vec3(0.0f), vec3(0.0f));

/// Pulls use current places where true: BDF2 needs forces at its end, and lagging ones would amplify motions. In Euler
/// steps the lag damps.
bool pulls_now = push.gathers != 0;

Edge edge_between(ivec2 from, ivec2 to) {
    precise vec3 rest = LOAD(rest_shape, to).xyz - LOAD(rest_shape, from).xyz;
    precise vec3 start = LOAD(position, to).xyz - LOAD(position, from).xyz;
    vec3 now = start;
    if (push.gathers == 0 || advance)
        now = spring_edge(LOAD(position, from).xyz, LOAD(position, to).xyz, LOAD(displacement_in, from).xyz,
                          LOAD(displacement_in, to).xyz);
    if (pulls_now) start = now;
    return Edge(rest, start, now);
}

Edge sum_of(Edge one, Edge other, float sign) {
    precise vec3 rest = other.rest + one.rest * sign;
    precise vec3 start = other.start + one.start * sign;
    precise vec3 now = other.now + one.now * sign;
    return Edge(rest, start, now);
}

/// Returns the vector from one particle to another through the one between them, as far as both are connected to it.
Edge through(Edge to_first, bool has_first, Edge to_third, bool has_third) {
    Edge first = no_edge, third = no_edge;
    if (has_first) first = to_first;
    if (has_third) third = to_third;
    return sum_of(first, third, -1.0f);
}

/// An element's difference at rest, turned to the current places, and its pull.
struct Bent {
    vec3 target;
    Tangents pull;
};

Bent bent(Edge difference, Edge row, Edge column, float stiffness) {
    vec4 coordinates = rest_coordinates(difference.rest, Tangents(row.rest, column.rest));
    Tangents start = Tangents(row.start, column.start);
    vec3 beyond = beyond_rest(difference.start, rest_difference(coordinates, start, difference.start));
    precise vec3 force = beyond * stiffness;
    return Bent(rest_difference(coordinates, Tangents(row.now, column.now), difference.now),
                rest_pull(coordinates, start, force));
}

void store(ivec2 texel, int part, vec3 value) {
    imageStore(bend_targets, placed(texel) + ivec2(part * push.grid.x, 0), vec4(value, 0.0f));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), last = push.grid - 1;
    if (texel.x > last.x || texel.y > last.y) return;
    vec4 stiffness = push.stiffness;
    if (second_order)
        if (imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u) {
            stiffness = push.stiffness_bdf2;
            pulls_now = true;
        }
    ivec2 right = texel + ivec2(1, 0), below = texel + ivec2(0, 1);
    bool has_left = texel.x > 0, has_right = texel.x < last.x, has_up = texel.y > 0, has_down = texel.y < last.y;
    vec4 shares = LOAD(spring_shares, texel);
    Edge to_left = no_edge, to_right = no_edge, to_up = no_edge, to_down = no_edge;
    float share_left = 0.0f, share_up = 0.0f, share_right = has_right ? shares.x : 0.0f;
    float share_down = has_down ? shares.y : 0.0f;
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
    Edge row = through(to_left, share_left > 0.0f, to_right, share_right > 0.0f);
    Edge column = through(to_up, share_up > 0.0f, to_down, share_down > 0.0f);
    vec3 none = vec3(0.0f);
    Bent along_row = Bent(none, Tangents(none, none)), along_column = along_row, twist = along_row;
    if (has_left && has_right) {
        precise float acting = stiffness.x * bend_share(share_left, share_right);
        along_row = bent(sum_of(to_left, to_right, 1.0f), row, column, acting);
    }
    if (has_up && has_down) {
        precise float acting = stiffness.y * bend_share(share_up, share_down);
        along_column = bent(sum_of(to_up, to_down, 1.0f), row, column, acting);
    }
    if (has_right && has_down) {
        Edge lower = edge_between(below, below + ivec2(1, 0)), far = edge_between(right, right + ivec2(0, 1));
        precise float acting = stiffness.z * twist_share(shares, LOAD(spring_shares, right), LOAD(spring_shares, below));
        twist = bent(sum_of(to_right, lower, -1.0f), sum_of(to_right, lower, 1.0f), sum_of(to_down, far, 1.0f), acting);
    }
    Tangents pull = sum_of_pulls(along_row.pull, along_column.pull);
    store(texel, 0, along_row.target);
    store(texel, 1, along_column.target);
    store(texel, 2, twist.target);
    store(texel, bend_pull_row, pull.row);
    store(texel, bend_pull_column, pull.column);
    store(texel, twist_pull_row, twist.pull.row);
    store(texel, twist_pull_column, twist.pull.column);
}
