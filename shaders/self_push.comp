// This pass moves the particles by the corrections with which the pairs push them. CROSSED adds in the first round the
// displacement that leads their cloth apart from others.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants WIDE CROSSED BUFFERED
#include "shared/simulation_types.h"
#include "include/every.h"
#ifdef CROSSED
#include "include/self_apart.h"
#endif
#include "include/self_contact.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfContactPush)
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacements_in;
#include "include/state_store.h"
VECTOR_OUT(8, DisplacementsOut, displacements_out);
#include "include/self_cloths.h"
layout(set = 0, binding = 4, rgba32f) uniform readonly imageBuffer corrections_in;  // integers, by their bits
layout(set = 0, binding = 5, rgba32f) uniform readonly imageBuffer before_in;
layout(set = 0, binding = 9, std430) writeonly buffer CorrectionsOut { ivec4 corrections_out[]; };
layout(set = 0, binding = 10, std430) writeonly buffer BeforeOut { vec4 before_out[]; };
layout(set = 0, binding = 6, std430) readonly buffer Record { SelfRecord record[]; };
#ifdef CROSSED
layout(set = 0, binding = 7, std430) readonly buffer Led { vec4 led[]; };
#endif

vec3 carried;  // record[0].carried, read where nothing has branched yet (docs/devices.md)

ivec4 corrections_of(int place) { return floatBitsToInt(imageLoad(corrections_in, place)); }

/// Returns whether a place may be pushed, before its sums are taken apart. A push has a weight above 0; should the sign
/// that is carried up from the sum below (self_contact.comp) make that 0, the sum itself is not 0.
bool pushed(int place) {
#ifdef CROSSED
    if (push.round == 0) return true;  // its cloth may be led
#endif
    ivec4 sum = corrections_of(place);
    return (sum.z | sum.w) != 0;
}

void move(int place) {
    ivec2 texel = texel_of(place);
    vec4 moved = imageLoad(displacements_in, texel);
    ivec4 sum = corrections_of(place);
#ifdef WIDE
    sum = self_sums(sum);
#endif
    bool moves = sum.w != 0;
#ifdef CROSSED
    vec3 by = push.round == 0 ? led[max(owner_of(place), 0)].xyz : vec3(0.0f, 0.0f, 0.0f);
    moves = moves || by.x != 0.0f || by.y != 0.0f || by.z != 0.0f;
#endif
    if (owner_of(place) >= 0 && moves && imageLoad(positions, texel).w > 0.0f) {
        corrections_out[place] = ivec4(0, 0, 0, 0);
        float thickness = cloth_at(texel).thickness;
        vec3 corrected = self_corrected(moved.xyz, sum, thickness);
#ifdef CROSSED
        corrected = self_led(corrected, by);
#endif
        vec3 bounded = self_bounded(corrected, imageLoad(before_in, place).xyz, carried, thickness);
        STORE_VECTOR(displacements_out, texel, vec4(bounded, moved.w));
        before_out[place].w = 1.0f;
    }
}

void main() {
    carried = record[0].carried.xyz;
    FOR_FOUND(place, push.grid.x * push.grid.y, pushed(place), move(place))
}
