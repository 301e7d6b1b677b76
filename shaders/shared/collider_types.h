// Collider kinds, and a collider of any kind as contact and pictures see it, in std430.
#ifndef DRAPE_COLLIDER_TYPES_H
#define DRAPE_COLLIDER_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Contacts are resolved in the order of the kinds; lists of colliders are sorted by it.
const int kind_plane = 0;
const int kind_sphere = 1;
const int kind_box = 2;
const int kind_ellipsoid = 3;
const int kind_capsule = 4;
const int kind_mesh = 5;
/// GLSL does not tell which function leaves a kind out. Each file whose functions tell kinds apart therefore compiles
/// for this number of kinds alone, and its #error names them. It is also the number of C++'s kinds (ColliderShape).
#define COLLIDER_KINDS 6
const int collider_kind_count = COLLIDER_KINDS;

/// A collider at the end of one substep. The rotation's rows are world from local, their w is the centre; `change` is
/// this pose minus the pose one substep earlier (computed in double on the host, so a collider at rest has exact zeros
/// there and friction against it cannot creep).
struct ColliderRecord {
    vec4 pose_x, pose_y, pose_z;
    vec4 change_x, change_y, change_z;
    vec4 shape;  // plane: world normal; sphere: radius in x; box: half extents; ellipsoid: radii; capsule, along its y:
                 // half length, radius at the lower end, at the upper; mesh: half extents of its bounding box. w:
                 // sqrt(friction)
    vec4 way_out;  // xyz: outward normal, in its frame, of the face by which cloth leaves a box that it started in;
                   // zero: by the nearest one. Mesh: x: first texel of its field, y: how far outside its surface
                   // contact takes it, m, z: the share of the frame that is over when the substep ends. w: what none
                   // of its surface moves farther than in the substep, m
};

/// Distances to a mesh (mesh/distance_field.h) as texels: the first sample's place in the mesh's frame and the spacing,
/// m; the number of samples along x, y, z; then, for every sample, x fastest, then y, then z, it and those one farther
/// along y, along z, along both, m. Two texels are then a cell. Of a mesh that deforms, the second texel's w is the
/// share of the frame that a substep is, and each sample has three texels: such distances when the frame begins, such
/// when it ends, and how far the surface nearest to the sample moves in the frame, on average of the surface nearest at
/// its begin and at its end, in the mesh's frame, m.
const int field_head = 2;
const int moving_point_texels = 3;

/// The surface that a particle lies on. Contact between cloths needs the whole law of it: told of less, a heap takes
/// what the floor gives its lowest particles, friction above all, for motion, and never rests.
struct Support {
    vec4 plane;  // xyz: normal, zero where there is no surface; w: displacement along it with which it is touched, m
    vec4 grip;   // xyz: displacement of the surface, m; w: friction coefficient
};

struct ColliderInstance {
    vec4 pose_x, pose_y, pose_z;  // rows of world from local; w: centre
    vec4 shape;                   // xyz as in the record; plane: half side of the quad drawn, distance of the grid's
                                  // lines, local x and z of the quad's centre
    vec4 color;
};

/// A corner of a triangle of a mesh as pictures draw it, in the mesh's frame.
struct MeshCorner {
    vec4 position, normal;  // xyz: m; unit
};

/// Most segments around a round mesh; from pole to pole it has half as many.
const int most_round_columns = 96;

#if COLLIDER_KINDS != 6
#error "mesh_vertex_count takes the new kind for a round one; ColliderRecord and ColliderInstance say what its shape is"
#endif
/// Vertices of a kind's mesh (include/collider_mesh.h), six for each quad; a mesh from a file has its own.
SHARED int mesh_vertex_count(int kind, int round_columns) {
    if (kind == kind_plane) return 6;
    if (kind == kind_box) return 36;
    return 6 * round_columns * (round_columns / 2);
}

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
