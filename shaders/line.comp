// Solves the springs of one direction line by line: one invocation per line, Thomas algorithm, in three walks along it.
// The lines of a direction share no particle, so the displacement is updated in place. The control says
// whether this substep is BDF2, and hears of the worst spring. MASKED: the spring shares come from an image (holes, cuts).
// BENT: the line bends.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED BENT BUFFERED
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/line.h"
#ifdef BENT
#include "include/bent_line.h"
#endif
#include "include/verlet.h"

layout(local_size_x = line_group_width) in;
layout(push_constant) uniform Push { LinePush push; };
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, DisplacementOut, displacement_out);
// Of particle p of a line: eliminated, then xyz what the first system changes of its displacement and w the tension that it
// leaves the spring after it.
layout(set = 0, binding = 3, std430) buffer Scratch { vec4 scratch[]; };
// Of spring e of a line: eliminated; before, of particle e of a line that bends.
layout(set = 0, binding = 4, std430) buffer Rows { vec2 rows[]; };
layout(set = 0, binding = 5, r32f) uniform readonly image2D tension_in;
SCALAR_OUT(6, TensionOut, tension_out);
#ifdef MASKED
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D spring_share_image;
#endif
layout(set = 0, binding = 8, r32ui) uniform uimage2D control;

struct LineParticle {
    ivec2 at;
    vec4 position;  // w: as its springs feel it, with the wind's drag
    vec3 displacement;
};

float share_of(ivec2 first) {
    if (first.x == push.seam) return 0.0f;
#ifdef MASKED
    return imageLoad(spring_share_image, first)[push.channel];
#else
    return border_share(first, push.step, push.grid);
#endif
}

int place(int line, int index) { return index * push.line_count + line; }

LineParticle load_particle(ivec2 at) {
    vec4 start = imageLoad(position, at), moved = imageLoad(displacement_in, at);
    return LineParticle(at, vec4(start.xyz, dragged_weight(start.w, moved.w)), moved.xyz);
}

/// Where the first system puts a particle.
LineParticle moved_particle(ivec2 at, vec3 delta) {
    LineParticle particle = load_particle(at);
    return LineParticle(at, particle.position, moved_by(particle.displacement, delta, 1.0f));
}

vec3 edge_between(LineParticle first, LineParticle second) {
    return spring_edge(first.position.xyz, second.position.xyz, first.displacement, second.displacement);
}

LineSpring spring_between(LineParticle first, LineParticle second) {
    return line_spring(edge_between(first, second), push.rest_length);
}

float tension_of(ivec2 first, float followed) {
    return tension_in_use(imageLoad(tension_in, first).x, followed);
}

float tension_per_length_of(LineParticle first, LineParticle second, float followed) {
    precise vec3 start_edge = second.position.xyz - first.position.xyz;
    return tension_per_length(tension_of(first.at, followed), start_edge, push.rest_length);
}

#ifdef BENT
void store_bent(int line, int p, BentParticle particle) {
    scratch[place(line, p)] = vec4(particle.turn, particle.by_turn);
    rows[place(line, p)] = vec2(particle.by_shift, 0.0f);
}

/// The first system, from the line's start on.
void eliminate_particles(int line, float compliance, float followed, float bend) {
    LineParticle particle = load_particle(line_start(line, push.step));
    LineParticle next = load_particle(next_on_line(particle.at, push.step, push.grid.x));
    vec3 edge = edge_between(particle, next);
    float share = share_of(particle.at);
    BentLine bent = unbent_line();
    int last = push.particle_count - 1;
    for (int p = 0; p < last; ++p) {
        float stiffness =
            geometric_stiffness(tension_per_length_of(particle, next, followed), share, compliance);
        LineParticle after = next;
        vec3 edge_after = vec3(0.0f, 0.0f, 0.0f);
        float share_after = 0.0f;
        if (p + 1 < last) {
            after = load_particle(next_on_line(next.at, push.step, push.grid.x));
            edge_after = edge_between(next, after);
            share_after = share_of(next.at);
        }
        BentParticle eliminated = eliminate_bent(bent, edge, stiffness, edge_after,
                                                 element_bend(bend, share, share_after), particle.position.w);
        store_bent(line, p, eliminated);
        bent = eliminated.line;
        edge = edge_after;
        share = share_after;
        particle = next;
        next = after;
    }
    store_bent(line, last, eliminate_last_bent(bent, particle.position.w));
}
#else
/// The first system, from the line's start on.
void eliminate_particles(int line, float compliance, float followed, float bend) {
    LineParticle particle = load_particle(line_start(line, push.step));
    vec4 eliminated = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    vec3 edge_before = vec3(0.0f, 0.0f, 0.0f);
    float stiffness_before = 0.0f;
    int last = push.particle_count - 1;
    for (int p = 0; p <= last; ++p) {
        LineParticle next = particle;
        vec3 edge = vec3(0.0f, 0.0f, 0.0f);
        float stiffness = 0.0f;
        if (p < last) {
            next = load_particle(next_on_line(particle.at, push.step, push.grid.x));
            edge = edge_between(particle, next);
            stiffness = geometric_stiffness(tension_per_length_of(particle, next, followed), share_of(particle.at),
                                            compliance);
        }
        eliminated =
            eliminate_particle(eliminated, edge_before, stiffness_before, edge, stiffness, particle.position.w);
        scratch[place(line, p)] = eliminated;
        particle = next;
        edge_before = edge;
        stiffness_before = stiffness;
    }
}

