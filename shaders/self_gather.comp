// This pass lays a cloth's particles on the sheet, as they are at this point of a substep. MASKED takes the triangles
// that exist from an image (holes, cuts). SUPPORTED also lays there the surfaces that they lie on.
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED SUPPORTED BUFFERED
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
PUSH_CONSTANTS(SelfClothPush)
#define STATE_COLUMNS push.columns
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
// These two are of the sheet, where those of other cloths stay.
VECTOR_KEPT(2, Positions, positions);
VECTOR_KEPT(3, Displacements, displacements);
#ifdef MASKED
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D cells;
#endif

#ifdef SUPPORTED
layout(set = 0, binding = 5, rgba32f) uniform image2D support;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D support_grip;
layout(set = 0, binding = 7, std430) writeonly buffer Supports { vec4 supports[]; };
#endif

bool exists(ivec2 cell, int which) {
    if (!cell_inside(cell, push.grid)) return false;
#ifdef MASKED
    return (imageLoad(cells, cell).x & uint(which)) != 0u;
#else
    return true;
#endif
}

/// Returns bits of the primitives that a particle owns and that exist: two triangles, then three edges.
uint owned(ivec2 texel) {
    uint bits = (exists(texel, 1) ? 1u : 0u) | (exists(texel, 2) ? 2u : 0u);
    for (int k = 0; k < 3; ++k) {
        ivec4 one = self_edge_owner(k, 0), other = self_edge_owner(k, 1);
        bool is_edge = exists(texel + ivec2(one.x, one.y), one.z) || exists(texel + ivec2(other.x, other.y), other.z);
        bits |= is_edge ? 4u << k : 0u;
    }
    return bits;
}

void lay(ivec2 texel) {
    ivec2 laid = push.first + texel;
    STORE_VECTOR(positions, laid, imageLoad(position, texel));
    vec3 moved = imageLoad(displacement, texel).xyz;
    STORE_VECTOR(displacements, laid, vec4(moved, float(owned(texel))));
#ifdef SUPPORTED
    // It is taken back, as this substep's last collision says where a particle lies then.
    vec4 plane = imageLoad(support, texel);
    int at = 2 * (laid.y * push.columns + laid.x);
    supports[at] = plane;
    supports[at + 1] = imageLoad(support_grip, texel);
    if (plane.x != 0.0f || plane.y != 0.0f || plane.z != 0.0f) imageStore(support, texel, vec4(0.0f));
#endif
}

void main() { FOR_STRIP(texel, push.grid, lay(texel)) }
