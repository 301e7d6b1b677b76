// This pass gives a cloth's particles at seams what seam_give.comp has handed on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/seam_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/seam.h"
#include "include/wind.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SeamPush)
layout(constant_id = 0) const bool sews_vectors = false;
layout(constant_id = 1) const bool sews_predicted = false;
layout(constant_id = 2) const bool sews_touched = false;
layout(constant_id = 3) const bool sews_between = false;
layout(constant_id = 4) const bool sews_closing = false;
layout(constant_id = 7) const bool sews_rips = false;
layout(constant_id = 9) const bool sews_ends = false;
layout(set = 0, binding = 0, std430) readonly buffer SewnParticles { SewnParticle sewn_particles[]; };
layout(set = 0, binding = 1, std430) readonly buffer SewnPlaces { SewnPlace sewn_places[]; };
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D position;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D displacement;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D displacement_remainder;
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D displacement_before;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D wind_force_in;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D wind_force_out;
layout(set = 0, binding = 8, std430) writeonly buffer SewnLeads { vec4 sewn_leads[]; };
layout(set = 0, binding = 9, std430) readonly buffer Openings { SeamOpening openings[]; };
layout(set = 0, binding = 10, rgba32f) uniform image2D seam_loads;

bool is_between(SewnParticle particle) { return sews_between && particle.between.x >= 0; }

void take_vector(SewnParticle particle) {
    ivec2 at = particle.at.xy;
    vec4 sum = sewn_places[particle.at.z].vector;
    if (push.stage == seam_areas) {
        imageStore(wind_force_out, at, sum);
        return;
    }
    vec3 own = imageLoad(wind_force_in, at).xyz;
    if (push.stage == seam_forces) {
        vec4 force = own_force(sum, particle.parts.y);
        if (is_between(particle))
            force = sewn_force(force, own_force(sewn_places[particle.between.x].vector, particle.parts.z));
        imageStore(wind_force_out, at, force);
        return;
    }
    if (is_between(particle))
        sum.xyz = sewn_between(sum.xyz, sewn_places[particle.between.x].vector.xyz, particle.weights.w, particle.gap.w);
    if (shares_normal(sum.xyz, own)) imageStore(wind_force_out, at, vec4(unit_or_zero(sum.xyz), 0.0f));
}

/// Returns what is between two places of their positions, motions and the rest.
SewnPlace between(SewnPlace one, SewnPlace other, float of_one, float of_other) {
    SewnPlace mean = one;
    mean.position.xyz = sewn_between(one.position.xyz, other.position.xyz, of_one, of_other);
    if (other.position.w != 0.0f) mean.position.w = other.position.w;
    mean.displacement.xyz = sewn_between(one.displacement.xyz, other.displacement.xyz, of_one, of_other);
    mean.remainder.xyz = sewn_between(one.remainder.xyz, other.remainder.xyz, of_one, of_other);
    mean.before.xyz = sewn_between(one.before.xyz, other.before.xyz, of_one, of_other);
    return mean;
}

/// Returns where a particle is when its place is there, before the substep or in it.
vec3 particle_at(SewnParticle particle, vec3 place) {
    if (sews_closing) {
        if (particle.between.z < 0) return place;
        SeamOpening opening = openings[push.opening + particle.between.z];
        bool moves = push.stage == seam_predicted || push.stage == seam_touched || push.stage == seam_met;
        return sewn_apart(place, particle.gap.xyz, moves ? opening.left.y : opening.left.x);
    }
    return place;
}

/// As a frame ends, a place whose seam does not bear its load comes apart: its particles have masses of their own again.
void rip(SewnParticle particle) {
    if (particle.carried.y == 0.0f) return;
    SewnPlace place = sewn_places[particle.at.z];
    vec4 load = seam_load_of(place.load, push.share, particle.carried.y);
    imageStore(seam_loads, particle.at.xy, load);
    if (load.w != 0.0f) imageStore(position, particle.at.xy, vec4(place.position.xyz, particle.carried.w));
}

void main() {
    int own = int(gl_GlobalInvocationID.x);
    if (own >= push.particle_count) return;
    SewnParticle particle = sewn_particles[own];
    if (sews_rips)
        if (imageLoad(seam_loads, particle.at.xy).w != 0.0f) return;
    if (sews_ends) {
        rip(particle);
        return;
    }
    if (sews_vectors) {
        if (particle.between.y == 1) take_vector(particle);
        return;
    }
    SewnPlace place = sewn_places[particle.at.z];
    if (sews_between) {
        if (is_between(particle)) {
            vec3 begun = place.displacement.xyz;
            place = between(place, sewn_places[particle.between.x], particle.weights.w, particle.gap.w);
            sewn_leads[own] = vec4(sewn_lead(place.displacement.xyz, begun), 0.0f);
        }
    }
    if (particle.between.y == 0) return;
    imageStore(displacement, particle.at.xy, place.displacement);
    if (sews_predicted) imageStore(displacement_remainder, particle.at.xy, place.remainder);
    if (sews_touched) imageStore(displacement_before, particle.at.xy, place.before);
    // Where the leader is held, or let go, so are those that follow it.
    if (sews_predicted || sews_touched)
        imageStore(
            position, particle.at.xy,
            vec4(particle_at(particle, place.position.xyz), place.position.w == 0.0f ? 0.0f : particle.weights.y));
}
