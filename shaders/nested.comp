// Sweeps over boxes around lone pins: one workgroup per pin, an invocation per line of its box, a barrier after every
// direction. The pins of a dispatch have boxes that share no particle. A pin that has let go is left alone.
// MASKED: as in line.comp. SHEARED: there are diagonal springs.
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
layout(push_constant) uniform Push { NestedPush push; };
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform coherent readonly image2D displacement_in;
coherent TRIPLE_OUT(2, DisplacementOut, displacement_out);
layout(set = 0, binding = 3, std430) readonly buffer Table { ivec4 table[]; };
// Of the spring of a direction that a particle owns: xy eliminated, z its tension before the sweep, m.
layout(set = 0, binding = 4, rgba32f) uniform coherent readonly image2D rows_in;
coherent TRIPLE_OUT(5, RowsOut, rows_out);
layout(set = 0, binding = 6, r32f) uniform coherent readonly image2D tension_row_in;
coherent SCALAR_OUT(7, TensionRowOut, tension_row_out);
layout(set = 0, binding = 8, r32f) uniform coherent readonly image2D tension_column_in;
coherent SCALAR_OUT(9, TensionColumnOut, tension_column_out);
#ifdef SHEARED
layout(set = 0, binding = 10, r32f) uniform coherent readonly image2D tension_down_right_in;
coherent SCALAR_OUT(11, TensionDownRightOut, tension_down_right_out);
layout(set = 0, binding = 12, r32f) uniform coherent readonly image2D tension_down_left_in;
coherent SCALAR_OUT(13, TensionDownLeftOut, tension_down_left_out);
#endif
#ifdef MASKED
layout(set = 0, binding = 14, rgba32f) uniform readonly image2D spring_share_image;
#endif
layout(set = 0, binding = 15, r32ui) uniform readonly uimage2D control;

/// A line of a direction within a box.
struct NestedLine {
    ivec2 box_first, step;
    int columns;  // of the box
    int index, direction, seam, last;  // last: of its particles
    float share;  // of all its springs, where no image has them
    float rest_length, compliance, followed, compression;
};

struct NestedParticle {
    ivec2 in_box, at;  // at: in the sheet
    vec4 position;     // w: as its springs feel it, with the wind's drag
    vec4 displacement;
};

float load_tension(int direction, ivec2 at) {
    float tension = 0.0f;
    if (direction == 0) tension = imageLoad(tension_row_in, at).x;
    if (direction == 1) tension = imageLoad(tension_column_in, at).x;
#ifdef SHEARED
    if (direction == 2) tension = imageLoad(tension_down_right_in, at).x;
    if (direction == 3) tension = imageLoad(tension_down_left_in, at).x;
#endif
    return tension;
}

void store_tension(int direction, ivec2 at, float tension) {
    if (direction == 0) STORE_SCALAR(tension_row_out, at, tension);
    if (direction == 1) STORE_SCALAR(tension_column_out, at, tension);
#ifdef SHEARED
    if (direction == 2) STORE_SCALAR(tension_down_right_out, at, tension);
    if (direction == 3) STORE_SCALAR(tension_down_left_out, at, tension);
#endif
}

float share_of(NestedLine line, NestedParticle first) {
#ifdef MASKED
    float share = imageLoad(spring_share_image, first.at)[line.direction];
#else
    float share = line.share;
#endif
    return first.in_box.x == line.seam ? 0.0f : share;
}

NestedParticle load_particle(NestedLine line, ivec2 in_box) {
    ivec2 at = line.box_first + in_box;
    vec4 start = imageLoad(position, at), moved = imageLoad(displacement_in, at);
    return NestedParticle(in_box, at, vec4(start.xyz, dragged_weight(start.w, moved.w)), moved);
}

/// The particle `step` further.
NestedParticle next_particle(NestedLine line, NestedParticle particle, ivec2 step) {
    return load_particle(line, next_on_line(particle.in_box, step, line.columns));
}

