// Sums the lights of a frame on a surface; where `shadowed`, the first one through its shadow map. The code has no
// loops: the default device's compiler unrolls none, and every round costs time (docs/devices.md).
#ifndef DRAPE_RASTER_LIGHTS_H
#define DRAPE_RASTER_LIGHTS_H

#include "include/raster_frame.h"

layout(constant_id = 2) const int light_count = 2;
layout(constant_id = 3) const bool constants_by_triangle = true;
layout(location = lit_location) flat in LitConstants triangle_constants;
LitConstants constants = constants_by_triangle ? triangle_constants : lit_constants();

layout(constant_id = 25) const bool shadowed = false;
#include "include/shadow_map.h"

/// Returns the share of the first light that reaches a point, which is moved off the surface by a texel.
float visibility(vec3 world, vec3 normal) {
    if (!shadowed) return 1.0;
    vec3 to_light = constants.to_light[0].xyz;
    float texel_size = constants.ambient.w;
    float facing = dot(normal, to_light);
    vec3 off_surface = facing < 0.0 ? -normal : normal;
    vec3 at = shadow_position(constants.shadow_from_world, world + (off_surface + to_light) * texel_size);
    vec2 across = texel_size * vec2(dot(off_surface, constants.shadow_from_world[0].xyz),
                                    dot(off_surface, constants.shadow_from_world[1].xyz));
    return light_arriving(at, across / (max(abs(facing), 0.25) * shadow_texels_per_depth));
}

vec3 lit_by(int light, Surface surface) {
    return light_radiance(surface, constants.to_light[light].xyz, constants.light_radiance[light].xyz);
}

vec3 shaded(Surface surface, vec3 world) {
    float rise = constants.ground.w > 0.0 ? surface.normal.z : surface.normal.y;
    vec3 radiance = ambient_radiance(surface, rise, constants.ambient.xyz, constants.ground.xyz);
    if (light_count > 0) {
        vec3 arriving = constants.light_radiance[0].xyz * visibility(world, surface.normal);
        radiance += light_radiance(surface, constants.to_light[0].xyz, arriving);
        if (surface.spread < 1.0) radiance += highlight_radiance(surface, constants.to_light[0].xyz, arriving);
    }
    if (light_count > 1) radiance += lit_by(1, surface);
    if (light_count > 2) radiance += lit_by(2, surface);
    if (light_count > 3) radiance += lit_by(3, surface);
    return radiance;
}

#endif
