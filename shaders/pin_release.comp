// This pass frees particles whose pin is released, with their pin's velocity: from then on w is their own inverse mass.
// Particles that a pin takes get w = 0. The substep that follows a release is the first without the pin's force
// (include/pin.h). Where the method `carries_to_release`, the springs' last pull comes from their stored tension. In
// `second_order` it asks the control for backward Euler substeps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/explicit.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/pin.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;  // the positions lack the last substep's displacement
CLOTH_CONSTANTS(ReleasePush)
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
VECTOR_OUT(1, position_out);
layout(set = 0, binding = 2, std430) readonly buffer PinnedParticles { PinnedParticle pinned_particles[]; };
layout(set = 0, binding = 3, std430) readonly buffer PinMotions { PinMotion pin_motions[]; };
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(6, displacement_out);
VECTOR_OUT(7, displacement_remainder);
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 4, r32ui) uniform uimage2D line_control;
layout(constant_id = 24) const bool carries_to_release = false;
layout(set = 0, binding = 8, r32f) uniform readonly image2D tension_row;
layout(set = 0, binding = 9, r32f) uniform readonly image2D tension_column;
layout(set = 0, binding = 10, r32f) uniform readonly image2D tension_shear_down_right;
layout(set = 0, binding = 11, r32f) uniform readonly image2D tension_shear_down_left;
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 12, rgba32f) uniform readonly image2D spring_shares;

float tension_at(ivec2 owner, int direction) {
    if (direction == 0) return imageLoad(tension_row, owner).x;
    if (direction == 1) return imageLoad(tension_column, owner).x;
    if (direction == 2) return imageLoad(tension_shear_down_right, owner).x;
    return imageLoad(tension_shear_down_left, owner).x;
}

/// `cloth`: texel of the cloth's first particle.
float share_of(ivec2 cloth, ivec2 owner, ivec2 offset, int direction) {
    if (masked) return imageLoad(spring_shares, owner)[direction];
    return border_share(owner - cloth, offset, push.grid);
}

/// Returns the displacement by which the springs' tension would move an inner particle at `texel` in a substep, m.
vec3 pull_of_springs(ivec2 cloth, ivec2 texel) {
    vec3 start = imageLoad(position_in, texel).xyz, moved = imageLoad(displacement_in, texel).xyz;
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int k = 0; k < neighbour_count; ++k) {
        ivec4 around = neighbour(k);
        ivec2 there = texel + around.xy, place = there - cloth;
        if (place.x < 0 || place.y < 0 || place.x >= push.grid.x || place.y >= push.grid.y) continue;
        vec3 start_there = imageLoad(position_in, there).xyz, moved_there = imageLoad(displacement_in, there).xyz;
        precise vec3 edge = start_there - start;
        if (advance) edge = spring_edge(start, start_there, moved, moved_there);
        ivec2 owner = around.w == 1 ? texel : there;
        precise float stiffness =
            push.relative_stiffness[around.z] * share_of(cloth, owner, around.xy, around.z);
        sum = add_tension_pull(sum, edge, tension_at(owner, around.z), stiffness);
    }
    return sum;
}

void main() {
    int particle = int(gl_GlobalInvocationID.x);
    if (particle >= given.particle_count) return;
    ivec4 index = pinned_particles[particle].index;
    int cloth = index.w / given.grid.y;
    if (!is_present(uint(cloth))) return;
    push = constants_of(uint(cloth));  // a list of pins contains those of all cloths
    vec4 rest = pinned_particles[particle].rest;
    PinMotion motion = pin_motions[given.motion_first + index.z];
    if (rest.w == 0.0f || !is_pinned(motion, ivec2(index.x, index.y - index.w))) return;
    vec4 position = imageLoad(position_in, index.xy);
    bool holds = motion.held.x != 0.0f;
    if (holds == (position.w == 0.0f)) return;
    STORE_IN_COLUMNS(position_out, index.xy, push.grid.x, vec4(position.xyz, holds ? 0.0f : rest.w))
    if (second_order) imageAtomicMax(line_control, ivec2(control_hold, cloth), line_hold_release);
    if (holds) return;
    vec3 displacement = imageLoad(displacement_in, index.xy).xyz;
    vec3 pull = vec3(0.0f, 0.0f, 0.0f);
    if (carries_to_release) pull = pull_of_springs(ivec2(0, index.w), index.xy);
    float surplus = release_surplus(motion);
    precise vec3 now = position.xyz;
    if (advance) now = now + displacement;
    precise vec3 velocity_step = pin_target(motion, motion.held.z != 0.0f ? now : rest.xyz) - displacement;
    STORE_IN_COLUMNS(displacement_out, index.xy, push.grid.x, vec4(displacement, release_mark(surplus)))
    vec4 remainder = vec4(release_remainder(velocity_step, rest.w, surplus, pull, push.reach), 0.0f);
    STORE_IN_COLUMNS(displacement_remainder, index.xy, push.grid.x, remainder)
}
