// Draws a cloth's surface, where `shadowed` under the first light's shadow map. The front is the side from which a
// triangle's corners run counter-clockwise, which is the side its normal cross(along columns, along rows) points to.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"

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

void main() {
    // Derivatives are taken before any branch, where they are defined.
    vec3 facet = cross(dFdy(world), dFdx(world));  // towards the eye
    float second = pattern();
    vec3 normal = gl_FrontFacing ? surface_normal : -surface_normal;
    // Neighbours that cancel out leave no normal; the triangle's own is better than none.
    if (dot(normal, normal) < 1e-6) normal = facet;
    vec3 albedo = mix(gl_FrontFacing ? look.front.xyz : look.back.xyz, look.second.xyz, second);
    float openness = 1.0 - (gl_FrontFacing ? hidden.x : hidden.y);
    Surface surface =
        Surface(albedo, normalize(normal), normalize(constants.eye.xyz - world), 0.2, 0.0, 0.3, openness);
    color = vec4(shaded(surface, world), 1.0);
}
