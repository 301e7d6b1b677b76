// This pass decides whether a substep gets another iteration: it joins the workgroups' residuals (lane l takes every
// 64th from the l-th on, then a tree joins the lanes) and writes the sizes of the iteration's dispatches, or zeros.
// Once they are zero, the later decisions of the substep are not dispatched either.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/residual.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(IterationPush)
layout(set = 0, binding = 0, std430) readonly buffer Residuals { ResidualRecord residuals[]; };
layout(set = 0, binding = 1, std430) readonly buffer IterationSizes { uvec4 iteration_sizes[]; };
layout(set = 0, binding = 2, std430) buffer Iterations { uvec4 iterations[]; };

#define RECORD ResidualRecord
#include "include/workgroup_reduction.h"

shared bool iterates;

void main() {
    ResidualRecord record = empty_residual();
    for (int i = int(gl_LocalInvocationIndex); i < push.partial_count; i += workgroup_width)
        record = joined(record, residuals[i]);
    record = joined_over_workgroup(record);
    if (gl_LocalInvocationIndex == 0u) {
        iterates = needs_iteration(record, push.squared_tolerance);
        uint used = push.first_check != 0 ? uint(push.substep_count) : iterations[iteration_size_count].x;
        iterations[iteration_size_count] = uvec4(iterates ? used + 1u : used, 0u, 0u, 0u);
    }
    barrier();
    if (gl_LocalInvocationIndex < uint(iteration_size_count))
        iterations[gl_LocalInvocationIndex] =
            iterates ? iteration_sizes[gl_LocalInvocationIndex] : uvec4(0u, 0u, 0u, 0u);
}
