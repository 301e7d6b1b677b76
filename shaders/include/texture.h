// Looks up a cloth's texture, which lies in a buffer with all that are halved from it.
#ifndef DRAPE_TEXTURE_H
#define DRAPE_TEXTURE_H

layout(set = 0, binding = 6, std430) readonly buffer Textures {
    uint texels[];
};  // two each: three half floats, linear

vec3 texel_at(uint first, ivec2 size, ivec2 at) {
    ivec2 inside = clamp(at, ivec2(0), size - 1);
    uint place = 2u * (first + uint(inside.y * size.x + inside.x));
    return vec3(unpackHalf2x16(texels[place]), unpackHalf2x16(texels[place + 1u]).x);
}

/// Returns the colour between four texels of one of the levels. The levels before it have a third of the texels that
/// four times the first has more than it.
vec3 level_at(uvec4 place, vec2 uv, int level) {
    ivec2 size = ivec2(place.yz) >> level;
    uint before = (4u * place.y * place.z - ((4u * place.y * place.z) >> uint(2 * level))) / 3u;
    vec2 at = uv * vec2(size) - 0.5, corner = floor(at), part = at - corner;
    ivec2 first = ivec2(corner);
    uint start = place.x + before;
    return mix(mix(texel_at(start, size, first), texel_at(start, size, first + ivec2(1, 0)), part.x),
               mix(texel_at(start, size, first + ivec2(0, 1)), texel_at(start, size, first + ivec2(1, 1)), part.x),
               part.y);
}

/// Returns the colour at `uv`, from 0 to 1, of a texture whose `place` is ClothPush::texture, filtered as wide as a
/// pixel's `width` in uv (Williams, "Pyramidal Parametrics", 1983).
vec3 texture_at(uvec4 place, vec2 uv, vec2 width) {
    vec2 texels_wide = width * vec2(place.yz);
    float most = log2(float(min(place.y, place.z)));
    float level = clamp(log2(max(max(texels_wide.x, texels_wide.y), 1e-6)), 0.0, most);
    float finer = min(floor(level), max(most - 1.0, 0.0));
    int coarser = int(min(finer + 1.0, most));
    return mix(level_at(place, uv, int(finer)), level_at(place, uv, coarser), level - finer);
}

#endif
