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
