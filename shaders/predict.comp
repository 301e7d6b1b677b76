// This pass is the prediction of the line solver in second order: it finishes the last substep (X += d, after the first
// substep of a frame), decides for each cloth whether the substep is BDF2 or backward Euler, shifts the history and
// predicts the next displacement. Where `windy`, it adds the wind's force. Particles with w = 0 have a history too, in
// case they are released. Cloths that are sewn together decide alike, by what seam_give.comp has joined.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/seam_types.h"
#include "shared/simulation_types.h"
#include "include/bdf2.h"
#include "include/push.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(PredictPush)
#define TOGETHER
#include "include/strips.h"
const bool in_place = true;
#include "include/substep_state.h"

layout(constant_id = 0) const bool advance = false;  // the positions lack the last substep's displacement
layout(constant_id = 1) const bool turns = false;    // the displacement goes to another image than the one read
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D displacement_before_in;
TRIPLE_OUT(10, displacement_before_out);
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D velocity_excess_in;
TRIPLE_OUT(12, velocity_excess_out);
layout(set = 0, binding = 13, r32ui) uniform readonly uimage2D line_control_in;
layout(set = 0, binding = 14, r32ui) uniform writeonly uimage2D line_control_out;
layout(constant_id = 2) const bool sewn_to_others = false;
layout(set = 0, binding = 15, std430) readonly buffer SewnPlaces { SewnPlace sewn_places[]; };

#include "include/last_control.h"

bool second_order;  // decided before anything has branched (docs/devices.md)

void store_control(int texel, uint value) {
    imageStore(line_control_out, ivec2(texel, cloth_place()), uvec4(value, 0u, 0u, 0u));
}

/// Every invocation decides, and one invocation of each cloth writes the decision.
void decide_order() {
    LineControl control = next_control(last_control(), push.most_wrong);
    second_order = control.order == 2u;
    if (gl_GlobalInvocationID.xy == uvec2(0u)) {
        store_control(control_order, control.order);
        store_control(control_wrong_lines, control.wrong_lines);
        store_control(control_hold, control.hold);
    }
}

void predict(ivec2 texel) {
    vec4 position = LOAD(position_in, texel);
    vec4 moved = LOAD(displacement_in, texel);
    vec3 displacement = moved.xyz;
    if (advance) advance_position(texel, position, displacement);
    vec3 before = LOAD(displacement_before_in, texel).xyz;
    vec3 excess_before = LOAD(velocity_excess_in, texel).xyz;
    vec3 excess = velocity_excess(displacement, before);
    STORE_TRIPLE(displacement_before_out, texel, displacement, 0.0f);
    STORE_TRIPLE(velocity_excess_out, texel, excess, 0.0f);
    if (position.w == 0.0f) {
        if (turns) STORE_VECTOR(displacement_out, texel, moved);
        return;
    }
    vec4 force = force_on(texel);
    vec3 increment;
    float loss;
    if (second_order) {
        vec3 forced = forced_step(push.gravity_step_bdf2.xyz, force.xyz, position.w, push.force_step.y);
        increment = bdf2_increment(displacement, before, excess, excess_before, forced, push.weight.x, push.weight.y,
                                   push.loss.y);
        loss = drag_loss(bdf2_drag(force.w), position.w, push.force_step.y);
    } else {
        increment = verlet_increment(displacement, push.gravity_step.xyz, force.xyz, position.w, push.force_step.x,
                                     push.loss.x);
        loss = drag_loss(force.w, position.w, push.force_step.x);
    }
    step_displacement(texel, moved, increment, loss);
}

void main() {
    decide_order();
    FOR_STRIP(texel, push.grid, predict(texel))
}
