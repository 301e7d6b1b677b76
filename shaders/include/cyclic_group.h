// Cyclic reduction among the invocations of a workgroup, each with one row. Each group of `group_width` invocations
// solves one system, in which `group_place` is an invocation's index.
int group_width, group_place;
shared vec4 handed[gl_WorkGroupSize.x * gl_WorkGroupSize.y];
shared vec2 handed_too[gl_WorkGroupSize.x * gl_WorkGroupSize.y];

void hand_out(vec4 value) {
    barrier();  // all invocations have read what was passed before
    handed[gl_LocalInvocationIndex] = value;
    barrier();
}

void hand_out(vec4 value, vec2 more) {
    barrier();
    handed[gl_LocalInvocationIndex] = value;
    handed_too[gl_LocalInvocationIndex] = more;
    barrier();
}

bool has_neighbour(int by) {
    int place = group_place + by;
    return place >= 0 && place < group_width;
}

/// Rows beyond a system's ends are zero.
vec4 from_neighbour(int by) {
    return has_neighbour(by) ? handed[int(gl_LocalInvocationIndex) + by] : vec4(0.0f, 0.0f, 0.0f, 0.0f);
}

CyclicRow row_of_neighbour(int by) {
    if (!has_neighbour(by)) return no_cyclic_row();
    vec4 row = handed[int(gl_LocalInvocationIndex) + by];
    vec2 right = handed_too[int(gl_LocalInvocationIndex) + by];
    return CyclicRow(row.x, row.y, row.z, vec3(row.w, right));
}

/// Returns this invocation's row after all other rows of its system were eliminated from it. The first `count`
/// invocations of each system hold its rows. Every invocation of the workgroup must call this, with the same count.
CyclicRow uncoupled(CyclicRow row, int count) {
    for (int distance = 1; distance < count; distance *= 2) {
        hand_out(vec4(row.shift, row.before, row.after, row.right.x), row.right.yz);
        row = reduced_row(row, row_of_neighbour(-distance), row_of_neighbour(distance));
    }
    return row;
}
