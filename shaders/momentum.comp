// This pass adds a cloth's momentum to the sums of a frame's impulses, or takes it from them, and where the masses of
// free particles are. Particles that are held have the momentum of their pins' motion. Where it `splits` what holds the
// cloth among its pins, it adds what holds the springs of theirs, as if that acted for half of the frame. Where
// `masked`, masses and spring shares come from images (holes, maps, cuts). Where the frame `keeps_contact`, it begins what
// contact gives to each particle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/impulse_types.h"
#include "shared/simulation_types.h"
#include "include/explicit.h"
#include "include/push.h"
#include "include/statistics.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(MomentumPush)
#define TOGETHER
#include "include/strips.h"
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D end_excess;
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, r32f) uniform readonly image2D mass_share;
#define IMPULSES_SLOT 4
#include "include/book_impulses.h"

layout(constant_id = 16) const bool splits = false;
layout(constant_id = 17) const uint tensions = 0u;  // bit k: the tension of direction k is known
layout(set = 0, binding = 5, r32ui) uniform readonly uimage2D pin_numbers;  // 0: no pin, else 1 and its number
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 7, r32f) uniform readonly image2D tension_row;
layout(set = 0, binding = 8, r32f) uniform readonly image2D tension_column;
layout(set = 0, binding = 9, r32f) uniform readonly image2D tension_shear_down_right;
layout(set = 0, binding = 10, r32f) uniform readonly image2D tension_shear_down_left;
layout(constant_id = 18) const int first_pin_row = 0;
layout(constant_id = 33) const bool keeps_contact = false;
layout(set = 0, binding = 11, rgba32f) uniform image2D contact_impulses;
#include "include/rest_length.h"

float units;
ImpulseSum momentum = no_impulse(), moment = no_impulse();

float share_of(ivec2 owner, ivec2 offset, int channel) {
    if (masked) return LOAD(spring_shares, owner)[channel];
    return border_share(owner, offset, push.grid);
}

float tension_of(ivec2 owner, vec3 edge, int channel) {
    if ((tensions & 1u) != 0u)
        if (channel == 0) return LOAD(tension_row, owner).x;
    if ((tensions & 2u) != 0u)
        if (channel == 1) return LOAD(tension_column, owner).x;
    if ((tensions & 4u) != 0u)
        if (channel == 2) return LOAD(tension_shear_down_right, owner).x;
    if ((tensions & 8u) != 0u)
        if (channel == 3) return LOAD(tension_shear_down_left, owner).x;
    return tension_of_edge(edge, length_at_rest(push.rest_length[channel], owner, channel), push.compression);
}

vec3 with_neighbour(vec3 sum, ivec2 texel, ivec4 around) {
    ivec2 there = texel + around.xy;
    bool inside = there.x >= 0 && there.y >= 0 && there.x < push.grid.x && there.y < push.grid.y;
    if (!inside || push.rest_length[around.z] == 0.0f) return sum;
    ivec2 owner = around.w == 1 ? texel : there;
    precise vec3 edge = LOAD(position, there).xyz - LOAD(position, texel).xyz;
    precise float pull = push.pull[around.z] * share_of(owner, around.xy, around.z);
    return with_held_spring(sum, edge, tension_of(owner, edge, around.z), pull);
}

/// Adds what holds a particle's springs to the sums of its pin.
void hold(ivec2 texel) {
    uint pin = LOAD(pin_numbers, texel).x;
    if (pin == 0u) return;
    vec3 sum = vec3(-0.0f);  // the sum of nothing
    for (int k = 0; k < neighbour_count; ++k) sum = with_neighbour(sum, texel, neighbour(k));
    book(first_pin_row + int(pin) - 1, 0, with_impulse(no_impulse(), sum, units));
}

void add(ivec2 texel) {
    vec4 place = LOAD(position, texel);
    float mass = border_mass_share(texel, push.grid);
    if (masked) mass = LOAD(mass_share, texel).x;
    vec3 own = momentum_of(LOAD(displacement, texel).xyz, LOAD(end_excess, texel).xyz, mass);
    precise float signed_units = push.sign * units, signed_travel = push.sign * travel_units;
    momentum = with_impulse(momentum, own, signed_units);
    moment = with_impulse(moment, moment_of_mass(place.xyz, place.w == 0.0f ? 0.0f : mass), signed_travel);
    if (splits)
        if (place.w == 0.0f) hold(texel);
    if (keeps_contact)
        if (push.sign < 0.0f) imageStore(contact_impulses, placed(texel), vec4(0.0f));
}

void main() {
    units = impulse_units();  // before anything branches (docs/devices.md)
    FOR_STRIP(texel, push.grid, add(texel))
    book(impulse_momentum, 0, momentum);
    book(impulse_momentum, 3, moment);
}
