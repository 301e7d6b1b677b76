// This pass hands on what a cloth has done to its particles at seams: the places where they are sewn get it, and
// seam_take.comp gives it to the other particles there. An invocation takes those of the cloth at one place, in order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/seam_types.h"
#include "shared/simulation_types.h"
#include "include/bdf2.h"
#include "include/push.h"
#include "include/seam.h"
#include "include/verlet.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SeamPush)
layout(constant_id = 0) const bool sews_vectors = false;    // the forces or normals, else the motion
layout(constant_id = 1) const bool sews_predicted = false;  // the motion with what rounding lost of it
layout(constant_id = 2) const bool sews_touched = false;    // the motion with what contact writes
layout(constant_id = 3) const bool sews_between = false;    // some of the particles lie between two places
layout(constant_id = 4) const bool sews_closing = false;    // some seams close
layout(constant_id = 6) const bool sews_weight = false;     // the forces have the change of gravity
layout(constant_id = 5) const bool sews_leads = false;      // those between two places count by what they change
layout(constant_id = 7) const bool sews_orders = false;     // the order of the line method's steps alone
layout(constant_id = 8) const bool sews_rips = false;       // some seams rip
layout(constant_id = 9) const bool sews_pulls = false;      // what moves the particles pulls at seams
layout(constant_id = 10) const bool sews_ends = false;      // at a frame's end, before places come apart
layout(constant_id = 11) const bool second_order = false;   // substeps may be BDF2
layout(set = 0, binding = 0, std430) readonly buffer SewnParticles { SewnParticle sewn_particles[]; };
layout(set = 0, binding = 1, std430) buffer SewnPlaces { SewnPlace sewn_places[]; };
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D displacement_remainder;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D displacement_before;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D wind_force;
layout(set = 0, binding = 7, std430) readonly buffer SewnLeads { vec4 sewn_leads[]; };
layout(set = 0, binding = 8, std430) readonly buffer Openings { SeamOpening openings[]; };
layout(set = 0, binding = 9, std430) readonly buffer Wind { vec4 wind[]; };
layout(set = 0, binding = 10, r32ui) uniform readonly uimage2D line_control;
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D seam_loads;

/// Adds what pulls a particle to the load on its seam.
void add_load(SewnParticle particle, int place, vec3 pull) {
    if (particle.carried.y == 0.0f) return;
    sewn_places[place].load = seam_load(sewn_places[place].load, pull, particle.carried.z);
}

/// Returns the force that has moved a particle of this inverse mass by so much.
vec3 pull_of(vec3 moved, float inverse_mass) {
    float force = push.force.x;
    if (second_order)
        if (imageLoad(line_control, ivec2(control_order, 0)).x == 2u) force = push.force.y;
    return sewn_pull(moved, inverse_mass, force);
}

bool is_between(SewnParticle particle) { return sews_between && particle.between.x >= 0; }

void give_vector(SewnParticle particle, int place) {
    vec4 own = imageLoad(wind_force, particle.at.xy), sum = sewn_places[place].vector;
    if (sews_weight)
        own = without_carried(own, wind[push.weather].xyz, particle.carried.x, imageLoad(position, particle.at.xy).w);
    if (sews_pulls) add_load(particle, place, own.xyz);
    if (is_between(particle)) own = own_force(own, particle.weights.w);
    if (particle.weights.z != 0.0f)
        sum = own;
    else if (push.stage == seam_normals)
        sum = vec4(sewn_normal(sum.xyz, own.xyz), 0.0f);
    else
        sum = sewn_force(sum, own);
    sewn_places[place].vector = sum;
}

/// Returns where a particle's place is, before the substep or in it.
vec3 place_of(SewnParticle particle, vec3 at) {
    if (sews_closing) {
        if (particle.between.z < 0) return at;
        SeamOpening opening = openings[push.opening + particle.between.z];
        bool moved = push.stage == seam_touched || push.stage == seam_met;
        return sewn_together(at, particle.gap.xyz, moved ? opening.left.y : opening.left.x);
    }
    return at;
}

