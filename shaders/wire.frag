// Draws a cloth's triangles pale and lit, with dark edges, where `shadowed` under the first light's shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"

layout(push_constant) uniform Push { ClothPush push; };
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in vec2 material;
layout(location = 3) in vec2 hidden;
layout(location = 0) out vec4 color;

const float line_width = 1.3;  // pixels

/// Share of a pixel that the lines at whole numbers cover, or their average where they are too close to be told apart.
float lines(float cell, float width) {
    float away = abs(fract(cell - 0.5) - 0.5) / width;
    return mix(clamp(0.5 * line_width + 0.5 - away, 0.0, 1.0), min(line_width * width, 1.0),
               smoothstep(0.2, 0.5, width));
}

/// Share of a pixel that a cell's sides and the diagonal between its triangles (include/triangles.h) cover.
float edges() {
    vec2 cell = material / push.size.xy * (vec2(push.grid.xy) - 1.0);
    vec3 families = vec3(cell, cell.x + cell.y);
    vec3 width = max(fwidth(families), vec3(1e-5));
    vec3 covered = vec3(lines(families.x, width.x), lines(families.y, width.y), lines(families.z, width.z));
    return max(max(covered.x, covered.y), 0.6 * covered.z);
}

void main() {
    // Derivatives are taken before any branch, where they are defined.
    vec3 facet = cross(dFdy(world), dFdx(world));
    float edge = edges();
    vec3 normal = gl_FrontFacing ? surface_normal : -surface_normal;
    if (dot(normal, normal) < 1e-6) normal = facet;
    vec3 albedo = mix(vec3(0.72, 0.74, 0.76), vec3(0.02, 0.05, 0.10), 0.9 * edge);
    float openness = 1.0 - (gl_FrontFacing ? hidden.x : hidden.y);
    Surface surface =
        Surface(albedo, normalize(normal), normalize(constants.eye.xyz - world), 0.2, 1.0, 0.0, openness);
    color = vec4(shaded(surface, world), 1.0);
}
