// This pass computes the impulses of the pairs that touch, from the motions under the previous round's impulses, and
// sums them as integers, so that the order does not matter. The first round also sums the impulses that lead pairs
// apart that lack some of their thickness; the last one records what every pair bears, for the next substep, and
// sums the couples of friction. Where it
// `looks_back`, the pass finds instead, from none on, the impulses that the motions of the substep before would have
// called for (docs/solvers.md, "Substeps that change").
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
#include "include/self_sheet.h"
layout(set = 0, binding = 4, std430) buffer Touching { SelfTouch touching[]; };
layout(set = 0, binding = 5, std430) readonly buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 6, std430) buffer Borne { SelfBorne borne[]; };
layout(set = 0, binding = 7, rgba32f) uniform readonly imageBuffer supports;
#include "include/self_sewn.h"
#define SUMS_SLOT 8
#define SUMS_IN_SLOT 9
#include "include/self_sums.h"

layout(constant_id = 24) const bool looks_back = false;
#include "include/self_carried.h"

struct Corner {
    vec3 at;
    vec3 motion;  // under the previous round's impulses, m
    float mass, holds;
};

bool begins_with_none() { return looks_back && push.round == 0; }

Corner corner_of(uint which, SelfCloth cloth) {
    ivec2 texel = self_texel(which);
    int place = place_of(texel), leader = leader_of(place);
    vec4 position = imageLoad(positions, texel);
    precise float mass = position.w * cloth.lightness;
    vec3 moved = imageLoad(displacements, texel).xyz, by = vec3(0.0f, 0.0f, 0.0f);
    if (!begins_with_none()) by = self_moved_by(impulse_of(sum_of(push.round, leader), cloth.largest), mass);
    Support support = Support(imageLoad(supports, 2 * place), imageLoad(supports, 2 * place + 1));
    vec3 motion = self_relative_motion(supported(self_added(moved, by), support), carried_at(place));
    return Corner(position.xyz, motion, mass, self_holds(sum_of(0, leader).z_weight.z));
}

void bear(bool edges, SelfTouch touch) {
    uint entry = atomicAdd(borne[0].corners.x, 1u) + 1u;
    vec3 force = self_borne_force(touch.impulse.xyz, push.step);
    borne[entry] = SelfBorne(touch.corners, uvec4(floatBitsToUint(force), edges ? 1u : 0u));
}

void work(bool edges, int entry) {
    SelfTouch touch = touching[entry];
    SelfCloth one = cloth_at(self_texel(touch.corners.x)), other = cloth_at(self_texel(touch.corners.w));
    Corner a = corner_of(touch.corners.x, one);
    Corner b = corner_of(touch.corners.y, edges ? one : other);
    Corner c = corner_of(touch.corners.z, other), d = corner_of(touch.corners.w, other);
    float yields = self_yields(touch.weights, vec4(a.mass, b.mass, c.mass, d.mass),
                               vec4(a.holds, b.holds, c.holds, d.holds));
    vec3 relative = self_sum(touch.weights, SelfCorners(a.motion, b.motion, c.motion, d.motion));
    if (begins_with_none()) touch.impulse.xyz = vec3(0.0f, 0.0f, 0.0f);
    touch.impulse.xyz = self_next_impulse(touch, relative, yields);
    touching[entry].impulse = touch.impulse;
    bool presses = touch.impulse.x != 0.0f || touch.impulse.y != 0.0f || touch.impulse.z != 0.0f;
    if (presses) add_impulse(push.round + 1, edges, touch.corners, touch.weights, touch.impulse.xyz, one.largest);
    if (looks_back) return;
    float leads = push.round == 0 ? self_leading(touch, yields) : 0.0f;
    precise vec3 leading = touch.normal.xyz * leads;
    if (leads > 0.0f) add_impulse(self_sum_of_thickness, edges, touch.corners, touch.weights, leading, one.largest);
    if (push.round != self_iterations - 1 || !presses) return;
    SelfCorners x = self_relative(SelfCorners(a.at, b.at, c.at, d.at));
    add_couple(touch.corners, self_half_couple(touch.weights, x, touch.impulse.xyz, one.largest), one.largest);
    bear(edges, touch);
}

void main() {
    load_carried();
    int points = self_both_listed(record[0].touching_point_count, record[0].touching_edge_count,
                                  push.touching_capacity);
    int edges = self_both_listed(record[0].touching_edge_count, record[0].touching_point_count,
                                 push.touching_capacity);
    if (!looks_back && push.round == 0 && gl_GlobalInvocationID.x == 0u) borne[0].corners.x = 0u;
    FOR_EVERY(i, points, work(false, i))
    FOR_EVERY(i, edges, work(true, push.touching_capacity - 1 - i))
}
