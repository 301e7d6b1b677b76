// This pass finds the pressure of a gas in a substep (include/gas.h), for each cloth that closes it in alike: lane l
// takes every 64th of the records of all these cloths from the l-th on, then a tree joins the lanes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/gas_types.h"
#include "shared/line_types.h"
#include "shared/seam_types.h"
#include "shared/simulation_types.h"
#include "include/bdf2.h"
#include "include/push.h"
#include "include/gas.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GasPush)
layout(set = 0, binding = 0, std430) readonly buffer GasSums { GasSum gas_sums[]; };
layout(set = 0, binding = 1, std430) readonly buffer Wind { vec4 wind[]; };
layout(set = 0, binding = 2, rgba32f) uniform image2D gas;
layout(constant_id = 22) const bool second_order = false;
layout(constant_id = 2) const bool sewn_to_others = false;
layout(set = 0, binding = 3, r32ui) uniform readonly uimage2D line_control_in;
layout(set = 0, binding = 4, std430) readonly buffer SewnPlaces { SewnPlace sewn_places[]; };

#define RECORD GasSum
#include "include/workgroup_reduction.h"
#include "include/last_control.h"

bool is_bdf2;  // both are read before anything has branched (docs/devices.md)
vec3 origin;

void main() {
    is_bdf2 = false;
    if (second_order) is_bdf2 = next_control(last_control(), push.most_wrong).order == 2u;
    origin = gas_sums[push.first].origin.xyz;
    GasSum sum = empty_gas_sum();
    for (int i = int(gl_LocalInvocationIndex); i < push.count; i += workgroup_width)
        sum = joined(sum, gas_seen(gas_sums[push.first + i], origin));
    sum = joined_over_workgroup(sum);
    if (gl_LocalInvocationIndex != 0u) return;
    GasState last = GasState(imageLoad(gas, ivec2(0, 0)), imageLoad(gas, ivec2(1, 0)));
    float amount = 0.0f;
    if (push.ends == 0) amount = wind[push.weather].x;
    GasState next = gas_next(sum, last, amount, is_bdf2, push);
    imageStore(gas, ivec2(0, 0), next.now);
    imageStore(gas, ivec2(1, 0), next.kept);
}
