// Draws a cloth as the first light sees it, with the vertices on its cut springs where it is `cut`.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/cut_types.h"
#include "include/raster_frame.h"
#include "include/shadow_clip.h"
layout(push_constant) uniform Push { ClothPush push; };
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
#include "include/cloth_vertex.h"

void main() { gl_Position = shadow_clip(vertex_position(uint(gl_VertexIndex))); }
