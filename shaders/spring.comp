// This kernel relaxes the springs of one direction and parity with an invocation per spring. Such springs share no
// particle. Where `masked`, the spring shares come from an image (holes, cuts). It may store the springs' tension, for
// the next iteration of the substep and for the stretch error.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(SpringPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
layout(constant_id = 24) const bool stores_tension = false;
layout(set = 0, binding = 4, r32f) uniform readonly image2D tension_in;
SCALAR_OUT(5, tension_out);

#include "include/rest_length.h"

void main() {
    ivec2 pair = ivec2(gl_GlobalInvocationID.xy);
    if (pair.x >= push.pair_count.x || pair.y >= push.pair_count.y) return;
    ivec2 first = spring_owner(pair, push.offset, push.parity_axis, push.parity);
    ivec2 second = first + push.offset;
    vec4 position_first = LOAD(position, first);
    vec4 position_second = LOAD(position, second);
    vec4 displacement_first = LOAD(displacement_in, first);
    vec4 displacement_second = LOAD(displacement_in, second);
    float weight_first = dragged_weight(position_first.w, displacement_first.w);
    float weight_second = dragged_weight(position_second.w, displacement_second.w);
    float share = border_share(first, push.offset, push.grid);
    if (masked) share = LOAD(spring_shares, first)[push.channel];
    float tension = 0.0f;
    if (stores_tension)
        if (given.first_iteration == 0) tension = LOAD(tension_in, first).x;
    vec3 edge = spring_edge(position_first.xyz, position_second.xyz, displacement_first.xyz, displacement_second.xyz);
    precise float weight_sum = weight_first + weight_second;
    SpringResult result = project_spring(edge, weight_sum, length_at_rest(push.rest_length, first, push.channel), share,
                                         push.compression, push.compliance, tension);
    vec3 moved_first = moved_by(displacement_first.xyz, result.correction, -weight_first);
    vec3 moved_second = moved_by(displacement_second.xyz, result.correction, weight_second);
    STORE_VECTOR(displacement_out, first, vec4(moved_first, displacement_first.w));
    STORE_VECTOR(displacement_out, second, vec4(moved_second, displacement_second.w));
    if (stores_tension) STORE_SCALAR(tension_out, first, result.tension);
}
