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
layout(set = 0, binding = 0, std430) readonly buffer SewnParticles { SewnParticle sewn_particles[]; };
layout(set = 0, binding = 1, std430) readonly buffer SewnPlaces { SewnPlace sewn_places[]; };
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D position;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D displacement;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D displacement_remainder;
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D displacement_before;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D wind_force_in;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D wind_force_out;

void take_vector(ivec2 at, vec4 sum, float part) {
    vec3 own = imageLoad(wind_force_in, at).xyz;
    if (push.stage == seam_forces)
        imageStore(wind_force_out, at, own_force(sum, part));
    else if (shares_normal(sum.xyz, own))
        imageStore(wind_force_out, at, vec4(unit_or_zero(sum.xyz), 0.0f));
}

void main() {
    int own = int(gl_GlobalInvocationID.x);
    if (own >= push.particle_count) return;
    SewnParticle particle = sewn_particles[own];
    SewnPlace place = sewn_places[particle.at.z];
    if (sews_vectors) {
        take_vector(particle.at.xy, place.vector, particle.parts.y);
        return;
    }
    imageStore(displacement, particle.at.xy, place.displacement);
    if (sews_predicted) imageStore(displacement_remainder, particle.at.xy, place.remainder);
    if (sews_touched) imageStore(displacement_before, particle.at.xy, place.before);
    // Where the leader is held, or let go, so are those that follow it.
    if (sews_predicted || sews_touched)
        imageStore(position, particle.at.xy,
                   vec4(place.position.xyz, place.position.w == 0.0f ? 0.0f : particle.weights.y));
}
