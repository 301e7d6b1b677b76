// This pass hands on what a cloth has done to its particles at seams: the places where they are sewn get it, and
// seam_take.comp gives it to the other particles there. An invocation takes those of the cloth at one place, in order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/seam_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/seam.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SeamPush)
layout(constant_id = 0) const bool sews_vectors = false;   // the forces or normals, else the motion
layout(constant_id = 1) const bool sews_predicted = false;  // the motion with what rounding lost of it
layout(constant_id = 2) const bool sews_touched = false;    // the motion with what contact writes
layout(set = 0, binding = 0, std430) readonly buffer SewnParticles { SewnParticle sewn_particles[]; };
layout(set = 0, binding = 1, std430) buffer SewnPlaces { SewnPlace sewn_places[]; };
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D displacement_remainder;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D displacement_before;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D wind_force;

void give_vector(SewnParticle particle, int place) {
    vec4 own = imageLoad(wind_force, particle.at.xy), sum = sewn_places[place].vector;
    if (particle.weights.z != 0.0f)
        sum = own;
    else if (push.stage == seam_normals)
        sum = vec4(sewn_normal(sum.xyz, own.xyz), 0.0f);
    else
        sum = sewn_force(sum, own);
    sewn_places[place].vector = sum;
}

void give_mean(SewnParticle particle, int place) {
    float share = particle.weights.x;
    vec4 moved = imageLoad(displacement, particle.at.xy), mean = sewn_places[place].displacement;
    vec3 lost = imageLoad(displacement_remainder, particle.at.xy).xyz;
    sewn_places[place].displacement =
        vec4(sewn_mean(mean.xyz, moved.xyz, share), share == 1.0f ? moved.w : mean.w);
    sewn_places[place].remainder = vec4(sewn_mean(sewn_places[place].remainder.xyz, lost, share), 0.0f);
    if (share != 1.0f) return;
    sewn_places[place].position = imageLoad(position, particle.at.xy);
    if (sews_touched) sewn_places[place].before = imageLoad(displacement_before, particle.at.xy);
}

/// `begun`: the place before any of the cloth's particles was counted; `farthest`: square of the farthest way so far.
float give_touched(SewnParticle particle, int place, SewnPlace begun, int count, float farthest) {
    vec4 start = imageLoad(position, particle.at.xy), moved = imageLoad(displacement, particle.at.xy);
    float way = sewn_way(moved.xyz, begun.displacement.xyz, start.xyz, begun.position.xyz);
    if (count > 1 && !(way > farthest)) return farthest;
    sewn_places[place].position = vec4(start.xyz, begun.position.w);
    sewn_places[place].displacement = moved;
    if (sews_touched) sewn_places[place].before = imageLoad(displacement_before, particle.at.xy);
    return way;
}

/// A cloth's particles at a place have the mass of all that are sewn there between them, so their mean is what the
/// springs' impulses give to it.
void give_solved(SewnParticle particle, int place) {
    vec4 mean = sewn_places[place].displacement;
    vec3 moved = imageLoad(displacement, particle.at.xy).xyz;
    sewn_places[place].displacement = vec4(sewn_mean(mean.xyz, moved, particle.parts.x), mean.w);
}

void main() {
    int own = int(gl_GlobalInvocationID.x);
    if (own >= push.particle_count) return;
    int place = sewn_particles[own].at.z, count = sewn_particles[own].at.w;
    if (count == 0) return;
    SewnPlace begun = sewn_places[place];
    float farthest = -1.0f;
    for (int k = 0;;) {
        SewnParticle particle = sewn_particles[own + k];
        if (sews_vectors)
            give_vector(particle, place);
        else if (sews_predicted)
            give_mean(particle, place);
        else if (push.stage == seam_touched)
            farthest = give_touched(particle, place, begun, count, farthest);
        else
            give_solved(particle, place);
        ++k;
        if (k >= count) break;
    }
}
