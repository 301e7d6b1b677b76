// This pass finds the area of each particle of cloth that closes gas in (include/gas.h), turned outwards, in the place
// of the force of the air, which comes after it. Of other sewn cloth it is nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/gas_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/wind.h"
#include "include/gas.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(GasAreaPush)
#include "include/state_store.h"
layout(constant_id = 0) const bool lags = false;  // the positions lack the last substep's displacement
layout(constant_id = 24) const bool masked = false;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
VECTOR_OUT(2, wind_force);
layout(set = 0, binding = 3, r32ui) uniform readonly uimage2D air;

vec3 place(ivec2 texel) {
    ivec2 at = max(min(texel, push.grid - 1), ivec2(0));
    precise vec3 now = LOAD(position, at).xyz;
    if (lags) now = now + LOAD(displacement, at).xyz;
    return now;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    uint quarters = border_air(texel, push.grid);
    if (masked) quarters = LOAD(air, texel).x;
    vec3 own = place(texel);
    precise vec3 left = place(texel + ivec2(-1, 0)) - own, right = place(texel + ivec2(1, 0)) - own;
    precise vec3 up = place(texel + ivec2(0, -1)) - own, down = place(texel + ivec2(0, 1)) - own;
    precise vec3 up_left = place(texel + ivec2(-1, -1)) - own, up_right = place(texel + ivec2(1, -1)) - own;
    precise vec3 down_left = place(texel + ivec2(-1, 1)) - own, down_right = place(texel + ivec2(1, 1)) - own;
    GasEdges edges = GasEdges(left, right, up, down, up_left, up_right, down_left, down_right);
    vec3 area = gas_turned(gas_area(edges, quarters), push.sign);
    STORE_VECTOR(wind_force, texel, vec4(area, 0.0f));
}
