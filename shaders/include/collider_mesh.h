// Makes the vertices of the colliders' true shapes from gl_VertexIndex, in local coordinates.
#ifndef DRAPE_COLLIDER_MESH_H
#define DRAPE_COLLIDER_MESH_H

layout(constant_id = 0) const int collider_kind = kind_plane;
layout(constant_id = 1) const int round_columns = most_round_columns;
const int round_rows = round_columns / 2;
layout(set = 0, binding = 1, std430) readonly buffer Colliders { ColliderInstance colliders[]; };

struct MeshVertex {
    vec3 position;
    vec3 normal;  // any length
};

#ifdef MESH
layout(set = 0, binding = 2, std430) readonly buffer MeshCorners { MeshCorner mesh_corners[]; };
#endif

/// Corner (0 or 1 along each axis) of vertex 0..5 of a quad's two triangles, counter-clockwise.
ivec2 quad_corner(int vertex) {
    return ivec2(vertex == 1 || vertex == 2 || vertex == 4 ? 1 : 0, vertex == 2 || vertex == 4 || vertex == 5 ? 1 : 0);
}

/// Returns at which segment around (x) and from pole to pole (y) a vertex of a round mesh is. Seen from outside the
/// triangles run counter-clockwise, though rows are counted downwards.
ivec2 round_corner(int vertex) {
    int quad = vertex / 6;
    return ivec2(quad % round_columns, quad / round_columns) + quad_corner(vertex % 6).yx;
}

MeshVertex ellipsoid_vertex(vec3 radii, int vertex) {
    ivec2 corner = round_corner(vertex);
    const float pi = 3.14159265358979;
    float polar = pi * float(corner.y) / float(round_rows);
    float azimuth = 2.0 * pi * float(corner.x) / float(round_columns);
    vec3 unit = vec3(sin(polar) * sin(azimuth), cos(polar), sin(polar) * cos(azimuth));
    return MeshVertex(unit * radii, unit / radii);
}

MeshVertex box_vertex(vec3 half_extents, int vertex) {
    int face = vertex / 6;
    int axis = face / 2;
    float side = face % 2 == 0 ? 1.0 : -1.0;
    vec2 corner = vec2(quad_corner(vertex % 6)) * 2.0 - 1.0;
    vec3 normal = vec3(0.0);
    normal[axis] = side;
    vec3 unit = normal;
    unit[(axis + 1) % 3] = corner.x * side;
    unit[(axis + 2) % 3] = corner.y;
    return MeshVertex(unit * half_extents, normal);
}

/// Local y is the plane's normal.
MeshVertex plane_vertex(float half_side, vec2 center, int vertex) {
    vec2 corner = center + (vec2(quad_corner(vertex)) * 2.0 - 1.0) * half_side;
    return MeshVertex(vec3(corner.x, 0.0, corner.y), vec3(0.0, 1.0, 0.0));
}

/// A capsule's rows are the upper ball from its pole to where the side touches it, the side in one step, and the lower.
MeshVertex capsule_vertex(vec3 size, int vertex) {
    ivec2 corner = round_corner(vertex);
    const float pi = 3.14159265358979;
    float touching = acos(clamp((size.y - size.z) / max(2.0 * size.x, 1.0e-20), -1.0, 1.0));
    bool upper = corner.y <= round_rows / 2;
    float polar = upper ? touching * float(corner.y) / float(round_rows / 2)
                        : pi - (pi - touching) * float(round_rows - corner.y) / float(round_rows / 2 - 1);
    float azimuth = 2.0 * pi * float(corner.x) / float(round_columns);
    vec3 unit = vec3(sin(polar) * sin(azimuth), cos(polar), sin(polar) * cos(azimuth));
    vec3 center = vec3(0.0, upper ? size.x : -size.x, 0.0);
    return MeshVertex(center + unit * (upper ? size.z : size.y), unit);
}

MeshVertex mesh_vertex(ColliderInstance collider, int vertex) {
#ifdef MESH
    MeshCorner corner = mesh_corners[vertex];
    return MeshVertex(corner.position.xyz, corner.normal.xyz);
#endif
    if (collider_kind == kind_sphere) return ellipsoid_vertex(collider.shape.xxx, vertex);
    if (collider_kind == kind_ellipsoid) return ellipsoid_vertex(collider.shape.xyz, vertex);
    if (collider_kind == kind_capsule) return capsule_vertex(collider.shape.xyz, vertex);
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
