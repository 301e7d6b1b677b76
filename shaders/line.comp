// Solves the springs of one direction line by line: one invocation per line, Thomas algorithm, in three walks along it.
// The lines of a direction share no particle, so the displacement is updated in place. The control says
// whether this substep is BDF2, and hears of the worst spring. MASKED: the spring shares come from an image (holes, cuts).
// BENT: the line bends.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED BENT BUFFERED
#ifdef BUFFERED
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#endif
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/line.h"
#include "include/some_at_a_time.h"
#ifdef BENT
#include "include/bent_line.h"
#endif
#include "include/verlet.h"

layout(local_size_x = line_group_width) in;
layout(push_constant) uniform Push { LinePush push; };
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(2, DisplacementOut, displacement_out);
// Two texels for each particle p of a line. The first: eliminated, then xyz what the first system changes of its
// displacement and w the tension that it leaves the spring after it. The second, xy: that spring, eliminated; before, x: of
// particle p of a line that bends. An invocation reads what it wrote itself. Buffers take both as pairs of floats: on the
// default device every store is a loop over the lanes of its own, whose rounds cost by the element.
layout(set = 0, binding = 3, rgba32f) uniform coherent readonly image2D scratch_in;
#ifdef BUFFERED
struct TwoTexels {
    u64vec3 pairs;
    uint64_t unused;
};
layout(set = 0, binding = 4, std430) coherent writeonly buffer ScratchOut { TwoTexels scratch_out[]; };
#else
coherent VECTOR_OUT(4, ScratchOut, scratch_out);
#endif
layout(set = 0, binding = 5, r32f) uniform readonly image2D tension_in;
SCALAR_OUT(6, TensionOut, tension_out);
#ifdef MASKED
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D spring_share_image;
#endif
layout(set = 0, binding = 8, r32ui) uniform uimage2D control;
layout(constant_id = 0) const bool first_iteration = true;  // both systems; later iterations repeat the second alone

#include "include/line_particles.h"

