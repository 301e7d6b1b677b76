// Sums the lights of a frame over a surface. SHADOWED: with the first light's shadow map.
#ifndef DRAPE_RASTER_LIGHTS_H
#define DRAPE_RASTER_LIGHTS_H

/// The backdrop behind a pixel: the scene's background at the picture's bottom, a tenth darker at its top.
vec3 backdrop(float pixel_y) { return frame[0].background.xyz * (0.9 + 0.1 * pixel_y / frame[0].background.w); }

#ifdef SHADOWED
layout(set = 0, binding = 3, r32f) uniform readonly image2D shadow_map;

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
    // Loops of no round skip the loads of pixels beyond the map; a branch would not on the default device.
    int rows = beyond ? 0 : 4;
    vec4 column_weight = vec4(1.0 - part.x, 1.0, 1.0, part.x);
    vec4 row_weight = vec4(1.0 - part.y, 1.0, 1.0, part.y);
    float lit = 0.0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < 4; ++column)
            if (imageLoad(shadow_map, first + ivec2(column, row)).x >= at.z)
                lit += column_weight[column] * row_weight[row];
    return beyond ? 1.0 : lit / 9.0;
}
#else
float visibility(vec3 world, vec3 normal) { return 1.0; }
#endif

vec3 shaded(Surface surface, vec3 world) {
    vec3 radiance = ambient_radiance(surface, frame[0].ambient.xyz);
    int light_count = int(frame[0].eye.w);
    for (int light = 0; light < light_count; ++light) {
        vec3 arriving = frame[0].light_radiance[light].xyz;
        if (light == 0) arriving *= visibility(world, surface.normal);
        radiance += light_radiance(surface, frame[0].to_light[light].xyz, arriving);
    }
    return radiance;
}

#endif
