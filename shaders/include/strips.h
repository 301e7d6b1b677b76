// Loops over a part of a grid's particles, counted row by row. `statement`, a call for particle `texel`, runs once for
// each of the `strip_length` particles that an invocation processes: on the default device it costs as much to begin a
// workgroup as to process a dozen particles or more (docs/devices.md). The invocations of one of its subgroups take
// adjacent particles, so that memory is read in order; on any other device, where `strip_length` is 1, all invocations
// do. The loop has its test at the bottom (include/every.h).
#include "include/places.h"
layout(constant_id = 20) const int strip_length = 1;
const int strip_lanes = 8;  // invocations of a subgroup of the default device
int strip_first() {
    int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x), lane = int(gl_LocalInvocationIndex);
    return (group * workgroup_width + lane / strip_lanes * strip_lanes) * strip_length + lane % strip_lanes;
}
#define FOR_STRIP(texel, size, statement)                         \
    {                                                             \
        int place = strip_first(), count = (size).x * (size).y;   \
        int end = min(place + strip_length * strip_lanes, count); \
        if (place >= count) return;                               \
        for (;;) {                                                \
            ivec2 texel = texel_of(place, (size).x);              \
            statement;                                            \
            place += strip_lanes;                                 \
            if (place >= end) break;                              \
        }                                                         \
    }
// Loops over those of the particles for which the call `test` returns true (include/every.h, FOR_FOUND); at most 32 for
// each invocation.
#define FOR_STRIP_FOUND(texel, size, test, statement)                                       \
    {                                                                                       \
        int first = strip_first(), count = (size).x * (size).y;                             \
        int end = min(first + strip_length * strip_lanes, count);                           \
        if (first >= count) return;                                                         \
        uint found = 0u;                                                                    \
        for (int place = first, bit = 0;;) {                                                \
            ivec2 texel = texel_of(place, (size).x);                                        \
            found |= test ? 1u << bit : 0u;                                                 \
            place += strip_lanes;                                                           \
            ++bit;                                                                          \
            if (place >= end) break;                                                        \
        }                                                                                   \
        for (;;) {                                                                          \
            ivec2 texel = texel_of(first + max(findLSB(found), 0) * strip_lanes, (size).x); \
            if (found != 0u) statement;                                                     \
            found &= max(found, 1u) - 1u;                                                   \
            if (found == 0u) break;                                                         \
        }                                                                                   \
    }
