// This pass solves the springs of one direction line by line: one invocation solves a line by the Thomas algorithm, in
// three walks along it. The lines of a direction share no particle, so the displacement is updated in place. The
// control says whether this substep is BDF2, and counts the lines with a spring that is too wrong. Where `masked`, the
// spring shares come from an image (holes, cuts). Where `bends`, the line also resists bending.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/line.h"
#include "include/in_pairs.h"
#include "include/bent_line.h"
#include "include/verlet.h"
#include "include/push.h"

layout(local_size_x = line_group_width) in;
CLOTH_CONSTANTS(LinePush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(2, displacement_out);
// The scratch has two texels for each particle p of a line. The first walk stores the eliminated particle in the first
// texel and, where the line bends, in x of the second. The second walk replaces them: the first texel then holds in xyz
// the change of displacement by the first system and in w the tension of the spring after p that results, and the
// second in xy that spring, eliminated. An invocation reads only what it wrote itself. Buffers take both as pairs of
// floats, since on the default device every store is a loop over the lanes, whose cost is per element.
layout(set = 0, binding = 3, rgba32f) uniform coherent readonly image2D line_scratch_in;
struct TwoTexels {
    u64vec3 pairs;
    uint64_t unused;
};
IMAGE(coherent writeonly, 4, rgba32f, line_scratch_out);
VIEW(coherent writeonly, 4, TwoTexels, line_scratch_out, pairs);
layout(set = 0, binding = 5, r32f) uniform readonly image2D tension_in;
SCALAR_OUT(6, tension_out);
layout(constant_id = 21) const bool masked = false;
layout(constant_id = 24) const bool bends = false;
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 8, r32ui) uniform uimage2D line_control;
layout(constant_id = 0) const bool first_iteration = true;  // solves both systems; later ones repeat the second alone

#include "include/line_particles.h"

const vec3 none = vec3(0.0f, 0.0f, 0.0f);  // edge or normal of the spring that a line's end lacks