/// Where the scratch of a particle is: what a subgroup stores at a time lies side by side.
int place(Line line, int p) {
    int group = int(gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    return (group * (line.last + 1) + p) * line_group_width + int(gl_LocalInvocationIndex);
}

/// The scratch image is addressed as if it had only one row.
ivec2 scratch_texel(int texel) { return ivec2(texel & (line_scratch_width - 1), texel / line_scratch_width); }

vec4 load_first(Line line, int p) { return imageLoad(scratch_in, scratch_texel(2 * place(line, p))); }

vec2 load_second(Line line, int p) { return imageLoad(scratch_in, scratch_texel(2 * place(line, p) + 1)).xy; }

#ifdef BUFFERED
uint64_t pair(float low, float high) { return packUint2x32(uvec2(floatBitsToUint(low), floatBitsToUint(high))); }
#endif

void store_first(Line line, int p, vec4 first) {
#ifdef BUFFERED
    scratch_out[place(line, p)].pairs.xy = u64vec2(pair(first.x, first.y), pair(first.z, first.w));
#else
    imageStore(scratch_out, scratch_texel(2 * place(line, p)), first);
#endif
}

void store_scratch(Line line, int p, vec4 first, vec2 second) {
#ifdef BUFFERED
    scratch_out[place(line, p)].pairs =
        u64vec3(pair(first.x, first.y), pair(first.z, first.w), pair(second.x, second.y));
#else
    imageStore(scratch_out, scratch_texel(2 * place(line, p)), first);
    imageStore(scratch_out, scratch_texel(2 * place(line, p) + 1), vec4(second, 0.0f, 0.0f));
#endif
}

#ifdef BENT
void store_bent(Line line, int p, BentParticle particle) {
    store_scratch(line, p, vec4(particle.turn, particle.by_turn), vec2(particle.by_shift, 0.0f));
}

/// The first system, from the line's start on.
void eliminate_particles(Line line) {
    LineParticle particle = load_particle(line_start(line.index, line.step));
    LineParticle next = particle_after(line, particle);
    vec3 edge = start_edge_of(particle, next);
    float share = share_of(line, particle.at);
    BentLine bent = unbent_line();
    int p = 0;  // a line has two particles at least
    do {
        bool has_element = p + 1 < line.last;
        LineParticle after = particle_after(line, next);
        vec3 edge_after = has_element ? start_edge_of(next, after) : vec3(0.0f, 0.0f, 0.0f);
        float share_after = has_element ? share_of(line, next.at) : 0.0f;
        BentParticle eliminated =
            eliminate_bent(bent, edge, stiffness_of(line, particle, next, share), edge_after,
                           element_bend(line.bend, share, share_after), particle.position.w);
        store_bent(line, p, eliminated);
        bent = eliminated.line;
        edge = edge_after;
        share = share_after;
        particle = next;
        next = after;
        ++p;
    } while (p < line.last);
    store_bent(line, line.last, eliminate_last_bent(bent, particle.position.w));
}
#else
/// The first system, from the line's start on.
void eliminate_particles(Line line) {
    LineParticle particle = load_particle(line_start(line.index, line.step));
    EliminatedParticle eliminated = unmoved_start();
    vec3 edge_before = vec3(0.0f, 0.0f, 0.0f);
    float stiffness_before = 0.0f;
    SOME_AT_A_TIME(p, 0, 1) {
        bool has_spring = p < line.last;
        LineParticle next = particle_after(line, particle);
        vec3 edge = has_spring ? start_edge_of(particle, next) : vec3(0.0f, 0.0f, 0.0f);
        float stiffness = stiffness_of(line, particle, next, share_of(line, particle.at));
        stiffness = has_spring ? stiffness : 0.0f;
        eliminated =
            eliminate_particle(eliminated, edge_before, stiffness_before, edge, stiffness, particle.position.w);
        if (p <= line.last) store_first(line, p, eliminated.row);
        particle = next;
        edge_before = edge;
        stiffness_before = stiffness;
    }
    WHILE_SOME_ARE_LEFT(p, 1, <= line.last);
}
#endif

/// What the first system changes of particle p, from what it changes of the particle after it; `turn`: how the edge after
/// that one turns, then its own.
vec3 delta_of(Line line, int p, vec3 delta_after, inout vec3 turn) {
    if (!first_iteration) return vec3(0.0f, 0.0f, 0.0f);
#ifdef BENT
    turn = substitute_turn(load_first(line, p), load_second(line, p).x, turn, delta_after);
    return bent_delta(delta_after, turn);
#else
    return substitute_particle(load_first(line, p), delta_after);
#endif
}

/// From the line's end back: substitutes in the first system and eliminates in the second. The largest |C - T| that it meets.
float eliminate_springs(Line line) {
    float largest = 0.0f;
    vec3 normal_after = vec3(0.0f, 0.0f, 0.0f), turn = vec3(0.0f, 0.0f, 0.0f);
    vec2 eliminated = vec2(0.0f, 0.0f);
    LineParticle second = load_particle(line_end(line.index, line.step, line.last + 1, line.columns));
    vec3 delta = delta_of(line, line.last, vec3(0.0f, 0.0f, 0.0f), turn);
    vec3 moved_second = filtered(second, delta);
    store_scratch(line, line.last, vec4(delta, 0.0f), vec2(0.0f, 0.0f));
    delta = delta_of(line, line.last - 1, delta, turn);
    LineParticle first = particle_before(line, second);
    vec3 moved_first = filtered(first, delta);
    LineSpring spring = spring_between(line, first, moved_first, second, moved_second);
    SOME_AT_A_TIME(e, line.last - 1, -1) {
        LineParticle before = particle_before(line, first);
        vec3 delta_before = delta_of(line, e > 0 ? e - 1 : 0, delta, turn);
        vec3 moved_before = filtered(before, delta_before);
        LineSpring spring_before = spring_between(line, before, moved_before, first, moved_first);
        vec3 normal_before = e > 0 ? spring_before.normal : vec3(0.0f, 0.0f, 0.0f);
        float share = e >= 0 ? share_of(line, first.at) : 0.0f;
        float tension = filtered_tension_of(line, first, second, spring);
        largest = larger_violation(largest, spring, share, line.compression, tension);
        eliminated = eliminate_spring(eliminated, normal_before, spring, normal_after, first.position.w,
                                      second.position.w, share, line.compression, line.compliance, tension);
        if (e >= 0) store_scratch(line, e, vec4(delta, tension), eliminated);
        normal_after = spring.normal;
        spring = spring_before;
        second = first;
        first = before;
        moved_first = moved_before;
        delta = delta_before;
    }
    WHILE_SOME_ARE_LEFT(e, -1, >= 0);
    return largest;
}

/// From the line's start on: substitutes in the second system; a particle is written once both its springs are known.
void substitute_springs(Line line) {
    float change_before = 0.0f;
    vec3 normal_before = vec3(0.0f, 0.0f, 0.0f);
    LineParticle first = load_particle(line_start(line.index, line.step));
    vec4 delta = load_first(line, 0);  // w: the tension of the spring after it
    vec3 moved_first = filtered(first, delta.xyz);
    SOME_AT_A_TIME(p, 0, 1) {
        bool has_spring = p < line.last;
        LineParticle second = particle_after(line, first);
        vec4 delta_after = load_first(line, has_spring ? p + 1 : line.last);
        vec3 moved_second = filtered(second, delta_after.xyz);
        LineSpring spring = spring_between(line, first, moved_first, second, moved_second);
        vec3 normal = has_spring ? spring.normal : vec3(0.0f, 0.0f, 0.0f);
        float change = substitute_spring(load_second(line, has_spring ? p : line.last), change_before);
        change = has_spring ? change : 0.0f;
        vec3 correction = line_correction(normal_before, change_before, normal, change);
        vec3 moved = moved_by_both(first.moved.xyz, delta.xyz, correction, first.position.w);
        if (p <= line.last) STORE_TRIPLE(displacement_out, first.at, moved, first.moved.w);
        float share = share_of(line, first.at);
        float tension = changed_tension(delta.w, change, share, SPRING_COMPLIANCE(line, share));
        if (has_spring) STORE_SCALAR(tension_out, first.at, stored_tension(tension, line.followed));
        change_before = change;
        normal_before = normal;
        delta = delta_after;
        first = second;
        moved_first = moved_second;
    }
    WHILE_SOME_ARE_LEFT(p, 1, <= line.last);
}

void main() {
    if (int(gl_GlobalInvocationID.x) >= push.line_count) return;
    Line line = read_line(int(gl_GlobalInvocationID.x));
    if (first_iteration) eliminate_particles(line);
    float largest = eliminate_springs(line);
    substitute_springs(line);
    if (line_is_wrong(largest, line.rest_length)) imageAtomicAdd(control, ivec2(control_wrong_lines, gl_WorkGroupID.z), 1u);
}