LineSpring spring_between(NestedLine line, NestedParticle first, NestedParticle second) {
    return line_spring(spring_edge(first.position.xyz, second.position.xyz, first.displacement.xyz,
                                   second.displacement.xyz),
                       line.rest_length);
}

void eliminate_line(NestedLine line) {
    vec3 normal_after = vec3(0.0f, 0.0f, 0.0f);
    vec2 eliminated = vec2(0.0f, 0.0f);
    ivec2 back = -line.step;
    NestedParticle second = load_particle(line, line_end(line.index, line.step, line.last + 1, line.columns));
    NestedParticle first = next_particle(line, second, back);
    LineSpring spring = spring_between(line, first, second);
    for (int e = line.last - 1; e >= 0; --e) {
        NestedParticle before = next_particle(line, first, back);
        LineSpring spring_before = spring_between(line, before, first);
        vec3 normal_before = e > 0 ? spring_before.normal : vec3(0.0f, 0.0f, 0.0f);
        float tension = tension_in_use(load_tension(line.direction, first.at), line.followed);
        eliminated = eliminate_spring(eliminated, normal_before, spring, normal_after, first.position.w,
                                      second.position.w, share_of(line, first), line.compression, line.compliance,
                                      tension);
        STORE_TRIPLE(rows_out, first.at, vec3(eliminated, tension), 0.0f);
        normal_after = spring.normal;
        spring = spring_before;
        second = first;
        first = before;
    }
}

void substitute_line(NestedLine line) {
    float change_before = 0.0f;
    vec3 normal_before = vec3(0.0f, 0.0f, 0.0f);
    NestedParticle first = load_particle(line, line_start(line.index, line.step));
    for (int p = 0; p <= line.last; ++p) {
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
        float tension = changed_tension(row.z, change, share, line.compliance);
        // The spring across the box's seam is not the box's.
        if (has_spring && share > 0.0f) store_tension(line.direction, first.at, stored_tension(tension, line.followed));
        change_before = change;
        normal_before = normal;
        first = second;
    }
}

void sweep_direction(NestedBox box, int direction, bool second_order) {
    float rest_length = push.rest_length[direction];
    if (!(rest_length > 0.0f)) return;
    ivec2 step = nested_step(direction);
    int particle_count = step.y == 0 ? box.size.x : box.size.y, line_count = step.y == 0 ? box.size.y : box.size.x;
    NestedLine line = NestedLine(
        box.first, step, box.size.x, 0, direction, nested_seam(step, box.size.x), particle_count - 1, 0.0f, rest_length,
        second_order ? push.compliance_bdf2[direction] : push.compliance[direction],
        second_order ? push.followed_bdf2[direction] : push.followed[direction], push.compression);
    for (line.index = int(gl_LocalInvocationIndex); line.index < line_count; line.index += int(gl_WorkGroupSize.x)) {
        line.share = border_share(box.first + line_start(line.index, step), step, push.grid);
        eliminate_line(line);
        substitute_line(line);
    }
}

void sweep_order(NestedBox box, int order, bool second_order) {
    sweep_direction(box, nested_direction(order), second_order);
    memoryBarrier();
    barrier();
}

void main() {
    ivec2 pin = table[push.first_pin + int(gl_WorkGroupID.x)].xy;
    if (imageLoad(position, pin).w != 0.0f) return;
    bool second_order = imageLoad(control, ivec2(control_order, 0)).x == 2u;
    for (int block = 0; block < push.block_count; ++block) {
        NestedBox box = nested_box(pin, table[block].xy, push.grid);
        for (int sweep = 0; sweep < table[block].z; ++sweep) {
            // Not a loop: compiled for one direction at a time, a sweep looks at its own tension alone.
            sweep_order(box, 0, second_order);
            sweep_order(box, 1, second_order);
            sweep_order(box, 2, second_order);
            sweep_order(box, 3, second_order);
        }
    }
}
