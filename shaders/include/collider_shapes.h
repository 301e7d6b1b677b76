// Points on the colliders' true shapes, in local coordinates: the corners of the triangles in pictures, and the
// vertices of exported meshes.
#ifndef DRAPE_COLLIDER_SHAPES_H
#define DRAPE_COLLIDER_SHAPES_H

#include "shared/collider_types.h"

#ifdef __cplusplus
#include <algorithm>

namespace drape::glsl {
using std::acos;
using std::clamp;
using std::cos;
using std::max;
using std::sin;
#endif

struct MeshVertex {
    vec3 position;
    vec3 normal;  // any length
};

/// Returns the corner (0 or 1 along each axis) of vertex 0..5 of a quad's two triangles, counter-clockwise.
SHARED ivec2 quad_corner(int vertex) {
    return ivec2(vertex == 1 || vertex == 2 || vertex == 4 ? 1 : 0, vertex == 2 || vertex == 4 || vertex == 5 ? 1 : 0);
}

/// Returns where a vertex of a round mesh is, in segments around (x) and from pole to pole (y). Seen from outside the
/// triangles are counter-clockwise, though rows are counted downwards.
SHARED ivec2 round_corner(int columns, int vertex) {
    int quad = vertex / 6;
    ivec2 corner = quad_corner(vertex % 6);
    return ivec2(quad % columns + corner.y, quad / columns + corner.x);
}

/// Returns the unit vector at two angles, radians; y is the axis.
SHARED vec3 round_direction(float polar, float azimuth) {
    return vec3(sin(polar) * sin(azimuth), cos(polar), sin(polar) * cos(azimuth));
}

/// The mesh of an ellipsoid has `columns` columns and half as many rows.
SHARED MeshVertex ellipsoid_vertex(vec3 radii, ivec2 corner, int columns) {
    const float pi = 3.14159265358979f;
    float polar = pi * float(corner.y) / float(columns / 2);
    float azimuth = 2.0f * pi * float(corner.x) / float(columns);
    vec3 unit = round_direction(polar, azimuth);
    return MeshVertex(unit * radii, unit / radii);
}

/// The rows of a capsule are the upper ball from its pole to where the side touches it, the side in one step, and the
/// lower ball.
SHARED MeshVertex capsule_vertex(vec3 size, ivec2 corner, int columns) {
    const float pi = 3.14159265358979f;
    int rows = columns / 2;
    float touching = acos(clamp((size.y - size.z) / max(2.0f * size.x, 1.0e-20f), -1.0f, 1.0f));
    bool upper = corner.y <= rows / 2;
    float polar = upper ? touching * float(corner.y) / float(rows / 2)
                        : pi - (pi - touching) * float(rows - corner.y) / float(rows / 2 - 1);
    float azimuth = 2.0f * pi * float(corner.x) / float(columns);
    vec3 unit = round_direction(polar, azimuth);
    vec3 center = vec3(0.0f, upper ? size.x : -size.x, 0.0f);
    return MeshVertex(center + unit * (upper ? size.z : size.y), unit);
}

SHARED MeshVertex box_vertex(vec3 half_extents, int vertex) {
    int face = vertex / 6;
    int axis = face / 2;
    float side = face % 2 == 0 ? 1.0f : -1.0f;
    ivec2 corner = quad_corner(vertex % 6);
    float along = (float(corner.x) * 2.0f - 1.0f) * side, across = float(corner.y) * 2.0f - 1.0f;
    if (axis == 0) return MeshVertex(vec3(side, along, across) * half_extents, vec3(side, 0.0f, 0.0f));
    if (axis == 1) return MeshVertex(vec3(across, side, along) * half_extents, vec3(0.0f, side, 0.0f));
    return MeshVertex(vec3(along, across, side) * half_extents, vec3(0.0f, 0.0f, side));
}

/// Local y is the plane's normal; the square's centre is at `center`, in local x and z.
SHARED MeshVertex plane_vertex(float half_side, vec2 center, int vertex) {
    ivec2 corner = quad_corner(vertex);
    float x = center.x + (float(corner.x) * 2.0f - 1.0f) * half_side;
    float z = center.y + (float(corner.y) * 2.0f - 1.0f) * half_side;
    return MeshVertex(vec3(x, 0.0f, z), vec3(0.0f, 1.0f, 0.0f));
}

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
