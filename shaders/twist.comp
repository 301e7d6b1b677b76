// This plain kernel relaxes the twist of one colour of the cells with an invocation per cell. Cells of one colour share
// no particle. Where `masked`, the spring shares say whether a cell is whole (holes, cuts). In
// `second_order` the control says whether this substep is BDF2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(TwistPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
#include "include/bend_target.h"
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D line_control;

void main() {
    ivec2 element = ivec2(gl_GlobalInvocationID.xy);
    if (element.x >= push.element_count.x || element.y >= push.element_count.y) return;
    ivec2 upper_left = twist_corner(element, push.first);
    ivec2 upper_right = upper_left + ivec2(1, 0);
    ivec2 lower_left = upper_left + ivec2(0, 1);
    ivec2 lower_right = upper_left + ivec2(1, 1);
    float share = 1.0f;
    if (masked)
        share = twist_share(LOAD(spring_shares, upper_left), LOAD(spring_shares, upper_right),
                            LOAD(spring_shares, lower_left));
    vec4 position_00 = LOAD(position, upper_left);
    vec4 position_10 = LOAD(position, upper_right);
    vec4 position_01 = LOAD(position, lower_left);
    vec4 position_11 = LOAD(position, lower_right);
    vec4 moved_00 = LOAD(displacement_in, upper_left);
    vec4 moved_10 = LOAD(displacement_in, upper_right);
    vec4 moved_01 = LOAD(displacement_in, lower_left);
    vec4 moved_11 = LOAD(displacement_in, lower_right);
    float weight_00 = dragged_weight(position_00.w, moved_00.w);
    float weight_10 = dragged_weight(position_10.w, moved_10.w);
    float weight_01 = dragged_weight(position_01.w, moved_01.w);
    float weight_11 = dragged_weight(position_11.w, moved_11.w);
    vec3 difference = twist_difference(spring_edge(position_00.xyz, position_10.xyz, moved_00.xyz, moved_10.xyz),
                                       spring_edge(position_01.xyz, position_11.xyz, moved_01.xyz, moved_11.xyz));
    difference = beyond_rest(difference, bend_target(upper_left, 2));
    float weight = twist_weight(weight_00, weight_10, weight_01, weight_11);
    float compliance = push.compliance;
    if (second_order)
        if (imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u) compliance = push.compliance_bdf2;
    vec3 correction = project_bend(difference, weight, share, compliance);
    STORE_VECTOR(displacement_out, upper_left, vec4(moved_by(moved_00.xyz, correction, weight_00), moved_00.w));
    STORE_VECTOR(displacement_out, upper_right, vec4(moved_by(moved_10.xyz, correction, -weight_10), moved_10.w));
    STORE_VECTOR(displacement_out, lower_left, vec4(moved_by(moved_01.xyz, correction, -weight_01), moved_01.w));
    STORE_VECTOR(displacement_out, lower_right, vec4(moved_by(moved_11.xyz, correction, weight_11), moved_11.w));
}
