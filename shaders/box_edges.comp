// Leads what is drawn between particles out of boxes' edges and corners (include/box_edges.h). What is found goes into
// an image of its own, as particles read their neighbours; the collision pass that follows takes it from there.
// MASKED: the cell image says which triangles exist (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED BUFFERED
#include "shared/simulation_types.h"
#include "include/box_edges.h"
#include "include/triangles.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 16) const bool again = false;  // the second round
layout(constant_id = 17) const int strip_rows = 1;  // particles of a column that an invocation looks after, 32 at most
layout(push_constant) uniform Push { CollisionPush push; };
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;  // again: as the first round left it
VECTOR_OUT(2, LiftedOut, lifted);
#ifdef MASKED
layout(set = 0, binding = 3, r32ui) uniform readonly uimage2D cells;
#endif

CutCorner corner_at(ivec2 texel, ColliderRecord collider) {
    vec4 start = LOAD(position, texel);
    vec3 moved = LOAD(displacement, texel).xyz;
    return CutCorner(local_point(collider, moved_position(start.xyz, moved)), moved, start.w);
}

bool exists(ivec2 cell, int which) {
    if (!cell_inside(cell, push.grid)) return false;
#ifdef MASKED
    return (imageLoad(cells, placed_cell(cell)).x & uint(which)) != 0u;
#else
    return true;
#endif
}

/// Which particles of a strip may meet an edge of a box: bit k is row k.
uint near_rows(int column, int first, int count) {
    uint rows = 0u;
    float reach = push.contact.x;
    for (int i = spheres_end; i < boxes_end; ++i) {
        ColliderRecord collider = colliders[push.first + i];
        vec3 half_extents = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
        for (int k = 0; k < count; ++k) {
            vec4 start = LOAD(position, ivec2(column, first + k));
            vec3 moved = LOAD(displacement, ivec2(column, first + k)).xyz;
            vec3 local = local_point(collider, moved_position(start.xyz, moved));
            bool near = start.w != 0.0f && near_box_edge(local, half_extents, reach);
            rows |= near ? 1u << k : 0u;
        }
    }
    return rows;
}

/// xyz: displacement of a particle after all boxes, w: 1 where one led it.
vec4 led_by_boxes(ivec2 texel) {
    vec4 start = LOAD(position, texel);
    vec4 before = LOAD(displacement, texel);
    vec3 moved = before.xyz;
    bool touched = again && before.w > 0.0f;
    for (int i = spheres_end; i < boxes_end; ++i) {
        ColliderRecord collider = colliders[push.first + i];
        vec3 local = local_point(collider, moved_position(start.xyz, moved));
        vec3 half_extents = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
        vec3 taken = vec3(0.0f, 0.0f, 0.0f);
        int count = near_box_edge(local, half_extents, push.contact.x) ? triangles_around_particle : 0;
        for (int k = 0; k < count; ++k) {
            ivec4 around = triangle_around(k);
            ivec2 cell = texel + around.xy;
            if (!exists(cell, around.z)) continue;
            int own = corner_of_triangle(around.z, -around.xy);
            ivec2 next = cell + triangle_corner(around.z, own == 2 ? 0 : own + 1);
            ivec2 last = cell + triangle_corner(around.z, own == 0 ? 2 : own - 1);
            taken = with_triangle(taken, CutCorner(local, moved, start.w), corner_at(next, collider),
                                  corner_at(last, collider), collider, push.contact.w);
        }
        vec3 led = taken_displacement(moved, taken, local, collider, push.contact.y);
        touched = touched || ordered_dot(taken, taken) > 0.0f;
        moved = led;
    }
    return vec4(moved, touched ? 1.0f : 0.0f);
}

void main() {
    int column = int(gl_GlobalInvocationID.x), first = int(gl_GlobalInvocationID.y) * strip_rows;
    if (column >= push.grid.x || first >= push.grid.y) return;
    int count = push.grid.y - first < strip_rows ? push.grid.y - first : strip_rows;
    for (int k = 0; k < count; ++k) {
        ivec2 texel = ivec2(column, first + k);
        vec4 moved = LOAD(displacement, texel);
        STORE_VECTOR(lifted, texel, vec4(moved.xyz, again ? moved.w : 0.0f));
    }
    // The default device runs a loop's body at least once for all lanes: here once for a strip, not for a particle.
    for (uint rows = near_rows(column, first, count); rows != 0u; rows &= rows - 1u) {
        ivec2 texel = ivec2(column, first + findLSB(rows));
        STORE_VECTOR(lifted, texel, led_by_boxes(texel));
    }
}
