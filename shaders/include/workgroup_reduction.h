// A tree joins a workgroup's records in a fixed order: lane l joins lane l + 32, then l + 16, ... l + 1. The includer
// defines RECORD, a type for which there is a function `joined`.
shared RECORD lane_records[workgroup_width];

/// Returns the number of rows that an invocation joins, at most `most`, from a particle of its column on. All
/// invocations meet a barrier afterwards, so even one past the last column takes part. On the default device a loop
/// over all `most` rows would also pay for the missing ones.
int rows_of(ivec2 first, int most, ivec2 grid) { return first.x < grid.x ? min(most, grid.y - first.y) : 0; }

/// Joins the records of all lanes; every lane must call it. The result is lane 0's.
RECORD joined_over_workgroup(RECORD record) {
    uint lane = gl_LocalInvocationIndex;
    lane_records[lane] = record;
    for (uint stride = uint(workgroup_width) / 2u; stride > 0u; stride /= 2u) {
        barrier();
        if (lane < stride) lane_records[lane] = joined(lane_records[lane], lane_records[lane + stride]);
    }
    return lane_records[0];
}
