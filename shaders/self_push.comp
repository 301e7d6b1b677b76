// This pass gives the particles the velocities that the contacts' impulses cause, and moves them by these and by what
// restores a missing thickness. Where some cloths `crossed` when they started, it adds the velocity that leads them
// apart. What moves a particle moves those that are sewn to it. Where it `looks_back`, it changes the motions of the
// substep before alike, which are no start of anything. In the substep that `ends_frame`, it clears the sums of the
// rounds for the rounds that look back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/self_apart.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;
#include "include/state_store.h"
VECTOR_OUT(4, displacements_out);
#include "include/self_cloths.h"
layout(set = 0, binding = 5, std430) writeonly buffer Velocities { vec4 velocities[]; };
layout(set = 0, binding = 6, std430) writeonly buffer MadeGood { vec4 made_good[]; };
layout(set = 0, binding = 7, std430) writeonly buffer Before { vec4 before[]; };
layout(set = 0, binding = 8, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 9, rgba32f) uniform readonly imageBuffer supports;
layout(constant_id = 24) const bool crossed = false;
layout(set = 0, binding = 10, std430) readonly buffer Led { vec4 led[]; };
layout(constant_id = 22) const bool looks_back = false;
layout(constant_id = 26) const bool ends_frame = false;
#define SUMS_IN_SLOT 11
#include "include/self_sums.h"
layout(set = 0, binding = 12, std430) writeonly buffer Sums { uvec4 sums[]; };  // two each
#include "include/self_sewn.h"

bool touching;  // some pairs touch; otherwise the sums belong to an earlier substep

bool pushed(int place) {
    if (crossed) return true;                  // its cloth may be led apart
    return sum_of(0, place).z_weight.z != 0u;  // some contact holds it
}

void clear_rounds(int place) {
    for (int round = 1; round <= self_iterations; ++round)
        for (int half_sum = 0; half_sum < 2; ++half_sum)
            sums[2 * (round * push.grid.x * push.grid.y + place) + half_sum] = uvec4(0u);
}

/// Stores the velocity of a particle and by what it is led off others.
void leave(int place, float bits, vec3 velocity, vec3 good) {
    ivec2 texel = texel_of(place);
    if (looks_back) {
        STORE_VECTOR(displacements_out, texel, vec4(velocity, 0.0f));
        return;
    }
    velocities[place] = vec4(velocity, 0.0f);
    made_good[place] = vec4(good, 0.0f);
    STORE_VECTOR(displacements_out, texel, vec4(self_added(velocity, good), bits));
    before[place].w = self_pushed;
}

void move(int place) {
    ivec2 texel = texel_of(place);
    float inverse_mass = imageLoad(positions, texel).w;
    if (owner_of(place) < 0 || !(inverse_mass > 0.0f) || leader_of(place) != place) return;
    vec4 moved = imageLoad(displacements_in, texel);
    SelfCloth cloth = cloth_at(texel);
    precise float mass = inverse_mass * cloth.lightness;
    vec3 nothing = vec3(0.0f, 0.0f, 0.0f);
    vec3 impulse = touching ? impulse_of(sum_of(self_iterations, place), cloth.largest) : nothing;
    vec3 leading = touching ? impulse_of(sum_of(self_sum_of_thickness, place), cloth.largest) : nothing;
    vec3 velocity = self_added(moved.xyz, self_moved_by(impulse, mass));
    if (ends_frame && !looks_back) clear_rounds(place);
    if (crossed) {
        vec3 by = led[max(owner_of(place), 0)].xyz;
        bool is_held = touching && sum_of(0, place).z_weight.z != 0u;
        if (!is_held && by.x == 0.0f && by.y == 0.0f && by.z == 0.0f) return;
        velocity = self_led(velocity, by);
    }
    vec3 good = self_led_by(self_moved_by(leading, mass), imageLoad(supports, 2 * place).xyz);
    leave(place, moved.w, velocity, good);
    if (sewn)
        for (int next = sewn_corners[place].next; next >= 0; next = sewn_corners[next].next)
            leave(next, imageLoad(displacements_in, texel_of(next)).w, velocity, good);
}

void main() {
    touching = record[0].touching_point_count + record[0].touching_edge_count > 0u;
    FOR_FOUND(place, push.grid.x * push.grid.y, pushed(place), move(place))
}
