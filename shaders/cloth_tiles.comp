// This pass marks the picture's tiles in which a cloth's triangles may be drawn, with an invocation per triangle. Where
// the cloth is `cut`, there are vertices on its cut springs, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"
#include "shared/cut_types.h"
#include "include/push.h"
#include "include/raster_frame.h"
#include "include/picture_tiles.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(ClothTilesPush)
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 2, std430) readonly buffer Triangles { uint triangles[]; };
layout(set = 0, binding = 3, std430) buffer Tiles { uint tiles[]; };
#include "include/cloth_vertex.h"

void main() {
    uint first = 3u * gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= push.grid.z) return;
    vec2 size = vec2(picture_width, picture_height), low = size, high = vec2(0.0);
    for (uint corner = 0u; corner < 3u; ++corner) {
        vec4 clip = clip_position(vertex_position(triangles[first + corner]));
        vec2 at = (0.5 * clip.xy / clip.w + 0.5) * size;
        // A triangle that reaches behind the eye may be visible anywhere.
        bool before = clip.w > 1e-6;
        low = min(low, before ? at : vec2(0.0));
        high = max(high, before ? at : size);
    }
    // A margin of a pixel at either side allows for rounding.
    ivec2 from = ivec2(clamp(low - 1.0, vec2(0.0), size - 1.0)) >> tile_shift;
    ivec2 to = ivec2(clamp(high + 1.0, vec2(0.0), size - 1.0)) >> tile_shift;
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) tiles[tile_at(ivec2(x, y))] = 1u;
}
