// Solves the springs of one direction line by line: one invocation per line, Thomas algorithm. The lines of a direction
// share no particle, so the displacement is updated in place. SECOND_ORDER: the control says whether this substep is
// BDF2, and hears of the worst spring. MASKED: the spring shares come from an image (holes, cuts). TENSION: the springs'
// tension is stored, as in the spring passes.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SECOND_ORDER MASKED TENSION
#include "shared/line_types.h"
#include "include/line.h"
#include "include/verlet.h"

layout(local_size_x = line_group_width) in;
layout(push_constant) uniform Push { LinePush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D displacement_out;
layout(set = 0, binding = 3, std430) buffer Scratch { vec2 scratch[]; };
#ifdef MASKED
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D spring_share_image;
#endif
#ifdef TENSION
layout(set = 0, binding = 5, r32f) uniform readonly image2D tension_in;
layout(set = 0, binding = 6, r32f) uniform writeonly image2D tension_out;
#endif
#ifdef SECOND_ORDER
layout(set = 0, binding = 7, r32ui) uniform uimage2D control;
#endif

struct LineParticle {
    vec4 position;  // w: as its springs feel it, with the wind's drag
    vec3 displacement;
    float loss;  // to drag, kept beside the displacement
};

LineParticle load_particle(ivec2 at) {
    vec4 start = imageLoad(position, at), moved = imageLoad(displacement_in, at);
    return LineParticle(vec4(start.xyz, dragged_weight(start.w, moved.w)), moved.xyz, moved.w);
}

LineSpring spring_between(LineParticle first, LineParticle second) {
    return line_spring(spring_edge(first.position.xyz, second.position.xyz, first.displacement, second.displacement),
                       push.rest_length);
}

float share_of(ivec2 first) {
    if (first.x == push.seam) return 0.0f;
#ifdef MASKED
    return imageLoad(spring_share_image, first)[push.channel];
#else
    return border_share(first, push.step, push.grid);
#endif
}

/// Tension in the solve's own units: an extension by the compliance in use.
float tension_of(ivec2 first, float followed) {
#ifdef TENSION
    precise float tension = imageLoad(tension_in, first).x / followed;
    if (push.first_iteration == 0) return tension;
#endif
    return 0.0f;
}

/// A place on a line: two neighbours. At the elimination's end the last two.
struct LinePlace {
    ivec2 at_first, at_second;
    LineParticle first, second;
    float largest_excess;
};

LinePlace eliminate_line(int line, float compliance, float followed) {
    LinePlace place;
    place.at_first = line_start(line, push.step);
    place.at_second = next_on_line(place.at_first, push.step, push.grid.x);
    place.first = load_particle(place.at_first);
    place.second = load_particle(place.at_second);
    place.largest_excess = 0.0f;
    LineSpring spring = spring_between(place.first, place.second);
    vec3 normal_before = vec3(0.0f, 0.0f, 0.0f);
    vec2 eliminated = vec2(0.0f, 0.0f);
    int last = push.particle_count - 2;
    for (int e = 0; e <= last; ++e) {
        ivec2 at_third = next_on_line(place.at_second, push.step, push.grid.x);
        LineParticle third = place.second;
        LineSpring after = LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f);
        if (e < last) {
            third = load_particle(at_third);
            after = spring_between(place.second, third);
        }
        float share = share_of(place.at_first);
        place.largest_excess = larger_excess(place.largest_excess, spring, share);
        eliminated =
            eliminate_spring(eliminated, normal_before, spring, after.normal, place.first.position.w,
                             place.second.position.w, share, compliance, tension_of(place.at_first, followed));
        scratch[e * push.line_count + line] = eliminated;
        if (e == last) break;
        normal_before = spring.normal;
        spring = after;
        place.first = place.second;
        place.second = third;
        place.at_first = place.at_second;
        place.at_second = at_third;
    }
    return place;
}

void move_particle(ivec2 at, LineParticle particle, vec3 correction) {
    imageStore(displacement_out, at, vec4(moved_by(particle.displacement, correction, particle.position.w), particle.loss));
}

/// From the end of the line back; a particle is written once both its springs are known.
void substitute_line(int line, LinePlace place, float compliance, float followed) {
    float change_after = 0.0f;
    vec3 normal_after = vec3(0.0f, 0.0f, 0.0f);
    for (int e = push.particle_count - 2; e >= 0; --e) {
        LineSpring spring = spring_between(place.first, place.second);
        float change = substitute_spring(scratch[e * push.line_count + line], change_after);
        move_particle(place.at_second, place.second,
                      line_correction(spring.normal, change, normal_after, change_after));
#ifdef TENSION
        precise float tension =
            changed_tension(tension_of(place.at_first, followed), change, share_of(place.at_first), compliance) *
            followed;
        imageStore(tension_out, place.at_first, vec4(tension, 0.0f, 0.0f, 0.0f));
#endif
        change_after = change;
        normal_after = spring.normal;
        place.second = place.first;
        place.at_second = place.at_first;
        if (e == 0) break;
        place.at_first = next_on_line(place.at_first, -push.step, push.grid.x);
        place.first = load_particle(place.at_first);
    }
    move_particle(place.at_second, place.second,
                  line_correction(vec3(0.0f, 0.0f, 0.0f), 0.0f, normal_after, change_after));
}

void main() {
    int line = int(gl_GlobalInvocationID.x);
    if (line >= push.line_count) return;
    float compliance = push.compliance, followed = push.followed;
#ifdef SECOND_ORDER
    if (imageLoad(control, ivec2(control_order, 0)).x == 2u) {
        compliance = push.compliance_bdf2;
        followed = push.followed_bdf2;
    }
#endif
    LinePlace end = eliminate_line(line, compliance, followed);
    substitute_line(line, end, compliance, followed);
#ifdef SECOND_ORDER
    imageAtomicMax(control, ivec2(control_violation, 0),
                   floatBitsToUint(line_violation(end.largest_excess, push.rest_length)));
#endif
}
