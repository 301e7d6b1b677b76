// This kernel relaxes one colour of the bending elements of one axis with an invocation per element. Elements of one
// colour share no particle. Where `masked`, the spring shares come from an image (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(BendPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
#include "include/bend_target.h"

float share_of(ivec2 owner) {
    if (masked) return LOAD(spring_shares, owner)[push.channel];
    return border_share(owner, push.axis, push.grid);
}

void main() {
    ivec2 element = ivec2(gl_GlobalInvocationID.xy);
    if (element.x >= push.element_count.x || element.y >= push.element_count.y) return;
    ivec2 middle = bend_middle(element, push.axis, push.colour);
    ivec2 first = middle - push.axis;
    ivec2 third = middle + push.axis;
    vec4 position_first = LOAD(position, first);
    vec4 position_middle = LOAD(position, middle);
    vec4 position_third = LOAD(position, third);
    vec4 moved_first = LOAD(displacement_in, first);
    vec4 moved_middle = LOAD(displacement_in, middle);
    vec4 moved_third = LOAD(displacement_in, third);
    float weight_first = dragged_weight(position_first.w, moved_first.w);
    float weight_middle = dragged_weight(position_middle.w, moved_middle.w);
    float weight_third = dragged_weight(position_third.w, moved_third.w);
    vec3 difference =
        second_difference(spring_edge(position_middle.xyz, position_first.xyz, moved_middle.xyz, moved_first.xyz),
                          spring_edge(position_middle.xyz, position_third.xyz, moved_middle.xyz, moved_third.xyz));
    difference = beyond_rest(difference, bend_target(middle, push.channel));
    vec3 correction = project_bend(difference, bend_weight(weight_first, weight_middle, weight_third),
                                   bend_share(share_of(first), share_of(middle)), push.compliance);
    precise float coefficient = -2.0f * weight_middle;
    STORE_VECTOR(displacement_out, first, vec4(moved_by(moved_first.xyz, correction, weight_first), moved_first.w));
    STORE_VECTOR(displacement_out, middle, vec4(moved_by(moved_middle.xyz, correction, coefficient), moved_middle.w));
    STORE_VECTOR(displacement_out, third, vec4(moved_by(moved_third.xyz, correction, weight_third), moved_third.w));
}
