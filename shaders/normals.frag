// Shows the normal of a cloth's side that faces the eye as a colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/tone.h"

layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 0) out vec4 color;

/// Radiance that the picture shows as the sRGB value `srgb`.
float radiance_of(float srgb) {
    return untoned(srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4));
}

void main() {
    vec3 facet = cross(dFdy(world), dFdx(world));
    vec3 normal = gl_FrontFacing ? surface_normal : -surface_normal;
    if (dot(normal, normal) < 1e-6) normal = facet;
    vec3 shown = 0.5 + 0.5 * normalize(normal);
    color = vec4(radiance_of(shown.x), radiance_of(shown.y), radiance_of(shown.z), 1.0);
}
