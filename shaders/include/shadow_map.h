// Looks up in the shadow map which share of the first light arrives.
#ifndef DRAPE_SHADOW_MAP_H
#define DRAPE_SHADOW_MAP_H

#include "shared/raster_types.h"

// Each texel contains four texels of a row of the map (shadow_rows.comp).
layout(set = 0, binding = 3, rgba32f) uniform readonly imageBuffer shadow_rows;

/// Returns the weighted share of four texels in a row that are no nearer to the light than the surface, which `slope`
/// tilts along the row: a box filter of three texels, bilinear between them.
float lit_in_row(ivec2 first, float depth, float slope, vec4 weights) {
    vec4 nearest = imageLoad(shadow_rows, first.y * shadow_map_size + first.x);
    return dot(weights, vec4(greaterThanEqual(nearest, depth + slope * vec4(0.0, 1.0, 2.0, 3.0))));
}

/// Returns the share of the first light that arrives: a 3x3 percentage-closer filter, bilinear between texels, each
/// compared with the plane of the surface above it (Isidoro, "Shadow Mapping: GPU-based Tips and Techniques", GDC
/// 2006), so that large texels, which make shadows soft, need no wide gap. `at`: texel coordinates and depth in the
/// map; `slope`: change of the surface's depth from texel to texel. Beyond the map there is light.
float light_arriving(vec3 at, vec2 slope) {
    vec2 corner = floor(at.xy - 1.5);
    vec2 part = at.xy - 1.5 - corner;
    ivec2 wanted = ivec2(corner), first = clamp(wanted, ivec2(0), ivec2(shadow_map_size - 4));
    bool beyond = any(notEqual(wanted, first));
    float depth = at.z + dot(corner + 0.5 - at.xy, slope);
    vec4 columns = vec4(1.0 - part.x, 1.0, 1.0, part.x);
    // This is computed beyond the map, too: on the default device neither a branch nor a loop without rounds would skip
    // it.
    float lit = (1.0 - part.y) * lit_in_row(first, depth, slope.x, columns) +
                lit_in_row(first + ivec2(0, 1), depth + slope.y, slope.x, columns) +
                lit_in_row(first + ivec2(0, 2), depth + 2.0 * slope.y, slope.x, columns) +
                part.y * lit_in_row(first + ivec2(0, 3), depth + 3.0 * slope.y, slope.x, columns);
    return beyond ? 1.0 : lit / 9.0;
}

#endif
