// This pass is an explicit step: it finishes the last substep (X += d, after the first substep of a frame), gathers the
// forces of the springs around each particle and takes the next step. Since it reads neighbours, it writes to the other
// image of each pair, every texel of it. Where `windy`, it adds the wind's force. Where `masked`, the spring shares
// come from an image (holes, cuts). Particles with w = 0 feel no force; the pin pass moves those that key frames move.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bend_types.h"
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/explicit.h"
#include "include/push.h"
#include "include/rest_bend.h"
#include "include/spring.h"
#include "include/verlet.h"
#include "include/wind.h"
CLOTH_CONSTANTS(ExplicitPush)
#define TOGETHER
const bool in_place = false;
#include "include/substep_state.h"

layout(constant_id = 0) const bool advance = false;  // the positions lack the last substep's displacement
layout(constant_id = 1) const bool has_shear = false;
layout(constant_id = 2) const bool has_bend = false;
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D spring_shares;
#include "include/bend_target.h"
#include "include/bend_pull.h"

struct Particle {
    ivec2 texel;
    vec3 position;
    vec3 displacement;
    vec4 shares;  // shares of the springs that it owns, where `masked`
};

bool inside(ivec2 texel) { return texel.x >= 0 && texel.y >= 0 && texel.x < push.grid.x && texel.y < push.grid.y; }

/// The texel must be inside the grid.
Particle particle_at(ivec2 texel) {
    Particle particle =
        Particle(texel, LOAD(position_in, texel).xyz, LOAD(displacement_in, texel).xyz, vec4(0.0f));
    if (masked) particle.shares = LOAD(spring_shares, texel);
    return particle;
}

vec3 edge_between(Particle from, Particle to) {
    if (advance) return spring_edge(from.position, to.position, from.displacement, to.displacement);
    precise vec3 edge = to.position - from.position;
    return edge;
}

float share_of(Particle owner, ivec2 offset, int channel) {
    if (masked) return owner.shares[channel];
    return border_share(owner.texel, offset, push.grid);
}

vec3 gather(vec3 sum, Particle center, ivec4 around) {
    if (around.z >= 2 && !has_shear) return sum;
    if (!inside(center.texel + around.xy)) return sum;
    Particle there = particle_at(center.texel + around.xy);
    precise vec3 closing = there.displacement - center.displacement;
    float share = around.w == 1 ? share_of(center, around.xy, around.z) : share_of(there, around.xy, around.z);
    float rest = length_at_rest(push.rest_length[around.z], around.w == 1 ? center.texel : there.texel, around.z);
    precise float relative_stiffness = push.relative_stiffness[around.z] * share;
    return add_pull(sum, spring_pull(edge_between(center, there), closing, rest, relative_stiffness,
                                      push.compression.x, push.strain_damping));
}

vec3 gather_element(vec3 sum, Particle first, Particle middle, Particle third, int channel, float factor) {
    ivec2 axis = third.texel - middle.texel;
    float share = bend_share(share_of(first, axis, channel), share_of(middle, axis, channel));
    vec3 difference = second_difference(edge_between(middle, first), edge_between(middle, third));
    difference = beyond_rest(difference, bend_target(middle.texel, channel));
    precise float scaled = factor * share;
    return add_bend(sum, difference, scaled);
}

/// Adds the up to three bending elements of one axis: before, around and after this particle.
vec3 gather_bend(vec3 sum, Particle center, ivec2 axis, int channel, float bend) {
    if (bend == 0.0f) return sum;
    ivec2 back = center.texel - axis, ahead = center.texel + axis;
    bool has_back = inside(back), has_ahead = inside(ahead);
    Particle before = center, after = center;
    if (has_back) before = particle_at(back);
    if (has_ahead) after = particle_at(ahead);
    if (inside(back - axis)) sum = gather_element(sum, particle_at(back - axis), before, center, channel, -bend);
    precise float twice = 2.0f * bend;
    if (has_back && has_ahead) sum = gather_element(sum, before, center, after, channel, twice);
    if (inside(ahead + axis)) sum = gather_element(sum, center, after, particle_at(ahead + axis), channel, -bend);
    return sum;
}

