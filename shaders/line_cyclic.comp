// This kernel solves the springs of one direction line by line, as line.comp does, on devices that run many invocations
// at once. It has an invocation per particle and a workgroup per line, or for several short ones, and solves both
// systems by parallel cyclic reduction. A workgroup reads all of its lines before it writes any of them, so the
// displacement is updated in place. `masked` and `bends` are as in line.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/cyclic_types.h"
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/cyclic.h"
#include "include/cyclic_bent.h"
#include "include/push.h"
#include "include/verlet.h"

layout(local_size_x = cyclic_least_width, local_size_y = 1, local_size_x_id = 0, local_size_y_id = 1) in;
CLOTH_CONSTANTS(LinePush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(2, displacement_out);
layout(set = 0, binding = 3, r32f) uniform readonly image2D tension_in;
SCALAR_OUT(4, tension_out);
layout(constant_id = 21) const bool masked = false;
layout(constant_id = 24) const bool bends = false;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 6, r32ui) uniform uimage2D line_control;
layout(constant_id = 2) const bool first_iteration = true;

#include "include/line_particles.h"
#include "include/cyclic_group.h"
#include "include/cyclic_bent_group.h"
shared uint wrong[gl_WorkGroupSize.y];  // by line: whether one of its springs is wrong

/// One invocation's part of its line: a particle, the one after it and the spring between them.
struct Part {
    bool exists, has_spring;
    LineParticle first, second;
    float share;
};

Part read_part(Line line, bool is_line) {
    int p = group_place, last = line.last;
    LineParticle first =
        load_particle(line_end(line.index, line.step, (p < last ? p : last) + 1, line.columns));
    bool has_spring = is_line && p < last;
    // The last particle's neighbour may lie outside the sheet, where loads return zeros.
    return Part(is_line && p <= last, has_spring, first, particle_after(line, first),
                has_spring ? share_of(line, first.at) : 0.0f);
}

/// Returns the target at a place of the line; beyond its ends, where nothing bends, that at the end.
vec3 target_at(Line line, int p) {
    int near = p < 0 ? 0 : p > line.last ? line.last : p;
    return bend_target(line_end(line.index, line.step, near + 1, line.columns), line.channel);
}

BentTargets targets_around(Line line) {
    return BentTargets(target_at(line, group_place - 1), target_at(line, group_place), target_at(line, group_place + 1));
}

/// Solves the first system. Returns the change of this particle's displacement, m.
vec3 delta_of(Line line, Part part) {
    vec3 edge = part.has_spring ? start_edge_of(part.first, part.second) : vec3(0.0f, 0.0f, 0.0f);
    float stiffness = part.has_spring ? stiffness_of(line, part.first, part.second, part.share) : 0.0f;
    if (bends) {
        hand_out(vec4(edge, stiffness), vec2(part.share, 0.0f));
        BentRow row =
            bent_row(spring_of_neighbour(-2), spring_of_neighbour(-1), spring_of_neighbour(0), spring_of_neighbour(1),
                     targets_around(line), line.bend, part.first.position.w, is_second());
        if (!part.exists) row = no_bent_row(is_second());
        return bent_solution_of(row, line.last + 1);
    }
    hand_out(vec4(edge, stiffness));
    vec4 before = from_neighbour(-1);
    CyclicRow row = particle_row(before.xyz, before.w, edge, stiffness, part.first.position.w);
    if (!part.exists) row = no_cyclic_row();
    return cyclic_solution(uncoupled(row, line.last + 1));
}

/// Solves the second system. Returns the change of the spring's multiplier.
float change_of(Line line, Part part, LineSpring spring, float tension) {
    hand_out(vec4(spring.normal, 0.0f));
    vec3 normal_before = from_neighbour(-1).xyz, normal_after = from_neighbour(1).xyz;
    CyclicRow row = spring_row(normal_before, spring, normal_after, part.first.position.w, part.second.position.w,
                               part.share, line.compression, line.compliance, tension);
    return cyclic_solution(uncoupled(row, line.last)).x;
}

/// Reports to the control if a spring of the line is wrong.
void report(bool is_wrong) {
    if (is_wrong) atomicOr(wrong[gl_LocalInvocationID.y], 1u);
    barrier();
    if (group_place == 0 && wrong[gl_LocalInvocationID.y] != 0u)
        imageAtomicAdd(line_control, ivec2(control_wrong_lines, cloth_place()), 1u);
}

void main() {
    group_width = int(gl_WorkGroupSize.x);
    group_place = int(gl_LocalInvocationID.x);
    int index = int(gl_GlobalInvocationID.y);
    bool is_line = index < push.line_count;
    Line line = read_line(is_line ? index : push.line_count - 1);
    if (group_place == 0) wrong[gl_LocalInvocationID.y] = 0u;  // seen by all after the first barrier
    Part part = read_part(line, is_line);
    vec3 delta = first_iteration ? delta_of(line, part) : vec3(0.0f, 0.0f, 0.0f);
    hand_out(vec4(delta, 0.0f));
    vec3 delta_after = from_neighbour(1).xyz;
    LineSpring spring = spring_between(line, part.first, filtered(part.first, delta), part.second,
                                       filtered(part.second, delta_after));
    if (!part.has_spring) spring = LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f, 0.0f);
    float tension = part.has_spring ? filtered_tension_of(line, part.first, part.second, spring) : 0.0f;
    float change = change_of(line, part, spring, tension);
    hand_out(vec4(spring.normal, change));
    vec4 before = from_neighbour(-1);
    vec3 correction = line_correction(before.xyz, before.w, spring.normal, change);
    vec3 moved = moved_by_both(part.first.moved.xyz, delta, correction, part.first.position.w);
    if (part.exists) STORE_TRIPLE(displacement_out, part.first.at, moved, part.first.moved.w);
    float changed = changed_tension(tension, change, part.share, SPRING_COMPLIANCE(line, part.share));
    if (part.has_spring) STORE_SCALAR(tension_out, part.first.at, stored_tension(changed, line.followed));
    report(line_is_wrong(larger_violation(0.0f, spring, part.share, line.compression, tension), line.rest_length));
}
