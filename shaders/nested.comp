// Sweeps over boxes around lone pins: one workgroup per pin, an invocation per line of its box, a barrier after every
// direction. The pins of a dispatch have boxes that share no particle. A pin that has let go is left alone.
// MASKED: as in line.comp. SHEARED: there are diagonal springs.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED SHEARED
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "include/line.h"
#include "include/nested.h"
#include "include/verlet.h"

layout(local_size_x = nested_group_width) in;
layout(push_constant) uniform Push { NestedPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform coherent image2D displacement;
layout(set = 0, binding = 2, std430) readonly buffer Table { ivec4 table[]; };
// Of the spring of a direction that a particle owns: eliminated.
layout(set = 0, binding = 3, std430) buffer Rows { vec2 rows[]; };
layout(set = 0, binding = 4, r32f) uniform coherent image2D tension_row;
layout(set = 0, binding = 5, r32f) uniform coherent image2D tension_column;
#ifdef SHEARED
layout(set = 0, binding = 6, r32f) uniform coherent image2D tension_down_right;
layout(set = 0, binding = 7, r32f) uniform coherent image2D tension_down_left;
#endif
#ifdef MASKED
layout(set = 0, binding = 8, rgba32f) uniform readonly image2D spring_share_image;
#endif
layout(set = 0, binding = 9, r32ui) uniform readonly uimage2D control;

/// A direction within a box.
struct NestedLines {
    NestedBox box;
    ivec2 step;
    int direction, seam, particle_count;
    float rest_length, compliance, followed;
};

struct NestedParticle {
    ivec2 at;       // in the sheet
    vec4 position;  // w: as its springs feel it, with the wind's drag
    vec4 displacement;
};

float load_tension(int direction, ivec2 at) {
    if (direction == 0) return imageLoad(tension_row, at).x;
#ifdef SHEARED
    if (direction == 2) return imageLoad(tension_down_right, at).x;
    if (direction == 3) return imageLoad(tension_down_left, at).x;
#endif
    return imageLoad(tension_column, at).x;
}

void store_tension(int direction, ivec2 at, float tension) {
    vec4 texel = vec4(tension, 0.0f, 0.0f, 0.0f);
    if (direction == 0) imageStore(tension_row, at, texel);
    if (direction == 1) imageStore(tension_column, at, texel);
#ifdef SHEARED
    if (direction == 2) imageStore(tension_down_right, at, texel);
    if (direction == 3) imageStore(tension_down_left, at, texel);
#endif
}

float share_of(NestedLines lines, ivec2 at) {
    if (at.x - lines.box.first.x == lines.seam) return 0.0f;
#ifdef MASKED
    return imageLoad(spring_share_image, at)[lines.direction];
#else
    return border_share(at, lines.step, push.grid);
#endif
}

int place(ivec2 at) { return at.y * push.grid.x + at.x; }

NestedParticle load_particle(NestedLines lines, ivec2 in_box) {
    ivec2 at = lines.box.first + in_box;
    vec4 start = imageLoad(position, at), moved = imageLoad(displacement, at);
    return NestedParticle(at, vec4(start.xyz, dragged_weight(start.w, moved.w)), moved);
}

LineSpring spring_between(NestedLines lines, NestedParticle first, NestedParticle second) {
    return line_spring(spring_edge(first.position.xyz, second.position.xyz, first.displacement.xyz,
                                   second.displacement.xyz),
                       lines.rest_length);
}

void eliminate_line(NestedLines lines, int line) {
    vec3 normal_after = vec3(0.0f, 0.0f, 0.0f);
    vec2 eliminated = vec2(0.0f, 0.0f);
    ivec2 back = -lines.step;
    ivec2 in_box = line_end(line, lines.step, lines.particle_count, lines.box.size.x);
    NestedParticle second = load_particle(lines, in_box);
    in_box = next_on_line(in_box, back, lines.box.size.x);
    NestedParticle first = load_particle(lines, in_box);
    LineSpring spring = spring_between(lines, first, second);
    for (int e = lines.particle_count - 2; e >= 0; --e) {
        NestedParticle before = first;
        LineSpring spring_before = LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f, 0.0f);
        if (e > 0) {
            in_box = next_on_line(in_box, back, lines.box.size.x);
            before = load_particle(lines, in_box);
            spring_before = spring_between(lines, before, first);
        }
        float tension = tension_in_use(load_tension(lines.direction, first.at), lines.followed);
        eliminated =
            eliminate_spring(eliminated, spring_before.normal, spring, normal_after, first.position.w,
                             second.position.w, share_of(lines, first.at), lines.compliance, tension);
        rows[place(first.at)] = eliminated;
        normal_after = spring.normal;
        spring = spring_before;
        second = first;
        first = before;
    }
}

void store_particle(NestedParticle particle, vec3 correction) {
    imageStore(displacement, particle.at,
               vec4(moved_by(particle.displacement.xyz, correction, particle.position.w), particle.displacement.w));
}

void substitute_line(NestedLines lines, int line) {
    float change_before = 0.0f;
    vec3 normal_before = vec3(0.0f, 0.0f, 0.0f);
    ivec2 in_box = line_start(line, lines.step);
    NestedParticle first = load_particle(lines, in_box);
    for (int e = 0; e < lines.particle_count - 1; ++e) {
        in_box = next_on_line(in_box, lines.step, lines.box.size.x);
        NestedParticle second = load_particle(lines, in_box);
        vec3 normal = spring_between(lines, first, second).normal;
        float change = substitute_spring(rows[place(first.at)], change_before);
        store_particle(first, line_correction(normal_before, change_before, normal, change));
        float share = share_of(lines, first.at);
        float tension = tension_in_use(load_tension(lines.direction, first.at), lines.followed);
        // The spring across the box's seam is not the box's.
        if (share > 0.0f)
            store_tension(lines.direction, first.at,
                          stored_tension(changed_tension(tension, change, share, lines.compliance), lines.followed));
        change_before = change;
        normal_before = normal;
        first = second;
    }
    store_particle(first, line_correction(normal_before, change_before, vec3(0.0f, 0.0f, 0.0f), 0.0f));
}

void sweep_direction(NestedBox box, int direction, bool second_order) {
    if (!(push.rest_length[direction] > 0.0f)) return;
    ivec2 step = nested_step(direction);
    NestedLines lines = NestedLines(
        box, step, direction, nested_seam(step, box.size.x), step.y == 0 ? box.size.x : box.size.y,
        push.rest_length[direction],
        second_order ? push.compliance_bdf2[direction] : push.compliance[direction],
        second_order ? push.followed_bdf2[direction] : push.followed[direction]);
    int line_count = step.y == 0 ? box.size.y : box.size.x;
    for (int line = int(gl_LocalInvocationIndex); line < line_count; line += nested_group_width) {
        eliminate_line(lines, line);
        substitute_line(lines, line);
    }
}

void main() {
    ivec2 pin = table[push.first_pin + int(gl_WorkGroupID.x)].xy;
    if (imageLoad(position, pin).w != 0.0f) return;
    bool second_order = imageLoad(control, ivec2(control_order, 0)).x == 2u;
    for (int block = 0; block < push.block_count; ++block) {
        NestedBox box = nested_box(pin, table[block].x, push.grid);
        for (int sweep = 0; sweep < table[block].y; ++sweep)
            for (int order = 0; order < 4; ++order) {
                sweep_direction(box, nested_direction(order), second_order);
                memoryBarrierImage();
                barrier();
            }
    }
}
