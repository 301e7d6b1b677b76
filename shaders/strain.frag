// Draws a cloth's heat map. Colours are not lit, so that each can be read off the legend; only where the surface is
// seen nearly edge on it is darker, which draws the outlines of folds.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"

layout(set = 0, binding = 4, std430) readonly buffer HeatColors { vec4 heat_colors[]; };  // radiance
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in float place;
layout(location = 0) out vec4 color;

void main() {
    vec3 facet = cross(dFdy(world), dFdx(world));
    float at = clamp(place, 0.0, 1.0) * float(heat_color_count - 1);
    int low = min(int(at), heat_color_count - 2);
    vec3 heat = mix(heat_colors[low].xyz, heat_colors[low + 1].xyz, at - float(low));
    vec3 normal = dot(surface_normal, surface_normal) < 1e-6 ? facet : surface_normal;
    float facing = abs(dot(normalize(normal), normalize(frame[0].eye.xyz - world)));
    color = vec4(heat * mix(0.25, 1.0, smoothstep(0.0, 0.3, facing)), 1.0);
}
