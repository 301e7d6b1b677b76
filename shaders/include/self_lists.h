// The passes of contact fill lists, and set how many workgroups the passes over these lists have. The includer has
// `sizes`, the sizes of indirect dispatches.
layout(constant_id = 1) const uint entries_each = 1u;  // entries that an invocation of those passes processes in turn
const uint self_most_groups = 65535u;                  // Vulkan's limit; beyond it invocations process more

uint groups_of(uint count) {
    uint entries = uint(workgroup_width) * entries_each;
    return min((count + entries - 1u) / entries, self_most_groups);
}

/// The number of entries up to the last one that this invocation added to a list.
uint reached = 0u;

/// Returns the index of the first of `count` new entries in a list that had `before`.
uint place_after(uint before, uint count) {
    reached = max(reached, before + count);
    return before;
}

/// Sets a pass to run over `count` entries, the largest number in any of its lists; a pass that nobody sets does not
/// run. An invocation calls this once, and reads the size first, since most invocations find it set: an atomic costs
/// the default device as much as some dozen operations.
void dispatch(int which, uint count) {
    uint groups = groups_of(count);
    if (sizes[which].x < groups) atomicMax(sizes[which].x, groups);
}
