// This pass keeps the largest impulse that a substep added to each row of a cloth's sums, and the largest moment. One
// workgroup does all rows of a cloth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/impulse_types.h"
#include "shared/simulation_types.h"
#include "include/impulses.h"
#include "include/present.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(WorstImpulsesPush)
layout(set = 0, binding = 0, r32ui) uniform uimage2D impulses;

ivec2 place_of(int row, int number) {
    return ivec2(2 * number, int(cloth_place()) * impulse_tables * push.rows + row);
}

ImpulseWords words_at(int row, int number) {
    ivec2 place = place_of(row, number);
    return ImpulseWords(imageLoad(impulses, place).x, imageLoad(impulses, place + ivec2(1, 0)).x);
}

void put(int row, int number, ImpulseWords words) {
    ivec2 place = place_of(row, number);
    imageStore(impulses, place, uvec4(words.low, 0u, 0u, 0u));
    imageStore(impulses, place + ivec2(1, 0), uvec4(words.high, 0u, 0u, 0u));
}

/// Returns what the substep added to a number.
ImpulseWords added(int row, int number) {
    return words_difference(words_at(row, number), words_at(push.rows + row, number));
}

/// Keeps three numbers of a row, from the `first` on.
void keep(int row, int first) {
    int worst = 2 * push.rows + row;
    float now = squared_impulse(added(row, first), added(row, first + 1), added(row, first + 2));
    float most = squared_impulse(words_at(worst, first), words_at(worst, first + 1), words_at(worst, first + 2));
    for (int number = first; number < first + 3; ++number) {
        if (now > most) put(worst, number, added(row, number));
        put(push.rows + row, number, words_at(row, number));
    }
}

void main() {
    int row = int(gl_GlobalInvocationID.x) + impulse_air;
    while (row < push.rows) {
        keep(row, 0);
        keep(row, 3);
        row += workgroup_width;
    }
}
