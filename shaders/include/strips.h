// A loop over a part of a column: `statement`, a call for particle `texel`, once for each of the `strip_rows` rows that
// an invocation takes in turn. On the default device a workgroup costs as much to begin as a dozen particles or more
// (docs/devices.md). The loop ends at its bottom (include/every.h).
layout(constant_id = 20) const int strip_rows = 1;
#define FOR_STRIP(texel, size, statement)                                                           \
    {                                                                                               \
        int column = int(gl_GlobalInvocationID.x), row = int(gl_GlobalInvocationID.y) * strip_rows; \
        int end = min(row + strip_rows, (size).y);                                                  \
        if (column >= (size).x || row >= (size).y) return;                                          \
        for (;;) {                                                                                  \
            ivec2 texel = ivec2(column, row);                                                       \
            statement;                                                                              \
            ++row;                                                                                  \
            if (row >= end) break;                                                                  \
        }                                                                                           \
    }
// Likewise for those of the particles for which `test`, a call, says that there is something to do (include/every.h,
// FOR_FOUND); at most 32 rows.
#define FOR_STRIP_FOUND(texel, size, test, statement)                                                 \
    {                                                                                                 \
        int column = int(gl_GlobalInvocationID.x), first = int(gl_GlobalInvocationID.y) * strip_rows; \
        int end = min(first + strip_rows, (size).y);                                                  \
        if (column >= (size).x || first >= (size).y) return;                                          \
        uint found = 0u;                                                                              \
        for (int row = first;;) {                                                                     \
            ivec2 texel = ivec2(column, row);                                                         \
            found |= test ? 1u << (row - first) : 0u;                                                 \
            ++row;                                                                                    \
            if (row >= end) break;                                                                    \
        }                                                                                             \
        for (;;) {                                                                                    \
            ivec2 texel = ivec2(column, first + max(findLSB(found), 0));                              \
            if (found != 0u) statement;                                                               \
            found &= max(found, 1u) - 1u;                                                             \
            if (found == 0u) break;                                                                   \
        }                                                                                             \
    }