#endif

/// What the first system changes of particle p, from what it changes of the particle after it; `turn`: how the edge after
/// that one turns, then its own.
vec3 delta_of(int line, int p, vec3 delta_after, inout vec3 turn) {
    if (push.first_iteration == 0) return vec3(0.0f, 0.0f, 0.0f);
#ifdef BENT
    turn = substitute_turn(scratch[place(line, p)], rows[place(line, p)].x, turn, delta_after);
    return bent_delta(delta_after, turn);
#else
    return substitute_particle(scratch[place(line, p)], delta_after);
#endif
}

float tension_between(LineParticle first, LineParticle second, LineSpring spring, float followed) {
    if (push.first_iteration == 0) return tension_of(first.at, followed);
    return filtered_tension(tension_per_length_of(first, second, followed), spring);
}

/// From the line's end back: substitutes in the first system and eliminates in the second. The largest |C| that it meets.
float eliminate_springs(int line, float compliance, float followed) {
    float largest_excess = 0.0f;
    vec3 normal_after = vec3(0.0f, 0.0f, 0.0f);
    vec2 eliminated = vec2(0.0f, 0.0f);
    int last = push.particle_count - 2;
    ivec2 back = -push.step;
    vec3 turn = vec3(0.0f, 0.0f, 0.0f);
    vec3 delta = delta_of(line, last + 1, vec3(0.0f, 0.0f, 0.0f), turn);
    LineParticle second = moved_particle(line_end(line, push.step, push.particle_count, push.grid.x), delta);
    scratch[place(line, last + 1)] = vec4(delta, 0.0f);
    delta = delta_of(line, last, delta, turn);
    LineParticle first = moved_particle(next_on_line(second.at, back, push.grid.x), delta);
    LineSpring spring = spring_between(first, second);
    for (int e = last; e >= 0; --e) {
        LineParticle before = first;
        LineSpring spring_before = LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f, 0.0f);
        vec3 delta_before = delta;
        if (e > 0) {
            delta_before = delta_of(line, e - 1, delta, turn);
            before = moved_particle(next_on_line(first.at, back, push.grid.x), delta_before);
            spring_before = spring_between(before, first);
        }
        float share = share_of(first.at), tension = tension_between(first, second, spring, followed);
        largest_excess = larger_excess(largest_excess, spring, share);
        eliminated = eliminate_spring(eliminated, spring_before.normal, spring, normal_after, first.position.w,
                                      second.position.w, share, compliance, tension);
        rows[place(line, e)] = eliminated;
        scratch[place(line, e)] = vec4(delta, tension);
        delta = delta_before;
        normal_after = spring.normal;
        spring = spring_before;
        second = first;
        first = before;
    }
    return largest_excess;
}

void store_particle(LineParticle particle, vec3 delta, vec3 correction) {
    vec4 before = imageLoad(displacement_in, particle.at);  // w: lost to drag, kept beside the displacement
    STORE_VECTOR(displacement_out, particle.at,
               vec4(moved_by_both(before.xyz, delta, correction, particle.position.w), before.w));
}

/// From the line's start on: substitutes in the second system; a particle is written once both its springs are known.
void substitute_springs(int line, float compliance, float followed) {
    float change_before = 0.0f;
    vec3 normal_before = vec3(0.0f, 0.0f, 0.0f);
    vec4 filtered = scratch[place(line, 0)];
    LineParticle first = moved_particle(line_start(line, push.step), filtered.xyz);
    for (int e = 0; e < push.particle_count - 1; ++e) {
        vec4 filtered_after = scratch[place(line, e + 1)];
        LineParticle second = moved_particle(next_on_line(first.at, push.step, push.grid.x), filtered_after.xyz);
        vec3 normal = spring_between(first, second).normal;
        float change = substitute_spring(rows[place(line, e)], change_before);
        store_particle(first, filtered.xyz, line_correction(normal_before, change_before, normal, change));
        float tension = changed_tension(filtered.w, change, share_of(first.at), compliance);
        STORE_SCALAR(tension_out, first.at, stored_tension(tension, followed));
        change_before = change;
        normal_before = normal;
        filtered = filtered_after;
        first = second;
    }
    store_particle(first, filtered.xyz,
                   line_correction(normal_before, change_before, vec3(0.0f, 0.0f, 0.0f), 0.0f));
}

void main() {
    int line = int(gl_GlobalInvocationID.x);
    if (line >= push.line_count) return;
    float compliance = push.compliance, followed = push.followed, bend = push.bend;
    if (imageLoad(control, ivec2(control_order, 0)).x == 2u) {
        compliance = push.compliance_bdf2;
        followed = push.followed_bdf2;
        bend = push.bend_bdf2;
    }
    if (push.first_iteration != 0) eliminate_particles(line, compliance, followed, bend);
    float largest_excess = eliminate_springs(line, compliance, followed);
    substitute_springs(line, compliance, followed);
    imageAtomicMax(control, ivec2(control_violation, 0),
                   floatBitsToUint(line_violation(largest_excess, push.rest_length)));
}
