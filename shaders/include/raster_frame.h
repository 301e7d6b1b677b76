// What the raster shaders share: the frame's constants, projection, lights, backdrop.
#ifndef DRAPE_RASTER_FRAME_H
#define DRAPE_RASTER_FRAME_H

layout(set = 0, binding = 0, std430) readonly buffer Frame { FrameConstants frame[]; };

vec4 clip_position(vec3 world) {
    vec4 point = vec4(world, 1.0);
    return vec4(dot(frame[0].clip_from_world[0], point), dot(frame[0].clip_from_world[1], point),
                dot(frame[0].clip_from_world[2], point), dot(frame[0].clip_from_world[3], point));
}

/// Texel coordinates and depth in the shadow map.
vec3 shadow_position(vec3 world) {
    vec4 point = vec4(world, 1.0);
    return vec3(dot(frame[0].shadow_from_world[0], point), dot(frame[0].shadow_from_world[1], point),
                dot(frame[0].shadow_from_world[2], point));
}

#endif
