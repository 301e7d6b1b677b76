// Draws colliders as their true shapes, one instance each, for layers: color.w of an instance is its id.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/collider_types.h"
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/collider_mesh.h"
layout(location = 0) out vec3 surface_normal;
layout(location = 1) out vec3 to_eye;
layout(location = 2) flat out uint id;

void main() {
    ColliderInstance collider = colliders[gl_InstanceIndex];
    MeshVertex mesh = mesh_vertex(collider, gl_VertexIndex);
    vec3 world = placed(collider, mesh.position);
    surface_normal = turned(collider, mesh.normal);
    to_eye = frame[0].eye.xyz - world;
    id = uint(collider.color.w);
    gl_Position = clip_position(world);
}
