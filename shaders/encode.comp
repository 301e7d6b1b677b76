// This pass computes the picture's bytes from its radiance, once per pixel, where an sRGB attachment would encode every
// sample. Backdrop and floor show where samples are uncovered, and are drawn only here, since triangles for them would
// cost twice as much. An ordered dither of one level (Bayer's 8 x 8 matrix) replaces rounding, which would show bands
// in soft gradients. Where `shadowed`, the floor is under the first light's shadow map. Where `sampled`, the pass
// averages four samples per pixel itself, since resolving them first takes the default device twice as long. Where the
// picture `has_alpha`, nothing is behind what is drawn: it is divided by the share of the pixel that it covers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/raster_frame.h"
#include "include/shadow_map.h"
#include "include/plane.h"
layout(constant_id = 25) const bool shadowed = false;
layout(constant_id = 2) const bool has_ground_shade = false;
layout(set = 0, binding = 5, rgba32f) uniform readonly imageBuffer ground_shade;
#include "include/floor.h"
#include "include/picture_tiles.h"
#include "include/tone.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool has_floor = true;
layout(constant_id = 1) const bool has_alpha = false;
PUSH_CONSTANTS(GridPush)  // pixels
#include "include/strips.h"
layout(constant_id = 24) const bool sampled = false;
layout(set = 0, binding = 1, rgba16f) uniform readonly image2D light;
layout(set = 0, binding = 1, rgba16f) uniform readonly image2DMS samples;
vec4 light_at(ivec2 pixel) {
    if (!sampled) return imageLoad(light, pixel);
    return 0.25 * ((imageLoad(samples, pixel, 0) + imageLoad(samples, pixel, 1)) +
                   (imageLoad(samples, pixel, 2) + imageLoad(samples, pixel, 3)));
}
layout(set = 0, binding = 2, std430) writeonly buffer Pixels { uint pixels[]; };  // on the host; red in the lowest byte

layout(set = 0, binding = 4, std430) readonly buffer Tiles { uint tiles[]; };

/// Returns Bayer's matrix at a pixel: 1/128 .. 127/128 in steps of 1/64.
float threshold(uvec2 pixel) {
    uvec2 bits = uvec2(pixel.x ^ pixel.y, pixel.y);
    uint rank = ((bits.x & 1u) << 5) | ((bits.y & 1u) << 4) | ((bits.x & 2u) << 2) | ((bits.y & 2u) << 1) |
                ((bits.x & 4u) >> 1) | ((bits.y & 4u) >> 2);
    return (float(rank) + 0.5) / 64.0;
}

/// Returns the sRGB transfer function, to 0.002 of a level: 1.055 x^(1/2.4) - 0.055 is replaced by the best polynomial
/// of the fifth degree in x^(1/4) for the range in use. A power would take the default device three times as long.
vec3 srgb(vec3 linear) {
    vec3 t = sqrt(sqrt(max(linear, 0.0031308)));
    vec3 curve = ((((-0.0681473613 * t + 0.289533198) * t - 0.577482998) * t + 1.25540459) * t + 0.162026227) * t;
    return mix(curve - 0.0613402128, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void encode(ivec2 pixel, vec4 background, FloorConstants plane) {
    bool seen = tiles[tile_at(pixel >> tile_shift)] != 0u;
    vec4 drawn = seen ? light_at(pixel) : vec4(0.0);  // w: the share of its samples that something covers
    vec2 middle = vec2(pixel) + 0.5;
    vec3 behind = backdrop(background, middle.y);
    if (has_floor) behind = floor_radiance(plane, middle, behind);
    vec3 radiance = drawn.xyz + (1.0 - drawn.w) * behind;
    if (has_alpha) radiance = drawn.xyz / max(drawn.w, 0.125);  // a sample of four covers at least twice as much
    radiance = vec3(toned(radiance.x), toned(radiance.y), toned(radiance.z));
    vec3 levels = 255.0 * srgb(clamp(radiance, 0.0, 1.0));
    ivec3 bytes = ivec3(min(levels + threshold(uvec2(pixel)), 255.0));
    int alpha = has_alpha ? int(255.0 * drawn.w + 0.5) : 0xff;
    pixels[pixel.y * push.grid.x + pixel.x] = uint(bytes.x | bytes.y << 8 | bytes.z << 16 | alpha << 24);
}

void main() {
    vec4 background = frame[0].background;
    FloorConstants plane = frame[0].floor;
    FOR_STRIP(pixel, push.grid, encode(pixel, background, plane))
}
