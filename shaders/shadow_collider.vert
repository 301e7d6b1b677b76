// Draws colliders as the first light sees them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/collider_types.h"
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shadow_clip.h"
#include "include/collider_mesh.h"

void main() {
    ColliderInstance collider = colliders[gl_InstanceIndex];
    gl_Position = shadow_clip(placed(collider, mesh_vertex(collider, gl_VertexIndex).position));
}
