// This pass relaxes nested boxes around lone pins (include/nested_boxes.h) with an invocation per line of a box and a
// barrier after every direction. Its loops end at their bottom (include/every.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "shared/simulation_types.h"
#include "include/in_pairs.h"
#include "include/line.h"
#include "include/nested.h"
#include "include/verlet.h"

layout(local_size_x = nested_group_width, local_size_x_id = 0) in;
#include "include/nested_boxes.h"
// Each texel belongs to the spring that a particle owns in the current direction. xy: the spring, eliminated; z: its
// stored tension before this direction is solved.
layout(set = 0, binding = 4, rgba32f) uniform coherent readonly image2D nested_rows_in;
COHERENT_TRIPLE_OUT(5, nested_rows_out);

const vec3 none = vec3(0.0f, 0.0f, 0.0f);  // normal of the spring that a line's end lacks

/// The values that a walk back from the line's end has before it eliminates a spring.
struct SpringWalk {
    NestedParticle first, second;  // particles of the spring
    LineSpring spring;
    vec3 normal_after;
    vec2 eliminated;  // the spring after it
};

void eliminate_between(NestedLine line, inout SpringWalk walk, vec3 normal_before) {
    float stored = load_tension(line.direction, walk.first.at);
    walk.eliminated = eliminate_spring(walk.eliminated, normal_before, walk.spring, walk.normal_after,
                                       walk.first.position.w, walk.second.position.w, share_of(line, walk.first),
                                       line.compression, line.compliance, tension_in_use(stored, line.per_followed));
    STORE_TRIPLE(nested_rows_out, walk.first.at, vec3(walk.eliminated, stored), 0.0f);
}

/// Eliminates a spring with one before it.
void eliminate_next(NestedLine line, inout SpringWalk walk) {
    NestedParticle before = next_particle(line, walk.first, -line.step);
    LineSpring spring_before = spring_between(line, before, walk.first);
    eliminate_between(line, walk, spring_before.normal);
    walk.normal_after = walk.spring.normal;
    walk.spring = spring_before;
    walk.second = walk.first;
    walk.first = before;
}

void eliminate_line(NestedLine line) {
    NestedParticle second = load_particle(line, line_end(line.index, line.step, line.last + 1, line.columns));
    NestedParticle first = next_particle(line, second, -line.step);
    SpringWalk walk = SpringWalk(first, second, spring_between(line, first, second), none, vec2(0.0f, 0.0f));
    IN_PAIRS(line.last - 1, eliminate_next(line, walk))  // a box has two columns and rows at least
    eliminate_between(line, walk, none);
}

/// The values that a walk from the line's start has before it writes a particle.
struct MoveWalk {
    NestedParticle first;
    vec3 normal_before;
    float change_before;
};

void move(MoveWalk walk, vec3 normal, float change) {
    vec3 correction = line_correction(walk.normal_before, walk.change_before, normal, change);
    vec3 moved = moved_by(walk.first.displacement.xyz, correction, walk.first.position.w);
    STORE_TRIPLE(displacement_out, walk.first.at, moved, walk.first.displacement.w);
}

/// Writes a particle with a spring after it, and that spring's tension.
void move_next(NestedLine line, inout MoveWalk walk) {
    NestedParticle second = next_particle(line, walk.first, line.step);
    LineSpring spring = spring_between(line, walk.first, second);
    vec4 row = LOAD(nested_rows_in, walk.first.at);
    float change = substitute_spring(row.xy, walk.change_before);
    move(walk, spring.normal, change);
    float share = share_of(line, walk.first);
    float tension = changed_tension(tension_in_use(row.z, line.per_followed), change, share,
                                    SPRING_COMPLIANCE(line, share));
    // The spring across the box's seam does not belong to the box, so its tension stays.
    store_tension(line.direction, walk.first.at, share > 0.0f ? stored_tension(tension, line.followed) : row.z);
    walk.first = second;
    walk.normal_before = spring.normal;
    walk.change_before = change;
}

void substitute_line(NestedLine line) {
    MoveWalk walk = MoveWalk(load_particle(line, line_start(line.index, line.step)), none, 0.0f);
    IN_PAIRS(line.last, move_next(line, walk))
    move(walk, none, 0.0f);
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
