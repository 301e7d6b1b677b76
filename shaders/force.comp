// This pass is Verlet's prediction under gravity and damping: it finishes the last substep (X += d, after the first
// substep of a frame) and predicts the next displacement. Where `windy`, it adds the wind's force. Particles with w = 0
// feel no force; the pin pass moves those that key frames move. In the last substep of a frame it may store the
// displacement of the previous one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(ForcePush)
#define TOGETHER
#include "include/strips.h"
const bool in_place = true;
#include "include/substep_state.h"

layout(constant_id = 0) const bool advance = false;  // the positions lack the last substep's displacement
layout(constant_id = 24) const bool keeps_before = false;
VECTOR_OUT(9, displacement_before);

void predict(ivec2 texel) {
    vec4 position = LOAD(position_in, texel);
    vec4 moved = LOAD(displacement_in, texel);
    vec3 displacement = moved.xyz;
    if (advance) advance_position(texel, position, displacement);
    if (keeps_before) STORE_VECTOR(displacement_before, texel, vec4(displacement, 0.0f));
    if (position.w == 0.0f) {
        STORE_VECTOR(displacement_out, texel, moved);
        return;
    }
    vec4 force = force_on(texel);
    vec3 increment =
        verlet_increment(displacement, push.gravity_step.xyz, force.xyz, position.w, push.force_step, push.damping_loss);
    step_displacement(texel, moved, increment, drag_loss(force.w, position.w, push.force_step));
}

void main() { FOR_STRIP(texel, push.grid, predict(texel)) }
