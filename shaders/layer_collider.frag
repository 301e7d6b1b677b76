// Writes what is seen of a collider: its depth, the normal of the side in view, and its id.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/layer.h"

layout(location = 0) in vec3 surface_normal;
layout(location = 1) in vec3 to_eye;
layout(location = 2) flat in uint id;
layout(location = 0) out uvec4 pixel;

void main() {
    // A plane and an open mesh are seen from both sides.
    vec3 normal = dot(surface_normal, to_eye) < 0.0 ? -surface_normal : surface_normal;
    pixel = layer_pixel(normalize(normal), id, 0.0);
}
