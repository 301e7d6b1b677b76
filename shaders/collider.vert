// Draws colliders as their true shapes, one instance each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/collider_types.h"
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/collider_mesh.h"
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 surface_normal;
layout(location = 2) out vec2 on_plane;
layout(location = 3) flat out vec4 albedo;      // w: distance of the grid's lines on a plane
layout(location = lit_location) flat out LitConstants constants;

void main() {
    ColliderInstance collider = colliders[gl_InstanceIndex];
    MeshVertex mesh = mesh_vertex(collider, gl_VertexIndex);
    world = placed(collider, mesh.position);
    surface_normal = turned(collider, mesh.normal);
    on_plane = mesh.position.xz;
    albedo = vec4(collider.color.xyz, collider.shape.y);
    gl_Position = clip_position(world);
    gl_ClipDistance[0] = clip_distance(world, 0.0);
    constants = lit_constants();
}
