// Sweeps over boxes around lone pins (include/nested_sweeps.h), an invocation per line of a box, a barrier after every
// direction. Loops end at their bottom (include/every.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED SHEARED BUFFERED
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "shared/simulation_types.h"
#include "include/line.h"
#include "include/nested.h"
#include "include/verlet.h"

layout(local_size_x = nested_group_width, local_size_x_id = 0) in;
#include "include/nested_sweeps.h"
// Of the spring of a direction that a particle owns: xy eliminated, z its tension before the sweep, m.
layout(set = 0, binding = 4, rgba32f) uniform coherent readonly image2D rows_in;
coherent TRIPLE_OUT(5, RowsOut, rows_out);

void eliminate_line(NestedLine line) {
    vec3 normal_after = vec3(0.0f, 0.0f, 0.0f);
    vec2 eliminated = vec2(0.0f, 0.0f);
    ivec2 back = -line.step;
    NestedParticle second = load_particle(line, line_end(line.index, line.step, line.last + 1, line.columns));
    NestedParticle first = next_particle(line, second, back);
    LineSpring spring = spring_between(line, first, second);
    int e = line.last - 1;  // a box has two columns and rows at least
    do {
        NestedParticle before = next_particle(line, first, back);
        LineSpring spring_before = spring_between(line, before, first);
        vec3 normal_before = e > 0 ? spring_before.normal : vec3(0.0f, 0.0f, 0.0f);
        float tension = tension_in_use(load_tension(line.direction, first.at), line.per_followed);
        eliminated = eliminate_spring(eliminated, normal_before, spring, normal_after, first.position.w,
                                      second.position.w, share_of(line, first), line.compression, line.compliance,
                                      tension);
        STORE_TRIPLE(rows_out, first.at, vec3(eliminated, tension), 0.0f);
        normal_after = spring.normal;
        spring = spring_before;
        second = first;
        first = before;
        --e;
    } while (e >= 0);
}

void substitute_line(NestedLine line) {
    float change_before = 0.0f;
    vec3 normal_before = vec3(0.0f, 0.0f, 0.0f);
    NestedParticle first = load_particle(line, line_start(line.index, line.step));
    int p = 0;
    do {
        bool has_spring = p < line.last;
        NestedParticle second = next_particle(line, first, line.step);
        LineSpring spring = spring_between(line, first, second);
        vec3 normal = has_spring ? spring.normal : vec3(0.0f, 0.0f, 0.0f);
        vec4 row = imageLoad(rows_in, first.at);
        float change = substitute_spring(row.xy, change_before);
        change = has_spring ? change : 0.0f;
        vec3 correction = line_correction(normal_before, change_before, normal, change);
        vec3 moved = moved_by(first.displacement.xyz, correction, first.position.w);
        STORE_TRIPLE(displacement_out, first.at, moved, first.displacement.w);
        float share = share_of(line, first);
        float tension = changed_tension(row.z, change, share, SPRING_COMPLIANCE(line, share));
        // The spring across the box's seam is not the box's.
        if (has_spring && share > 0.0f) store_tension(line.direction, first.at, stored_tension(tension, line.followed));
        change_before = change;
        normal_before = normal;
        first = second;
        ++p;
    } while (p <= line.last);
}

void sweep_direction(NestedBox box, NestedLine line) {
    int count = line_count(box, line);
    line.index = int(gl_LocalInvocationIndex);
    do {
        find_share(line);
        if (line.index < count) eliminate_line(line);
        if (line.index < count) substitute_line(line);
        line.index += int(gl_WorkGroupSize.x);
    } while (line.index < count);
}
