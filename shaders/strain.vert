// Makes a cloth's particles vertices of a heat map of strain, (length - rest length) / rest length as in the
// statistics. The spring of a particle that is strained most counts, so that a picture's extremes are the statistics'
// own. Where the cloth is `cut`, there are vertices on its cut springs, each with its own side's particle. Where it
// is `masked`, spring shares come from an image (holes, cuts); without a share there is no spring.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/cut_types.h"
#include "include/raster_frame.h"

layout(constant_id = 0) const int shown = strain_of_both;
layout(push_constant) uniform Push { StrainPush push; };
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D normal;
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D spring_shares;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 surface_normal;
layout(location = 2) out float place;  // place on the heat map
#include "include/cloth_vertex.h"

/// Returns `strain`, or that of the spring from a particle to the next along columns (0) or rows (1) if it counts more.
float with_spring(float strain, ivec2 first, int direction) {
    ivec2 second = first + ivec2(1 - direction, direction);
    if (any(lessThan(first, ivec2(0))) || any(greaterThanEqual(second, ivec2(push.grid.xy)))) return strain;
    float rest_length = push.springs[direction];
    if (!(rest_length > 0.0)) return strain;
    if (masked) {
        if (!(imageLoad(spring_shares, first)[direction] > 0.0)) return strain;
        bool own_rest = imageSize(spring_shares).x > int(push.grid.x);  // as in include/rest_length.h
        if (own_rest) rest_length *= imageLoad(spring_shares, first + ivec2(push.grid.x, 0))[direction];
    }
    float current = distance(imageLoad(position, first).xyz, imageLoad(position, second).xyz);
    float found = (current - rest_length) / rest_length;
    bool more = shown == strain_of_both ? found > strain : abs(found) > abs(strain);
    return more ? found : strain;
}

float strain_at(ivec2 texel) {
    float strain = 0.0;
    if (shown != strain_of_weft) strain = with_spring(with_spring(strain, texel, 0), texel - ivec2(1, 0), 0);
    if (shown != strain_of_warp) strain = with_spring(with_spring(strain, texel, 1), texel - ivec2(0, 1), 1);
    return strain;
}

void main() {
    uint index = uint(gl_VertexIndex);
    uint particle = index;
    world = vertex_position(index);
    if (cut)
        if (is_cut_vertex(index)) particle = cut_vertex(index).particles.x;
    ivec2 texel = particle_texel(particle);
    surface_normal = imageLoad(normal, texel).xyz;
    float strain = strain_at(texel);
    if (push.place.z > 0.0) strain = sign(strain) * push.place.w * log(1.0 + push.place.z * abs(strain));
    place = push.place.x * strain + push.place.y;
    gl_Position = clip_position(world);
    gl_Position.z = depth_of_thickness(world, push.springs.w, gl_Position.w);
    gl_ClipDistance[0] = clip_distance(world, push.springs.w);
}
