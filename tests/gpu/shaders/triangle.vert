// Fetches corners from an image, as the cloth's are.
#version 460
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D corners;

void main() { gl_Position = vec4(imageLoad(corners, ivec2(gl_VertexIndex, 0)).xyz, 1.0); }
