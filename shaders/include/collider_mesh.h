// Makes the vertices of the colliders' true shapes from gl_VertexIndex, in local coordinates.
#ifndef DRAPE_COLLIDER_MESH_H
#define DRAPE_COLLIDER_MESH_H

#include "include/collider_shapes.h"

layout(constant_id = 0) const int collider_kind = kind_plane;
layout(constant_id = 1) const int round_columns = most_round_columns;
layout(set = 0, binding = 1, std430) readonly buffer Colliders { ColliderInstance colliders[]; };

layout(constant_id = 24) const bool is_mesh = false;  // its triangles come from a file
layout(set = 0, binding = 2, std430) readonly buffer MeshCorners { MeshCorner mesh_corners[]; };

#if COLLIDER_KINDS != 6
#error "mesh_vertex takes the new kind for a plane"
#endif
MeshVertex mesh_vertex(ColliderInstance collider, int vertex) {
    if (is_mesh) {
        MeshCorner corner = mesh_corners[vertex];
        return MeshVertex(corner.position.xyz, corner.normal.xyz);
    }
    ivec2 segment = round_corner(round_columns, vertex);
    if (collider_kind == kind_sphere) return ellipsoid_vertex(collider.shape.xxx, segment, round_columns);
    if (collider_kind == kind_ellipsoid) return ellipsoid_vertex(collider.shape.xyz, segment, round_columns);
    if (collider_kind == kind_capsule) return capsule_vertex(collider.shape.xyz, segment, round_columns);
    if (collider_kind == kind_box) return box_vertex(collider.shape.xyz, vertex);
    return plane_vertex(collider.shape.x, collider.shape.zw, vertex);
}

vec3 turned(ColliderInstance collider, vec3 local) {
    return vec3(dot(collider.pose_x.xyz, local), dot(collider.pose_y.xyz, local), dot(collider.pose_z.xyz, local));
}

vec3 placed(ColliderInstance collider, vec3 local) {
    return turned(collider, local) + vec3(collider.pose_x.w, collider.pose_y.w, collider.pose_z.w);
}

#endif
