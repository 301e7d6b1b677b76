// The frame's constants, the projection and the backdrop, which all raster shaders use.
#ifndef DRAPE_RASTER_FRAME_H
#define DRAPE_RASTER_FRAME_H

#include "include/lit_constants.h"

layout(set = 0, binding = 0, std430) readonly buffer Frame { FrameConstants frame[]; };

/// Returns the backdrop behind a pixel: the scene's background at the picture's bottom, a fifth darker at its top;
/// `background`: FrameConstants::background.
vec3 backdrop(vec4 background, float pixel_y) { return background.xyz * (0.8 + 0.2 * pixel_y / background.w); }

vec4 clip_position(vec3 world) {
    vec4 point = vec4(world, 1.0);
    return vec4(dot(frame[0].clip_from_world[0], point), dot(frame[0].clip_from_world[1], point),
                dot(frame[0].clip_from_world[2], point), dot(frame[0].clip_from_world[3], point));
}

/// Returns the value that vertices write to gl_ClipDistance. The floor is drawn behind everything else, so anything
/// deeper than `margin` below it must not be drawn.
float clip_distance(vec3 world, float margin) { return dot(frame[0].above_floor, vec4(world, 1.0)) + margin; }

/// Returns the depth as if the cloth were nearer to the eye by its thickness. Contact keeps particles off a collider by
/// this thickness, and a triangle between them cuts into it by no more.
float depth_of_thickness(vec3 at, float thickness, float clip_w) {
    vec3 to_eye = frame[0].eye.xyz - at;
    vec4 nearer = vec4(at + to_eye * min(thickness * inversesqrt(max(dot(to_eye, to_eye), 1e-30)), 0.5), 1.0);
    return dot(frame[0].clip_from_world[2], nearer) / dot(frame[0].clip_from_world[3], nearer) * clip_w;
}

/// Returns texel coordinates and depth in the shadow map; `rows`: FrameConstants::shadow_from_world.
vec3 shadow_position(vec4 rows[3], vec3 world) {
    vec4 point = vec4(world, 1.0);
    return vec3(dot(rows[0], point), dot(rows[1], point), dot(rows[2], point));
}

LitConstants lit_constants() {
    return LitConstants(frame[0].eye, frame[0].ambient, frame[0].ground, frame[0].to_light, frame[0].light_radiance,
                        frame[0].shadow_from_world);
}

#endif
