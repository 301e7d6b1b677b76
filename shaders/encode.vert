// One triangle over the whole picture. What the encoding reads of the frame's constants goes with it: to a fragment a
// flat input is one value, while the default device's compiler loads a buffer's constants lane by lane.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"

layout(location = 0) flat out vec4 background;
layout(location = 1) flat out FloorConstants plane;

void main() {
    gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.0, 1.0);
    background = frame[0].background;
    plane = frame[0].floor;
}
