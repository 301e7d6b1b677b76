// Joins the sums of torques that the workgroups of a pass before stored. The includer has `torques` and
// `push.sum_count`.
#define RECORD TorqueSum
#include "include/workgroup_reduction.h"

TorqueSum load_sum(int index) {
    int row = int(cloth_place()) * push.sum_count + index;
    return TorqueSum(imageLoad(torques, ivec2(0, row)), imageLoad(torques, ivec2(1, row)),
                     imageLoad(torques, ivec2(2, row)), imageLoad(torques, ivec2(3, row)));
}

/// Joins the sums of all workgroups in every workgroup alike. A tree over more lanes would join empty sums, which
/// change nothing.
TorqueSum joined_sums() {
    int lane = int(gl_LocalInvocationIndex);
    TorqueSum sum = empty_torque();
    for (int i = lane; i < push.sum_count; i += workgroup_width) sum = joined(sum, load_sum(i));
    lane_records[lane] = sum;
    int stride = workgroup_width / 2;
    while (stride >= push.sum_count) stride /= 2;
    for (; stride > 0; stride /= 2) {
        barrier();
        if (lane < stride) lane_records[lane] = joined(lane_records[lane], lane_records[lane + stride]);
    }
    barrier();
    return lane_records[0];
}
