// The passes of contact fill lists, and say how many workgroups the passes that go through them take. The includer has
// `sizes`, the sizes of indirect dispatches.
layout(constant_id = 1) const uint entries_each = 1u;  // entries that an invocation of those passes takes in turn
const uint self_most_groups = 65535u;                  // Vulkan's limit; beyond it invocations take more

uint groups_of(uint count) {
    uint entries = uint(workgroup_width) * entries_each;
    return min((count + entries - 1u) / entries, self_most_groups);
}

/// Entries that a list has up to the last one that this invocation put in.
uint reached = 0u;

/// Returns the place of the first of `count` entries in a list that held `before`.
uint place_after(uint before, uint count) {
    reached = max(reached, before + count);
    return before;
}

/// Has a pass run over `count` entries, the most in any of its lists; no pass runs without. An invocation calls it
/// once, and reads first, since most find it done: an atomic costs the default device as much as some dozen operations.
void dispatch(int which, uint count) {
    uint groups = groups_of(count);
    if (sizes[which].x < groups) atomicMax(sizes[which].x, groups);
}
