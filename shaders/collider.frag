// Draws a collider's surface, where `shadowed` under the first light's shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/collider_types.h"
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"
#include "include/plane.h"

layout(constant_id = 0) const int collider_kind = kind_plane;
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in vec2 on_plane;
layout(location = 3) flat in vec4 albedo;
layout(location = 0) out vec4 color;

const float body_spread = 0.0625;  // of a roughness of 0.5

void main() {
    vec3 to_eye = constants.eye.xyz - world;
    bool plane = collider_kind == kind_plane;
    bool may_be_open = plane || collider_kind == kind_mesh;
    vec3 normal = may_be_open && dot(surface_normal, to_eye) < 0.0 ? -surface_normal : surface_normal;
    vec3 diffuse = albedo.xyz;
    if (plane) {
        vec2 cell = on_plane / albedo.w;
        diffuse = lined(diffuse, grid_lines(cell, max(fwidth(cell), vec2(1e-6))));
    }
    Surface surface =
        Surface(diffuse, normalize(normal), normalize(to_eye), 0.0, plane ? 1.0 : body_spread, 0.0, 1.0);
    color = vec4(shaded(surface, world), 1.0);
    if (plane) {
        float away = distance(world, frame[0].fade.xyz) / frame[0].fade.w;
        color.xyz = mix(color.xyz, backdrop(frame[0].background, gl_FragCoord.y), faded(away));
    }
}
