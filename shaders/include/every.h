// A loop over `count` entries, of which an invocation takes every gl_NumWorkGroups.x * workgroup_width-th. On the
// default device a loop that ends at its top runs its body once more with no invocation in it, which costs as much as a
// round; so this one ends at its bottom. `statement`: a call, for entry `entry`.
#define FOR_EVERY(entry, count, statement)                  \
    for (int entry = int(gl_GlobalInvocationID.x);;) {      \
        if (entry < (count)) statement;                     \
        entry += int(gl_NumWorkGroups.x) * workgroup_width; \
        if (entry >= (count)) break;                        \
    }