/// Adds the pull of one cell's twist; `factor` is -twist for the corners 00 and 11 and twist for 10 and 01. All four
/// corners compute the same difference, so that their pulls are opposite to the bit.
vec3 gather_cell(vec3 sum, Particle upper_left, Particle upper_right, Particle lower_left, Particle lower_right,
                 float factor) {
    vec3 difference = twist_difference(edge_between(upper_left, upper_right), edge_between(lower_left, lower_right));
    difference = beyond_rest(difference, bend_target(upper_left.texel, 2));
    if (!masked) return add_bend(sum, difference, factor);
    precise float scaled = factor * twist_share(upper_left.shares, upper_right.shares, lower_left.shares);
    return add_bend(sum, difference, scaled);
}

/// Adds the twist of the up to four cells around this particle, row by row.
vec3 gather_twist(vec3 sum, Particle center) {
    ivec2 texel = center.texel;
    bool has_left = texel.x > 0, has_right = texel.x + 1 < push.grid.x;
    bool has_up = texel.y > 0, has_down = texel.y + 1 < push.grid.y;
    Particle left = center, right = center, up = center, down = center;
    if (has_left) left = particle_at(texel + ivec2(-1, 0));
    if (has_right) right = particle_at(texel + ivec2(1, 0));
    if (has_up) up = particle_at(texel + ivec2(0, -1));
    if (has_down) down = particle_at(texel + ivec2(0, 1));
    if (has_up && has_left) sum = gather_cell(sum, particle_at(texel + ivec2(-1, -1)), up, left, center, -push.twist);
    if (has_up && has_right) sum = gather_cell(sum, up, particle_at(texel + ivec2(1, -1)), center, right, push.twist);
    if (has_down && has_left) sum = gather_cell(sum, left, center, particle_at(texel + ivec2(-1, 1)), down, push.twist);
    if (has_down && has_right)
        sum = gather_cell(sum, center, right, down, particle_at(texel + ivec2(1, 1)), -push.twist);
    return sum;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 position = LOAD(position_in, texel);
    vec4 moved = LOAD(displacement_in, texel);
    vec3 displacement = moved.xyz;
    if (advance) {
        advance_position(texel, position, displacement);
    } else {
        STORE_VECTOR(position_out, texel, position);
        STORE_VECTOR(position_remainder_out, texel, LOAD(position_remainder_in, texel));
    }
    if (position.w == 0.0f) {
        STORE_VECTOR(displacement_out, texel, vec4(displacement, 0.0f));
        STORE_VECTOR(displacement_remainder_out, texel, LOAD(displacement_remainder_in, texel));
        return;
    }
    Particle center = Particle(texel, position.xyz, displacement, vec4(0.0f));
    if (masked) center.shares = LOAD(spring_shares, texel);
    vec3 pull = empty_sum();
    pull = gather(pull, center, neighbour(0));
    pull = gather(pull, center, neighbour(1));
    pull = gather(pull, center, neighbour(2));
    pull = gather(pull, center, neighbour(3));
    pull = gather(pull, center, neighbour(4));
    pull = gather(pull, center, neighbour(5));
    pull = gather(pull, center, neighbour(6));
    pull = gather(pull, center, neighbour(7));
    if (has_bend) {
        pull = gather_bend(pull, center, ivec2(1, 0), 0, push.bend.x);
        pull = gather_bend(pull, center, ivec2(0, 1), 1, push.bend.y);
        pull = gather_twist(pull, center);
        if (own_rest) pull = add_pull_of(pull, bend_pull(texel), 1.0f);
    }
    vec4 force = force_on(texel);
    vec3 increment = explicit_increment(displacement, push.gravity_step.xyz, force.xyz, pull, position.w,
                                        push.force_step, push.damping_loss);
    step_displacement(texel, moved, increment, drag_loss(force.w, position.w, push.force_step));
}
