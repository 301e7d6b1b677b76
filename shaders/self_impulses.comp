// This pass sums what contact with other cloths gives to a cloth: what it gives to all of its particles, since those of
// pairs within a cloth cancel. Where it `keeps_contact`, each particle gets what it was given by both.
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

layout(constant_id = 33) const bool keeps_contact = false;
layout(set = 0, binding = 5, rgba32f) uniform image2D contact_impulses;

float units;
ImpulseSum by_contact = no_impulse();

void add(ivec2 texel) {
    int place = (push.first.y + texel.y) * push.sheet.x + push.first.x + texel.x;
    float inverse_mass = LOAD(position, texel).w;
    if (imageLoad(before, place).w != self_pushed || !(inverse_mass > 0.0f)) return;
    vec3 motion = given_by_contact(imageLoad(velocities, place).xyz, LOAD(displacement, texel).xyz);
    vec3 impulse = impulse_of_motion(motion, reciprocal(inverse_mass));
    by_contact = with_impulse(by_contact, impulse, units);
    if (!keeps_contact) return;
    vec3 sum = more_impulse(LOAD(contact_impulses, texel).xyz, impulse);
    imageStore(contact_impulses, placed(texel), vec4(sum, 0.0f));
}

void main() {
    units = impulse_units();
    FOR_STRIP(texel, push.grid, add(texel))
    book(impulse_cloths, 0, by_contact);
}
