// Draws a cloth's surface, where `shadowed` under the first light's shadow map. The front is the side from which a
// triangle's corners run counter-clockwise, which is the side its normal cross(along columns, along rows) points to.
// What no cloth of the scene has, a highlight, threads, a hem or a texture, is left out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"
#include "include/fabric.h"
#include "include/texture.h"

layout(constant_id = 4) const bool glossy = false;
layout(constant_id = 5) const bool has_threads = false;
layout(constant_id = 6) const bool has_hem = false;
layout(constant_id = 7) const bool has_texture = false;
layout(push_constant) uniform Push { ClothPush push; };
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in vec2 material;
layout(location = 3) in vec2 hidden;
layout(location = look_location) flat in ClothLook triangle_look;
ClothLook look = constants_by_triangle ? triangle_look : cloth_look(push);
layout(location = 0) out vec4 color;

/// Mean of the square wave (+1 on even unit intervals, -1 on odd ones) over `width` around x.
float filtered_square_wave(float x, float width) {
    vec2 ends = vec2(x - 0.5 * width, x + 0.5 * width);
    vec2 integral = 1.0 - abs(mod(ends, 2.0) - 1.0);  // integral of the square wave from 0 on
    return clamp((integral.y - integral.x) / width, -1.0, 1.0);
}

/// Returns 0 where the first colour is, 1 where the second is, and a value between where a pixel holds both.
float pattern() {
    vec2 squares = material / look.front.w;
    vec2 width = max(fwidth(squares), vec2(1e-4));
    float across = filtered_square_wave(squares.x, width.x), along = filtered_square_wave(squares.y, width.y);
    float both = look.back.w == float(pattern_checker) ? across * along : across;
    return look.back.w == float(pattern_plain) ? 0.0 : 0.5 - 0.5 * both;
}

/// Returns the normal with the relief of threads and hem, and multiplies the colour by their shade.
vec3 with_relief(vec3 normal, inout vec3 albedo) {
    vec2 x = dFdx(material), y = dFdy(material), width = abs(x) + abs(y);
    float turn = x.x * y.y - x.y * y.x;
    float inverse = abs(turn) > 1e-20 ? 1.0 / turn : 0.0;
    vec3 along[2] = vec3[2]((dFdx(world) * y.y - dFdy(world) * x.y) * inverse,
                            (dFdy(world) * x.x - dFdx(world) * y.x) * inverse);
    Relief all = Relief(vec2(0.0), 1.0);
    if (has_threads && look.fabric.y > 0.0) {
        Relief threads = woven(material, width, look.fabric.y);
        all = Relief(all.slope + threads.slope, all.shade * threads.shade);
    }
    if (has_hem && look.fabric.z > 0.0) {
        Relief hem = hemmed(material, width, push.size.xy, look.fabric.z);
        all = Relief(all.slope + hem.slope, all.shade * hem.shade);
    }
    albedo *= all.shade;
    return tilted(normal, along, all.slope);
}

void main() {
    // Derivatives are taken before any branch, where they are defined.
    vec3 facet = cross(dFdy(world), dFdx(world));  // towards the eye
    float second = pattern();
    vec3 normal = gl_FrontFacing ? surface_normal : -surface_normal;
    // Neighbours that cancel out leave no normal; the triangle's own is better than none.
    if (dot(normal, normal) < 1e-6) normal = facet;
    normal = normalize(normal);
    vec3 albedo = mix(gl_FrontFacing ? look.front.xyz : look.back.xyz, look.second.xyz, second);
    if (has_texture) {
        vec2 uv = material / push.size.xy, width = fwidth(uv);
        // On the back the texture is as much darker as the plain colour is.
        if (push.texture.y > 0u && gl_FrontFacing) albedo = texture_at(push.texture, uv, width);
        if (push.texture.w > 0u && !gl_FrontFacing) albedo = texture_back * texture_at(push.texture, uv, width);
    }
    if (has_threads || has_hem) normal = normalize(with_relief(normal, albedo));
    float openness = 1.0 - (gl_FrontFacing ? hidden.x : hidden.y);
    Surface surface = Surface(albedo, normal, normalize(constants.eye.xyz - world), 0.2,
                              glossy ? look.fabric.x : 1.0, look.second.w, openness);
    color = vec4(shaded(surface, world), 1.0);
}
