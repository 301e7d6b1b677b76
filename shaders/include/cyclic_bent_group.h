// Cyclic reduction of lines that bend, in the way of cyclic_group.h: each invocation has a row, and each two have a
// block.
shared float handed_right[3 * gl_WorkGroupSize.x * gl_WorkGroupSize.y];

bool is_second() { return (group_place & 1) != 0; }

/// Returns the spring after a neighbour's particle, which the neighbour passed as its edge and stiffness, and its
/// share.
BentSpring spring_of_neighbour(int by) {
    vec4 spring = from_neighbour(by);
    float share = has_neighbour(by) ? handed_too[int(gl_LocalInvocationIndex) + by].x : 0.0f;
    return BentSpring(spring.xyz, spring.w, share);
}

void hand_out(BentRow row) {
    int place = int(gl_LocalInvocationIndex);
    barrier();  // all invocations have read what was passed before
    handed[place] = vec4(row.before, row.after);
    handed_too[place] = row.rigid;
    for (int i = 0; i < 3; ++i) handed_right[3 * place + i] = row.right[i];
    barrier();
}

BentRow handed_row(int place) {
    vec4 row = handed[place];
    return BentRow(row.xy, handed_too[place], row.zw,
                   vec3(handed_right[3 * place], handed_right[3 * place + 1], handed_right[3 * place + 2]));
}

BentBlock block_of_neighbour(int by) {
    if (!has_neighbour(2 * by)) return BentBlock(no_bent_row(false), no_bent_row(true));
    int place = (int(gl_LocalInvocationIndex) & ~1) + 2 * by;
    return BentBlock(handed_row(place), handed_row(place + 1));
}

/// Solves the system whose first `count` rows the invocations of a group hold. Returns this invocation's y. Every
/// invocation of the workgroup must call this, with the same count.
vec3 bent_solution_of(BentRow row, int count) {
    for (int distance = 1; 2 * distance < count; distance *= 2) {
        hand_out(row);
        row = reduced_bent_row(row, block_of_neighbour(-distance), block_of_neighbour(distance), distance);
    }
    hand_out(row);
    return bent_solution(block_of_neighbour(0), is_second());
}
