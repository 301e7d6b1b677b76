// Sums the lights of a frame over a surface. SHADOWED: with the first light's shadow map. Loops are written out: the
// default device's compiler unrolls none, and every round costs (docs/devices.md).
#ifndef DRAPE_RASTER_LIGHTS_H
#define DRAPE_RASTER_LIGHTS_H

layout(constant_id = 2) const int light_count = 2;

/// The backdrop behind a pixel: the scene's background at the picture's bottom, a tenth darker at its top.
vec3 backdrop(float pixel_y) { return frame[0].background.xyz * (0.9 + 0.1 * pixel_y / frame[0].background.w); }

#ifdef SHADOWED
layout(set = 0, binding = 3, r32f) uniform readonly image2D shadow_map;

/// Weighted share of four texels in a row that are no nearer to the light than `depth`.
float lit_in_row(ivec2 first, float depth, vec4 weights) {
    vec4 nearest = vec4(imageLoad(shadow_map, first).x, imageLoad(shadow_map, first + ivec2(1, 0)).x,
                        imageLoad(shadow_map, first + ivec2(2, 0)).x, imageLoad(shadow_map, first + ivec2(3, 0)).x);
    return dot(weights, vec4(greaterThanEqual(nearest, vec4(depth))));
}

/// Share of the first light that reaches a point: 3x3 percentage-closer filter, bilinear between texels. The
/// point is moved off the surface towards the light by about the filter's half width, so that a surface does
/// not shade itself. Beyond the map there is light.
float visibility(vec3 world, vec3 normal) {
    vec3 to_light = frame[0].to_light[0].xyz;
    float facing = dot(normal, to_light);
    vec3 off_surface = facing < 0.0 ? -normal : normal;
    vec3 at = shadow_position(world + (2.5 * off_surface + to_light) * frame[0].ambient.w);
    vec2 corner = floor(at.xy - 1.5);
    vec2 part = at.xy - 1.5 - corner;
    ivec2 first = ivec2(corner);
    bool beyond = any(lessThan(first, ivec2(0))) || any(greaterThan(first + 3, ivec2(shadow_map_size - 1)));
    vec4 columns = vec4(1.0 - part.x, 1.0, 1.0, part.x);
    // A loop of no round skips the loads of pixels beyond the map; a branch would not on the default device.
    int rounds = beyond ? 0 : 1;
    float lit = 9.0;
    for (int round = 0; round < rounds; ++round)
        lit = (1.0 - part.y) * lit_in_row(first, at.z, columns) + lit_in_row(first + ivec2(0, 1), at.z, columns) +
              lit_in_row(first + ivec2(0, 2), at.z, columns) + part.y * lit_in_row(first + ivec2(0, 3), at.z, columns);
    return lit / 9.0;
}
#else
float visibility(vec3 world, vec3 normal) { return 1.0; }
#endif

vec3 lit_by(int light, Surface surface, float visible) {
    return light_radiance(surface, frame[0].to_light[light].xyz, frame[0].light_radiance[light].xyz * visible);
}

vec3 shaded(Surface surface, vec3 world) {
    vec3 radiance = ambient_radiance(surface, frame[0].ambient.xyz);
    if (light_count > 0) radiance += lit_by(0, surface, visibility(world, surface.normal));
    if (light_count > 1) radiance += lit_by(1, surface, 1.0);
    if (light_count > 2) radiance += lit_by(2, surface, 1.0);
    if (light_count > 3) radiance += lit_by(3, surface, 1.0);
    return radiance;
}

#endif
