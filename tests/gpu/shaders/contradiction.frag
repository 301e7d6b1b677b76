// Declares another image at the binding of triangle.vert's.
#version 460
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D tints;
layout(location = 0) out vec4 color;

void main() { color = imageLoad(tints, ivec2(0)); }
