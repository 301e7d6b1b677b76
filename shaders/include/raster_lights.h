// Sums the lights of a frame over a surface. SHADOWED: with the first light's shadow map. Loops are written out: the
// default device's compiler unrolls none, and every round costs (docs/devices.md).
#ifndef DRAPE_RASTER_LIGHTS_H
#define DRAPE_RASTER_LIGHTS_H

layout(constant_id = 2) const int light_count = 2;

#ifdef SHADOWED
layout(set = 0, binding = 3, r32f) uniform readonly image2D shadow_map;

/// Weighted share of four texels in a row that are no nearer to the light than the surface, which `slope` tilts along
/// the row: a box filter of three texels, bilinear between them.
float lit_in_row(ivec2 first, float depth, float slope, vec4 weights) {
    vec4 nearest = vec4(imageLoad(shadow_map, first).x, imageLoad(shadow_map, first + ivec2(1, 0)).x,
                        imageLoad(shadow_map, first + ivec2(2, 0)).x, imageLoad(shadow_map, first + ivec2(3, 0)).x);
    return dot(weights, vec4(greaterThanEqual(nearest, depth + slope * vec4(0.0, 1.0, 2.0, 3.0))));
}

/// Share of the first light that reaches a point: 3x3 percentage-closer filter, bilinear between texels, each compared
/// with the plane of the surface above it (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC 2006), so
/// that large texels, which make shadows soft, need no wide gap. The point is moved off the surface by a texel. Beyond
/// the map there is light.
float visibility(vec3 world, vec3 normal) {
    vec3 to_light = frame[0].to_light[0].xyz;
    float texel_size = frame[0].ambient.w;
    float facing = dot(normal, to_light);
    vec3 off_surface = facing < 0.0 ? -normal : normal;
    vec3 at = shadow_position(world + (off_surface + to_light) * texel_size);
    // Depth runs from 0 to 1 over eight radii of the map, a texel is two radii over the number of texels.
    vec2 across = texel_size * vec2(dot(off_surface, frame[0].shadow_from_world[0].xyz),
                                    dot(off_surface, frame[0].shadow_from_world[1].xyz));
    vec2 slope = across / (max(abs(facing), 0.25) * 4.0 * float(shadow_map_size));
    vec2 corner = floor(at.xy - 1.5);
    vec2 part = at.xy - 1.5 - corner;
    ivec2 first = ivec2(corner);
    bool beyond = any(lessThan(first, ivec2(0))) || any(greaterThan(first + 3, ivec2(shadow_map_size - 1)));
    float depth = at.z + dot(corner + 0.5 - at.xy, slope);
    vec4 columns = vec4(1.0 - part.x, 1.0, 1.0, part.x);
    // A loop of no round skips the loads of pixels beyond the map; a branch would not on the default device.
    int rounds = beyond ? 0 : 1;
    float lit = 9.0;
    for (int round = 0; round < rounds; ++round)
        lit = (1.0 - part.y) * lit_in_row(first, depth, slope.x, columns) +
              lit_in_row(first + ivec2(0, 1), depth + slope.y, slope.x, columns) +
              lit_in_row(first + ivec2(0, 2), depth + 2.0 * slope.y, slope.x, columns) +
              part.y * lit_in_row(first + ivec2(0, 3), depth + 3.0 * slope.y, slope.x, columns);
    return lit / 9.0;
}
#else
float visibility(vec3 world, vec3 normal) { return 1.0; }
#endif

vec3 lit_by(int light, Surface surface) {
    return light_radiance(surface, frame[0].to_light[light].xyz, frame[0].light_radiance[light].xyz);
}

vec3 shaded(Surface surface, vec3 world) {
    vec3 radiance = ambient_radiance(surface, frame[0].ambient.xyz, frame[0].ground.xyz);
    if (light_count > 0) {
        vec3 arriving = frame[0].light_radiance[0].xyz * visibility(world, surface.normal);
        radiance += light_radiance(surface, frame[0].to_light[0].xyz, arriving);
        if (surface.gloss > 0.0) radiance += highlight_radiance(surface, frame[0].to_light[0].xyz, arriving);
    }
    if (light_count > 1) radiance += lit_by(1, surface);
    if (light_count > 2) radiance += lit_by(2, surface);
    if (light_count > 3) radiance += lit_by(3, surface);
    return radiance;
}

#endif
