// This kernel relaxes nested boxes around lone pins (include/nested_boxes.h) with an invocation per particle of a line
// of a box. It solves the lines by cyclic reduction, as many at a time as the workgroup holds.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED SHEARED
#include "shared/cyclic_types.h"
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "shared/simulation_types.h"
#include "include/cyclic.h"
#include "include/nested.h"
#include "include/verlet.h"

layout(local_size_x = cyclic_most_particles) in;
#include "include/nested_boxes.h"
#include "include/cyclic_group.h"

/// Solves the lines of a direction from `line.index` on, as many as the workgroup holds; each invocation belongs to
/// one.
void solve_lines(NestedLine line, int count) {
    int p = group_place;
    line.index += int(gl_LocalInvocationIndex) / group_width;
    bool is_line = line.index < count;
    if (!is_line) line.index = 0;
    bool exists = is_line && p <= line.last, has_spring = is_line && p < line.last;
    ivec2 in_box = line_end(line.index, line.step, (p < line.last ? p : line.last) + 1, line.columns);
    NestedParticle first = load_particle(line, in_box), second = next_particle(line, first, line.step);
    find_share(line);
    float share = has_spring ? share_of(line, first) : 0.0f;
    LineSpring spring = spring_between(line, first, second);
    if (!has_spring) spring = LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f, 0.0f);
    float tension = tension_in_use(load_tension(line.direction, first.at), line.per_followed);
    hand_out(vec4(spring.normal, 0.0f));
    vec3 normal_before = from_neighbour(-1).xyz, normal_after = from_neighbour(1).xyz;
    CyclicRow row = spring_row(normal_before, spring, normal_after, first.position.w, second.position.w, share,
                               line.compression, line.compliance, tension);
    float change = cyclic_solution(uncoupled(row, line.last)).x;
    hand_out(vec4(spring.normal, change));
    vec4 before = from_neighbour(-1);
    vec3 correction = line_correction(before.xyz, before.w, spring.normal, change);
    vec3 moved = moved_by(first.displacement.xyz, correction, first.position.w);
    if (exists) STORE_TRIPLE(displacement_out, first.at, moved, first.displacement.w);
    float changed = changed_tension(tension, change, share, SPRING_COMPLIANCE(line, share));
    // The spring across the box's seam is not the box's.
    if (has_spring && share > 0.0f) store_tension(line.direction, first.at, stored_tension(changed, line.followed));
}

void sweep_direction(NestedBox box, NestedLine line) {
    int count = line_count(box, line), lines = 1;
    group_width = cyclic_most_particles;
    while (group_width / 2 > line.last) {
        group_width /= 2;
        lines *= 2;
    }
    group_place = int(gl_LocalInvocationIndex) % group_width;
    for (int first = 0; first < count; first += lines) {
        line.index = first;
        solve_lines(line, count);
    }
}
