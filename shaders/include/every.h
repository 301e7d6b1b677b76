// Loops over `count` entries; an invocation takes every gl_NumWorkGroups.x * workgroup_width-th entry. `statement` is a
// call for entry `entry`. On the default device a loop with its test at the top runs its body once more with no active
// invocation, which costs as much as a round, so this loop has its test at the bottom.
#define FOR_EVERY(entry, count, statement) \
    FOR_EVERY_FROM(entry, int(gl_GlobalInvocationID.x), int(gl_NumWorkGroups.x) * workgroup_width, count, statement)
// The same for an invocation that takes the `first` of the entries, and then every `stride`-th.
#define FOR_EVERY_FROM(entry, first, stride, count, statement) \
    for (int entry = (first);;) {                              \
        if (entry < (count)) statement;                        \
        entry += (stride);                                     \
        if (entry >= (count)) break;                           \
    }
// Runs `statement` for those entries for which the call `test` returns true. All tests for a word of bits come first,
// then `statement` as often as the invocation with the most such entries needs: on the default device the code behind a
// branch would run for every entry.
#define FOR_FOUND(entry, count, test, statement)                                                           \
    for (int stride = int(gl_NumWorkGroups.x) * workgroup_width, batch = int(gl_GlobalInvocationID.x);;) { \
        uint found = 0u;                                                                                   \
        for (int entry = batch, k = 0;;) {                                                                 \
            if (entry < (count)) found |= test ? 1u << k : 0u;                                             \
            entry += stride;                                                                               \
            ++k;                                                                                           \
            if (k == 32 || entry >= (count)) break;                                                        \
        }                                                                                                  \
        for (;;) {                                                                                         \
            int entry = batch + max(findLSB(found), 0) * stride;                                           \
            if (found != 0u) statement;                                                                    \
            found &= max(found, 1u) - 1u;                                                                  \
            if (found == 0u) break;                                                                        \
        }                                                                                                  \
        batch += 32 * stride;                                                                              \
        if (batch >= (count)) break;                                                                       \
    }
