// Lines of particles as line.comp and line_cyclic.comp read them. The includer has the images `position`,
// `displacement_in`, `tension_in`, `line_control` and, where `masked`, `spring_shares`, the push constants (LinePush)
// and `first_iteration`: both systems are solved in the first iteration, the second one alone in later ones.
#include "include/bend_target.h"

/// A line's push constants, read once: on the default device a loop that reads push constants loads them again in each
/// round, lane by lane. For the same reason only stores in the loops below branch.
struct Line {
    int index, last;  // index of the line, and of its last particle
    ivec2 step;
    int columns, seam, channel;
    float share;  // share of all its springs, unless an image has their shares
    float rest_length, compliance, per_compliance, followed, per_followed, bend, compression;
    float shared_compliance;  // for springs with the share `share`
};

struct LineParticle {
    ivec2 at;
    vec4 position;  // w: inverse mass on which its springs act, with the wind's drag
    vec4 moved;     // xyz: displacement before this pass; w: the mark stored beside it (verlet.h)
};

Line read_line(int index) {
    bool second_order = imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u;
    float share = border_share(line_start(index, push.step), push.step, push.grid);
    float compliance = second_order ? push.compliance_bdf2 : push.compliance;
    float followed = second_order ? push.followed_bdf2 : push.followed;
    return Line(index, push.particle_count - 1, push.step, push.grid.x, push.seam, push.channel, share,
                push.rest_length, compliance, reciprocal(compliance), followed, reciprocal(followed),
                second_order ? push.bend_bdf2 : push.bend, push.compression, shared_compliance(compliance, share));
}

float share_of(Line line, ivec2 first) {
    float share = line.share;
    if (masked) share = LOAD(spring_shares, first)[line.channel];
    return first.x == line.seam ? 0.0f : share;
}

LineParticle load_particle(ivec2 at) {
    vec4 start = LOAD(position, at), moved = LOAD(displacement_in, at);
    return LineParticle(at, vec4(start.xyz, dragged_weight(start.w, moved.w)), moved);
}

LineParticle particle_after(Line line, LineParticle particle) {
    return load_particle(next_on_line(particle.at, line.step, line.columns));
}

LineParticle particle_before(Line line, LineParticle particle) {
    return load_particle(next_on_line(particle.at, -line.step, line.columns));
}

vec3 filtered(LineParticle particle, vec3 delta) { return moved_by(particle.moved.xyz, delta, 1.0f); }

float rest_of(Line line, ivec2 first) { return length_at_rest(line.rest_length, first, line.channel); }

float tension_of(Line line, ivec2 first) { return tension_in_use(LOAD(tension_in, first).x, line.per_followed); }

float tension_per_length_of(Line line, LineParticle first, LineParticle second) {
    precise vec3 start_edge = second.position.xyz - first.position.xyz;
    return tension_per_length(tension_of(line, first.at), start_edge, rest_of(line, first.at));
}

vec3 start_edge_of(LineParticle first, LineParticle second) {
    return spring_edge(first.position.xyz, second.position.xyz, first.moved.xyz, second.moved.xyz);
}

float stiffness_of(Line line, LineParticle first, LineParticle second, float share) {
    return geometric_stiffness(tension_per_length_of(line, first, second), share, line.per_compliance);
}

/// Returns the tension of the spring between two particles, after the first system if it is solved.
float filtered_tension_of(Line line, LineParticle first, LineParticle second, LineSpring spring) {
    if (!first_iteration) return tension_of(line, first.at);
    return filtered_tension(tension_per_length_of(line, first, second), spring);
}

LineSpring spring_between(Line line, LineParticle first, vec3 moved_first, LineParticle second, vec3 moved_second) {
    return line_spring(spring_edge(first.position.xyz, second.position.xyz, moved_first, moved_second),
                       rest_of(line, first.at));
}
