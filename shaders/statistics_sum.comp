// This pass joins the records of each cloth, statistics_chunk of them into one: lane l takes every 64th from the l-th
// on, then a tree joins the lanes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/statistics.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(StatisticsSumPush)
layout(set = 0, binding = 0, std430) readonly buffer Partials { StatisticsRecord partials[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Result { StatisticsRecord result[]; };

#define RECORD StatisticsRecord
#include "include/workgroup_reduction.h"

void main() {
    StatisticsRecord record = empty_statistics();
    int chunk = int(gl_WorkGroupID.x) * statistics_chunk, end = min(chunk + statistics_chunk, push.partial_count);
    for (int i = chunk + int(gl_LocalInvocationIndex); i < end; i += workgroup_width)
        record = joined(record, partials[int(cloth_place()) * push.partial_count + i]);
    record = joined_over_workgroup(record);
    if (gl_LocalInvocationIndex == 0u) result[cloth_place() * gl_NumWorkGroups.x + gl_WorkGroupID.x] = record;
}
