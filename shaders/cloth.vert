// A cloth's particles as vertices: the index buffer alone drives it, position and normal come from the images.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"
layout(push_constant) uniform Push { ClothPush push; };
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D normal;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 surface_normal;
layout(location = 2) out vec2 material;  // metres along columns, rows of the undeformed cloth

void main() {
    int columns = int(push.grid.x);
    ivec2 texel = ivec2(gl_VertexIndex % columns, gl_VertexIndex / columns);
    world = imageLoad(position, texel).xyz;
    surface_normal = imageLoad(normal, texel).xyz;
    material = vec2(texel) / (vec2(push.grid.xy) - 1.0) * push.size.xy;
    gl_Position = clip_position(world);
}
