// This pass prepares the pairs that touch: how they lie, the impulse that they bore in the last substep and now begin
// with, and how strongly contacts hold each corner.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/simulation_types.h"
#include "include/every.h"
#include "include/push.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
#include "include/self_cloths.h"
#include "include/self_sewn.h"
#include "include/self_skins.h"
layout(set = 0, binding = 4, std430) buffer Touching { SelfTouch touching[]; };
layout(set = 0, binding = 5, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 6, std430) readonly buffer FirstBorne { uint first_borne[]; };
layout(set = 0, binding = 7, std430) readonly buffer Borne { SelfBorne borne[]; };
#define SUMS_SLOT 8
#include "include/self_sums.h"

vec3 where(uint corner) { return imageLoad(positions, self_texel(corner)).xyz; }

/// Returns the force that a pair bore in the last substep, zero if it did not touch.
vec3 force_borne(bool edges, uvec4 pair) {
    vec3 force = vec3(0.0f, 0.0f, 0.0f);
    int chain = place_of(self_texel(pair.x)) * self_chains + self_chain(pair);
    for (uint k = first_borne[chain]; k != self_no_entry; k = borne[k].force.w >> 1)
        if (borne[k].corners == pair && ((borne[k].force.w & 1u) != 0u) == edges)
            force = uintBitsToFloat(borne[k].force.xyz);
    return force;
}

void begin(bool edges, int entry) {
    uvec4 pair = touching[entry].corners;
    SelfGap gap = self_gap(edges, SelfCorners(where(pair.x), where(pair.y), where(pair.z), where(pair.w)));
    vec2 own = pair_skin(edges, pair, gap.weights);  // thickness, friction
    vec3 begun = self_begun(gap.normal, force_borne(edges, pair), own.y, push.step);
    touching[entry].weights = gap.weights;
    touching[entry].normal = vec4(gap.normal, self_freedom(gap.distance, own.x, push.step));
    touching[entry].impulse = vec4(begun, own.y);
    add_weight(pair.x, self_weight(gap.weights.x));
    add_weight(pair.y, self_weight(gap.weights.y));
    add_weight(pair.z, self_weight(gap.weights.z));
    add_weight(pair.w, self_weight(gap.weights.w));
    if (begun.x != 0.0f || begun.y != 0.0f || begun.z != 0.0f)
        add_impulse(0, edges, pair, gap.weights, begun, cloth_at(self_texel(pair.x)).largest);
}

void main() {
    int points = self_both_listed(record[0].touching_point_count, record[0].touching_edge_count,
                                  push.touching_capacity);
    int edges = self_both_listed(record[0].touching_edge_count, record[0].touching_point_count,
                                 push.touching_capacity);
    FOR_EVERY(i, points, begin(false, i))
    FOR_EVERY(i, edges, begin(true, push.touching_capacity - 1 - i))
}
