// Writes what is seen of a cloth: its depth, the normal of the side in view, its id and its strain (strain.vert).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/layer.h"

layout(push_constant) uniform Push { StrainPush push; };
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in float strain;
layout(location = 0) out uvec4 pixel;

void main() {
    vec3 facet = cross(dFdy(world), dFdx(world));
    vec3 normal = gl_FrontFacing ? surface_normal : -surface_normal;
    if (dot(normal, normal) < 1e-6) normal = facet;
    pixel = layer_pixel(normalize(normal), push.grid.z, strain);
}