void give_mean(SewnParticle particle, int own, int place) {
    bool leads = particle.between.w == 1;
    float share = particle.weights.x;
    // What is there moves as one already.
    if (push.stage != seam_predicted) share = leads ? 1.0f : 0.0f;
    vec4 moved = imageLoad(displacement, particle.at.xy), mean = sewn_places[place].displacement;
    vec3 lost = imageLoad(displacement_remainder, particle.at.xy).xyz, way = moved.xyz;
    if (sews_pulls) add_load(particle, place, pull_of(moved.xyz, particle.weights.y));
    if (sews_leads) {
        if (is_between(particle)) way = sewn_lead(way, sewn_leads[own].xyz);
    }
    sewn_places[place].displacement = vec4(sewn_mean(mean.xyz, way, share), leads ? moved.w : mean.w);
    sewn_places[place].remainder = vec4(sewn_mean(sewn_places[place].remainder.xyz, lost, share), 0.0f);
    if (!leads) return;
    vec4 start = imageLoad(position, particle.at.xy);
    sewn_places[place].position = vec4(place_of(particle, start.xyz), start.w);
    if (sews_touched) sewn_places[place].before = imageLoad(displacement_before, particle.at.xy);
}

/// `begun`: the place before any of the cloth's particles was counted; `farthest`: square of the farthest way so far.
/// What lies between two places follows these: they themselves touch what it would.
float give_touched(SewnParticle particle, int place, SewnPlace begun, int count, float farthest) {
    if (is_between(particle)) return farthest;
    vec4 start = imageLoad(position, particle.at.xy), moved = imageLoad(displacement, particle.at.xy);
    vec3 from = place_of(particle, start.xyz);
    float way = sewn_way(moved.xyz, begun.displacement.xyz, from, begun.position.xyz);
    if (count > 1 && !(way > farthest)) return farthest;
    sewn_places[place].position = vec4(from, begun.position.w);
    sewn_places[place].displacement = moved;
    if (sews_touched) sewn_places[place].before = imageLoad(displacement_before, particle.at.xy);
    return way;
}

/// A cloth's particles at a place have the mass of all that are sewn there between them, so their mean is what the
/// springs' impulses give to it. Where some lie between two places, each one's change counts by its part in the mass;
/// a held place bears it.
void give_solved(SewnParticle particle, int own, int place, SewnPlace begun) {
    vec4 mean = sewn_places[place].displacement;
    vec3 moved = imageLoad(displacement, particle.at.xy).xyz;
    if (sews_pulls)
        add_load(particle, place,
                 pull_of(sewn_lead(moved, begun.displacement.xyz),
                         dragged_weight(particle.weights.y, begun.displacement.w)));
    if (sews_leads) {
        if (is_between(particle)) moved = sewn_lead(moved, sewn_leads[own].xyz);
    }
    vec3 changed = sewn_change(mean.xyz, moved, begun.displacement.xyz, particle.parts.y);
    bool changes = sews_between && particle.parts.w != 0.0f;
    if (begun.position.w == 0.0f) changed = mean.xyz;
    sewn_places[place].displacement = vec4(changes ? changed : sewn_mean(mean.xyz, moved, particle.parts.x), mean.w);
}

uint control_of_cloth(int texel) { return imageLoad(line_control, ivec2(texel, 0)).x; }

void give_order() {
    LineControl own = LineControl(control_of_cloth(control_order), control_of_cloth(control_wrong_lines),
                                  control_of_cloth(control_hold));
    uvec4 others = sewn_places[push.joint].control;
    LineControl joint = LineControl(others.x, others.y, push.begins == 1 ? 0u : others.z);
    joint = joined_control(joint, own, push.most_wrong);
    sewn_places[push.joint].control = uvec4(joint.order, joint.wrong_lines, joint.hold, 0u);
}

/// As a frame ends, what comes apart has to know where it is.
void give_end(SewnParticle particle, int place) {
    if (particle.between.w == 1) sewn_places[place].position = imageLoad(position, particle.at.xy);
}

void main() {
    int own = int(gl_GlobalInvocationID.x);
    if (own >= push.particle_count) return;
    if (sews_orders) {
        give_order();
        return;
    }
    int place = sewn_particles[own].at.z, count = sewn_particles[own].at.w;
    if (count == 0) return;
    if (sews_rips)
        if (imageLoad(seam_loads, sewn_particles[own].at.xy).w != 0.0f) return;
    SewnPlace begun = sewn_places[place];
    float farthest = -1.0f;
    for (int k = 0;;) {
        SewnParticle particle = sewn_particles[own + k];
        if (sews_rips)
            if (push.first == 1 && particle.weights.z != 0.0f) sewn_places[place].load = vec4(0.0f);
        if (sews_ends)
            give_end(particle, place);
        else if (sews_vectors)
            give_vector(particle, place);
        else if (sews_predicted)
            give_mean(particle, own + k, place);
        else if (push.stage == seam_touched)
            farthest = give_touched(particle, place, begun, count, farthest);
        else
            give_solved(particle, own + k, place, begun);
        ++k;
        if (k >= count) break;
    }
}
