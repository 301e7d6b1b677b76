// A collider's surface. SHADOWED: under the first light's shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SHADOWED
#include "shared/collider_types.h"
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"

layout(constant_id = 0) const int collider_kind = kind_plane;
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in vec2 on_plane;
layout(location = 3) flat in vec4 albedo;
layout(location = 0) out vec4 color;

/// Share of a pixel that the grid's lines cover; they are about one and a half pixels wide.
float grid_lines() {
    vec2 cell = on_plane / albedo.w;
    vec2 width = max(fwidth(cell), vec2(1e-6));
    vec2 line = 1.0 - min(abs(fract(cell - 0.5) - 0.5) / (0.75 * width), 1.0);
    // Lines closer than a few pixels would only flicker.
    vec2 visible = clamp(1.0 - 6.0 * width, 0.0, 1.0);
    return max(line.x * visible.x, line.y * visible.y);
}

void main() {
    vec3 to_eye = frame[0].eye.xyz - world;
    vec3 normal = dot(surface_normal, to_eye) < 0.0 && collider_kind == kind_plane ? -surface_normal : surface_normal;
    vec3 diffuse = albedo.xyz;
    if (collider_kind == kind_plane) diffuse = mix(diffuse, diffuse * 0.75, grid_lines());
    float gloss = collider_kind == kind_plane ? 0.0 : 0.12;
    Surface surface = Surface(diffuse, normalize(normal), normalize(to_eye), 0.0, gloss, 0.0, 1.0);
    color = vec4(shaded(surface, world), 1.0);
    if (collider_kind == kind_plane) {
        float away = distance(world, frame[0].fade.xyz) / frame[0].fade.w;
        color.xyz = mix(color.xyz, backdrop(gl_FragCoord.y), smoothstep(0.25, 1.0, away));
    }
}
