// Draws a square over each tile in which something may be drawn, an instance per tile: to clear so much takes a fraction
// of what clearing attachments does (docs/devices.md).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/picture_tiles.h"

layout(set = 0, binding = 0, std430) readonly buffer Tiles { uint tiles[]; };

void main() {
    ivec2 tile = ivec2(gl_InstanceIndex % tile_counts.x, gl_InstanceIndex / tile_counts.x);
    int vertex = gl_VertexIndex;
    tile += ivec2(vertex == 1 || vertex == 2 || vertex == 4 ? 1 : 0, vertex == 2 || vertex == 4 || vertex == 5 ? 1 : 0);
    vec2 place = 2.0 * vec2(tile << tile_shift) / vec2(picture_width, picture_height) - 1.0;
    gl_Position = vec4(tiles[gl_InstanceIndex] != 0u ? place : vec2(2.0), 1.0, 1.0);
}
