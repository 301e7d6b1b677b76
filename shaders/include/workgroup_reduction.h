// The tree over a workgroup's records, in a fixed order: lane l joins lane l + 32, then l + 16, ... l + 1. The includer
// defines RECORD, the type, for which there is a function `joined`.
shared RECORD lane_records[workgroup_width];

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
