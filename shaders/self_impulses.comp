// This pass sums what contact with other cloths gives to a cloth: what it gives to all of its particles, since those of
// pairs within a cloth cancel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(SelfClothPush)
#define TOGETHER
#include "include/strips.h"
#include "include/together.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 2, rgba32f) uniform readonly imageBuffer before;      // w: what moved the particle
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer velocities;  // of these particles
#define IMPULSES_SLOT 4
#include "include/book_impulses.h"

float units;
ImpulseSum by_contact = no_impulse();

void add(ivec2 texel) {
    int place = (push.first.y + texel.y) * push.sheet.x + push.first.x + texel.x;
    float inverse_mass = LOAD(position, texel).w;
    if (imageLoad(before, place).w != self_pushed || !(inverse_mass > 0.0f)) return;
    vec3 motion = given_by_contact(imageLoad(velocities, place).xyz, LOAD(displacement, texel).xyz);
    by_contact = with_impulse(by_contact, impulse_of_motion(motion, reciprocal(inverse_mass)), units);
}

void main() {
    units = impulse_units();
    FOR_STRIP(texel, push.grid, add(texel))
    book(impulse_cloths, 0, by_contact);
}
