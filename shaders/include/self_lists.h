// How the passes of contact fill lists, and say how many workgroups the passes that go through them take. The includer
// has `sizes`, the sizes of indirect dispatches.
layout(constant_id = 1) const uint entries_each = 1u;  // that an invocation of those passes takes in turn
const uint self_most_groups = 65535u;                  // Vulkan's: beyond it invocations take more

uint groups_of(uint count) {
    uint entries = uint(workgroup_width) * entries_each;
    return min((count + entries - 1u) / entries, self_most_groups);
}

/// Entries that a list had after the last one that this invocation put in.
uint reached = 0u;

/// Where `count` entries go, of which a list had `before`.
uint place_after(uint before, uint count) {
    reached = max(reached, before + count);
    return before;
}

/// The pass that goes through `count` entries, of several lists those of the longest, runs: no pass does unless
/// somebody has work for it. Most that come here find it told. Once per invocation: an atomic costs as much as some
/// dozen operations on the default device, and that for nobody, too.
void dispatch(int which, uint count) {
    uint groups = groups_of(count);
    if (sizes[which].x < groups) atomicMax(sizes[which].x, groups);
}
