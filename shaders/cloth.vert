// A cloth's particles as vertices: the index buffer alone drives it, position and normal come from the images.
// CUT: and the vertices on its cut springs.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants CUT
#include "shared/raster_types.h"
#ifdef CUT
#include "shared/cut_types.h"
#endif
#include "include/raster_frame.h"

layout(push_constant) uniform Push { ClothPush push; };
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D normal;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 surface_normal;
layout(location = 2) out vec2 material;  // metres along columns, rows of the undeformed cloth
#include "include/cloth_vertex.h"

void main() {
    uint index = uint(gl_VertexIndex);
    uint particle = index;
    world = vertex_position(index);
#ifdef CUT
    if (is_cut_vertex(index)) particle = cut_vertex(index).particles.x;
#endif
    ivec2 texel = particle_texel(particle);
    surface_normal = imageLoad(normal, texel).xyz;
    material = vec2(texel) / (vec2(push.grid.xy) - 1.0) * push.size.xy;
#ifdef CUT
    if (is_cut_vertex(index)) material = cut_vertex(index).material.xy;
#endif
    gl_Position = clip_position(world);
}