/// Returns the index of a particle's scratch. The entries that a subgroup stores at one time are adjacent.
int place(Line line, int p) {
    int group = int(gl_WorkGroupID.z * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    return (group * (line.last + 1) + p) * line_group_width + int(gl_LocalInvocationIndex);
}

/// Returns the texel in the scratch image, which is addressed as if it had only one row.
ivec2 scratch_texel(int texel) { return ivec2(texel & (line_scratch_width - 1), texel / line_scratch_width); }

vec4 load_first(Line line, int p) { return imageLoad(line_scratch_in, scratch_texel(2 * place(line, p))); }

vec2 load_second(Line line, int p) { return imageLoad(line_scratch_in, scratch_texel(2 * place(line, p) + 1)).xy; }

uint64_t pair(float low, float high) { return packUint2x32(uvec2(floatBitsToUint(low), floatBitsToUint(high))); }

void store_first(Line line, int p, vec4 first) {
    if (buffered)
        line_scratch_out_pairs.line_scratch_out[place(line, p)].pairs.xy =
            u64vec2(pair(first.x, first.y), pair(first.z, first.w));
    else
        imageStore(line_scratch_out, scratch_texel(2 * place(line, p)), first);
}

void store_scratch(Line line, int p, vec4 first, vec2 second) {
    if (buffered) {
        line_scratch_out_pairs.line_scratch_out[place(line, p)].pairs =
            u64vec3(pair(first.x, first.y), pair(first.z, first.w), pair(second.x, second.y));
        return;
    }
    imageStore(line_scratch_out, scratch_texel(2 * place(line, p)), first);
    imageStore(line_scratch_out, scratch_texel(2 * place(line, p) + 1), vec4(second, 0.0f, 0.0f));
}

void store_bent(Line line, int p, BentParticle particle) {
    store_scratch(line, p, vec4(particle.turn, particle.by_turn), vec2(particle.by_shift, 0.0f));
}

/// The values that a walk from the start of a line that bends has before it eliminates particle p.
struct BentWalk {
    int p;
    LineParticle particle, next;
    vec3 edge;    // between `particle` and `next`, m
    float share;  // share of the spring between them
    BentLine bent;
};

/// Eliminates particle p. `share_after` is 0 if no spring follows its own.
void eliminate_between(Line line, inout BentWalk walk, vec3 edge_after, float share_after) {
    float stiffness = stiffness_of(line, walk.particle, walk.next, walk.share);
    vec3 difference = beyond_rest(second_difference(-walk.edge, edge_after), bend_target(walk.next.at, line.channel));
    BentParticle eliminated = eliminate_bent(walk.bent, walk.edge, stiffness, difference,
                                             element_bend(line.bend, walk.share, share_after), walk.particle.position.w);
    store_bent(line, walk.p, eliminated);
    walk.bent = eliminated.line;
    ++walk.p;
}

void eliminate_next(Line line, inout BentWalk walk) {
    LineParticle after = particle_after(line, walk.next);
    vec3 edge_after = start_edge_of(walk.next, after);
    float share_after = share_of(line, walk.next.at);
    eliminate_between(line, walk, edge_after, share_after);
    walk.particle = walk.next;
    walk.next = after;
    walk.edge = edge_after;
    walk.share = share_after;
}

/// Eliminates particles of the first system of a line that bends, from its start on.
void eliminate_bent_particles(Line line) {
    LineParticle particle = load_particle(line_start(line.index, line.step));
    LineParticle next = particle_after(line, particle);
    BentWalk walk = BentWalk(0, particle, next, start_edge_of(particle, next), share_of(line, particle.at),
                                     unbent_line());
    IN_PAIRS(line.last - 1, eliminate_next(line, walk))  // a line has two particles at least
    eliminate_between(line, walk, vec3(0.0f, 0.0f, 0.0f), 0.0f);
    store_bent(line, line.last, eliminate_last_bent(walk.bent, walk.next.position.w));
}

/// The values that a walk from the line's start has before it eliminates particle p.
struct ParticleWalk {
    int p;
    LineParticle particle;
    EliminatedParticle eliminated;  // the particle before
    vec3 edge_before;
    float stiffness_before;
};

void eliminate_next(Line line, inout ParticleWalk walk) {
    LineParticle next = particle_after(line, walk.particle);
    vec3 edge = start_edge_of(walk.particle, next);
    float stiffness = stiffness_of(line, walk.particle, next, share_of(line, walk.particle.at));
    walk.eliminated = eliminate_particle(walk.eliminated, walk.edge_before, walk.stiffness_before, edge, stiffness,
                                         walk.particle.position.w);
    store_first(line, walk.p, walk.eliminated.row);
    walk.particle = next;
    walk.edge_before = edge;
    walk.stiffness_before = stiffness;
    ++walk.p;
}

/// Eliminates particles of the first system, from the line's start on.
void eliminate_particles(Line line) {
    ParticleWalk walk =
        ParticleWalk(0, load_particle(line_start(line.index, line.step)), unmoved_start(), none, 0.0f);
    IN_PAIRS(line.last, eliminate_next(line, walk))
    walk.eliminated = eliminate_particle(walk.eliminated, walk.edge_before, walk.stiffness_before, none, 0.0f,
                                         walk.particle.position.w);
    store_first(line, line.last, walk.eliminated.row);
}

/// Returns the change of particle p by the first system, from that of the next particle. `turn` is the turn of the edge
/// after that particle, and becomes that of the edge after p.
vec3 delta_of(Line line, int p, vec3 delta_after, inout vec3 turn) {
    if (!first_iteration) return vec3(0.0f, 0.0f, 0.0f);
    if (!bends) return substitute_particle(load_first(line, p), delta_after);
    turn = substitute_turn(load_first(line, p), load_second(line, p).x, turn, delta_after);
    return bent_delta(delta_after, turn);
}

/// The values that a walk back from the line's end has before it eliminates spring e.
struct SpringWalk {
    int e;
    LineParticle first, second;  // particles of spring e
    LineSpring spring;
    vec3 delta, moved_first;  // its first particle's change by the first system, and displacement with it, m
    vec3 turn, normal_after;
    vec2 eliminated;  // the spring after it
    float largest;    // largest |C - T| so far, m
};

/// Eliminates spring e and stores it beside the change of its first particle by the first system.
void eliminate_between(Line line, inout SpringWalk walk, vec3 normal_before) {
    float share = share_of(line, walk.first.at);
    float tension = filtered_tension_of(line, walk.first, walk.second, walk.spring);
    walk.largest = larger_violation(walk.largest, walk.spring, share, line.compression, tension);
    walk.eliminated = eliminate_spring(walk.eliminated, normal_before, walk.spring, walk.normal_after,
                                       walk.first.position.w, walk.second.position.w, share, line.compression,
                                       line.compliance, tension);
    store_scratch(line, walk.e, vec4(walk.delta, tension), walk.eliminated);
}

/// Eliminates spring e, which has one before it.
void eliminate_next(Line line, inout SpringWalk walk) {
    LineParticle before = particle_before(line, walk.first);
    vec3 delta_before = delta_of(line, walk.e - 1, walk.delta, walk.turn);
    vec3 moved_before = filtered(before, delta_before);
    LineSpring spring_before = spring_between(line, before, moved_before, walk.first, walk.moved_first);
    eliminate_between(line, walk, spring_before.normal);
    walk.normal_after = walk.spring.normal;
    walk.spring = spring_before;
    walk.second = walk.first;
    walk.first = before;
    walk.moved_first = moved_before;
    walk.delta = delta_before;
    --walk.e;
}

/// Substitutes in the first system and eliminates in the second, from the line's end back. Returns the largest |C - T|
/// of the line, m.
float eliminate_springs(Line line) {
    vec3 turn = none;
    LineParticle second = load_particle(line_end(line.index, line.step, line.last + 1, line.columns));
    vec3 delta = delta_of(line, line.last, none, turn);
    vec3 moved_second = filtered(second, delta);
    store_scratch(line, line.last, vec4(delta, 0.0f), vec2(0.0f, 0.0f));
    delta = delta_of(line, line.last - 1, delta, turn);
    LineParticle first = particle_before(line, second);
    vec3 moved_first = filtered(first, delta);
    SpringWalk walk =
        SpringWalk(line.last - 1, first, second, spring_between(line, first, moved_first, second, moved_second), delta,
                   moved_first, turn, none, vec2(0.0f, 0.0f), 0.0f);
    IN_PAIRS(line.last - 1, eliminate_next(line, walk))
    eliminate_between(line, walk, none);
    return walk.largest;
}

/// The values that a walk from the line's start has before it writes particle p.
struct MoveWalk {
    int p;
    LineParticle first;  // particle p
    vec4 delta;          // xyz: its change by the first system, m; w: tension of the spring after it, m
    vec3 moved_first, normal_before;
    float change_before;
};

/// Writes particle p, both of whose springs are known.
void move(MoveWalk walk, vec3 normal, float change) {
    vec3 correction = line_correction(walk.normal_before, walk.change_before, normal, change);
    vec3 moved = moved_by_both(walk.first.moved.xyz, walk.delta.xyz, correction, walk.first.position.w);
    STORE_TRIPLE(displacement_out, walk.first.at, moved, walk.first.moved.w);
}

/// Writes particle p, which has a spring after it, and that spring's tension.
void move_next(Line line, inout MoveWalk walk) {
    LineParticle second = particle_after(line, walk.first);
    vec4 delta_after = load_first(line, walk.p + 1);
    vec3 moved_second = filtered(second, delta_after.xyz);
    LineSpring spring = spring_between(line, walk.first, walk.moved_first, second, moved_second);
    float change = substitute_spring(load_second(line, walk.p), walk.change_before);
    move(walk, spring.normal, change);
    float share = share_of(line, walk.first.at);
    float tension = changed_tension(walk.delta.w, change, share, SPRING_COMPLIANCE(line, share));
    STORE_SCALAR(tension_out, walk.first.at, stored_tension(tension, line.followed));
    walk.change_before = change;
    walk.normal_before = spring.normal;
    walk.delta = delta_after;
    walk.first = second;
    walk.moved_first = moved_second;
    ++walk.p;
}

/// Substitutes in the second system, from the line's start on.
void substitute_springs(Line line) {
    LineParticle first = load_particle(line_start(line.index, line.step));
    vec4 delta = load_first(line, 0);
    MoveWalk walk = MoveWalk(0, first, delta, filtered(first, delta.xyz), none, 0.0f);
    IN_PAIRS(line.last, move_next(line, walk))
    move(walk, none, 0.0f);
}

void main() {
    if (int(gl_GlobalInvocationID.x) >= push.line_count) return;
    Line line = read_line(int(gl_GlobalInvocationID.x));
    if (first_iteration) {
        if (bends)
            eliminate_bent_particles(line);
        else
            eliminate_particles(line);
    }
    float largest = eliminate_springs(line);
    substitute_springs(line);
    if (line_is_wrong(largest, line.rest_length)) imageAtomicAdd(line_control, ivec2(control_wrong_lines, cloth_place()), 1u);
}
