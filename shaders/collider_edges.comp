// This pass moves the cloth's edges and triangles out of edges and corners of boxes and meshes
// (include/collider_edges.h). It writes to an image of its own, since particles read their neighbours; the collision
// pass that follows starts from that image. Where `masked`, the cell image says which triangles exist (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/simulation_types.h"
#include "include/collider_edges.h"
#include "include/push.h"
#include "include/skin.h"
#include "include/triangles.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 16) const bool again = false;  // this is the second round
layout(constant_id = 17) const int strip_rows = 1;  // particles of a column that an invocation processes, 32 at most
CLOTH_CONSTANTS(CollisionPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;  // second round: as the first left it
VECTOR_OUT(2, lifted);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, r32ui) uniform readonly uimage2D cells;

CutCorner corner_at(ivec2 texel, ColliderRecord collider) {
    vec4 start = LOAD(position, texel);
    vec3 moved = LOAD(displacement, texel).xyz;
    return CutCorner(local_point(collider, moved_position(start.xyz, moved)), moved, start.w);
}

bool exists(ivec2 cell, int which) {
    if (!cell_inside(cell, push.grid)) return false;
    if (masked) return (imageLoad(cells, placed_cell(cell)).x & uint(which)) != 0u;
    return true;
}

/// Records of at most this many boxes are read before anything has branched (include/contacts.h).
const int early_box_count = 4;
ColliderRecord early_boxes[early_box_count];
void read_boxes() {
    [[unroll]] for (int i = 0; i < early_box_count; ++i) {
        if (spheres_end + i < boxes_end) early_boxes[i] = colliders[push.first + spheres_end + i];
    }
}
#define EACH_BOX(WORK)                                                                                   \
    [[unroll]] for (int i = 0; i < min(boxes_end - spheres_end, early_box_count); ++i) {                 \
        WORK(early_boxes[i], spheres_end + i)                                                            \
    }                                                                                                    \
    if (boxes_end - spheres_end > early_box_count) { /* else lavapipe does not leave the loop out */     \
        for (int i = spheres_end + early_box_count; i < boxes_end; ++i) { WORK(colliders[push.first + i], i) }\
    }

bool near_edge_of(ColliderRecord collider, vec3 now) {
    return near_box_edge(local_point(collider, now), vec3(collider.shape.x, collider.shape.y, collider.shape.z),
                         push.contact.x);
}

/// Returns whether an edge leads from a particle below the plane that touches a mesh at its nearest point. Most
/// particles lie on a surface that is flat or bulges the other way; without this test the default device would process
/// six triangles for each of them.
bool leads_into(ColliderRecord collider, ivec2 texel, vec3 now) {
    vec3 local = local_point(collider, now);
    vec4 plane = touching_plane(local, true_mesh(collider));
    bool below = false;
    int k = 0;
    do {
        ivec2 other = min(max(texel + edge_around(k), ivec2(0)), push.grid - 1);
        below = below || leads_below(local, corner_at(other, collider).local, plane);
        ++k;
    } while (k < edges_around_particle);
    return below && near_mesh(local, plane, collider, push.contact.x);
}

#define NEAR_EDGE(collider, number) near = near || near_edge_of(collider, now);
/// Returns whether a particle may meet an edge of a box or a mesh. In the second round only particles may that were
/// near one in the first, since the first round moved no others.
bool may_meet(ivec2 texel, vec4 start, vec4 moved) {
    bool near = again && moved.w != 0.0f;
    vec3 now = moved_position(start.xyz, moved.xyz);
    if (!again) {
        EACH_BOX(NEAR_EDGE)
    }
    if (has_meshes) {
        for (int i = capsules_end; i < meshes_end; ++i)
            near = near || leads_into(colliders[push.first + i], texel, now);
    }
    return near && start.w != 0.0f;
}

/// Writes the particles of a strip unchanged. Returns those that may meet an edge: bit k is row k.
uint copy_strip(int column, int first, int count) {
    uint rows = 0u;
    int k = 0;
    do {  // loops have their tests at the bottom (include/every.h)
        ivec2 texel = ivec2(column, first + k);
        vec4 moved = LOAD(displacement, texel);
        bool near = may_meet(texel, LOAD(position, texel), moved);
        STORE_VECTOR(lifted, texel, vec4(moved.xyz, again ? moved.w : 0.0f));
        rows |= near ? 1u << k : 0u;
        ++k;
    } while (k < count);
    return rows;
}

struct Led {
    vec3 moved;  // displacement of a particle, m
    float by;    // 1 and the number of the collider that moved it last; 0: none did
};

/// Returns the place of a particle, or the place where the line from `far` through `end` goes on if there is none.
vec3 place_of(ivec2 texel, vec3 far, vec3 end, ColliderRecord collider) {
    bool is_there = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, push.grid));
    return is_there ? corner_at(texel, collider).local : mirrored(far, end);
}

EdgeLine line_of(ivec2 from, ivec2 to, vec3 a, vec3 b, ColliderRecord collider) {
    return EdgeLine(place_of(2 * from - to, b, a, collider), place_of(2 * to - from, a, b, collider));
}

/// Returns the normal of the cloth at a particle, of either sign, as rows and columns say.
vec3 normal_across(ivec2 texel, vec3 local, ColliderRecord collider) {
    ivec2 row = ivec2(1, 0), column = ivec2(0, 1);
    vec3 left = place_of(texel - row, place_of(texel + row, local, local, collider), local, collider);
    vec3 up = place_of(texel - column, place_of(texel + column, local, local, collider), local, collider);
    vec3 right = place_of(texel + row, left, local, collider), down = place_of(texel + column, up, local, collider);
    return unit_of(ordered_cross(direction_between(left, local, local, right),
                                 direction_between(up, local, local, down)));
}

/// The corners of a triangle from `texel` on, whose plane that touches a mesh is given.
Taken taken_by_triangle(Taken taken, ivec2 texel, ivec2 next, ivec2 last, CutCorner a, vec4 plane,
                        ColliderRecord collider, bool is_mesh) {
    CutCorner b = corner_at(next, collider), c = corner_at(last, collider);
    if (has_meshes)
        if (is_mesh) return with_mesh_triangle(taken, a, b, c, plane, collider, push.contact.w);
    return with_triangle(taken, a, b, c, line_of(texel, next, a.local, b.local, collider),
                         line_of(texel, last, a.local, c.local, collider), collider, push.contact.w);
}

Led led_by(ColliderRecord collider, int number, ivec2 texel, vec4 start, Led led, bool near, bool is_mesh) {
    vec3 local = local_point(collider, moved_position(start.xyz, led.moved));
    Taken taken = Taken(vec3(0.0f, 0.0f, 0.0f), 0.0f);
    vec4 plane = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    if (has_meshes)
        if (is_mesh) {
            plane = touching_plane(local, true_mesh(collider));
            near = near_mesh(local, plane, collider, push.contact.x);
        }
    int k = 0;
    do {
        ivec4 around = triangle_around(k);
        ivec2 cell = texel + around.xy;
        int own = corner_of_triangle(around.z, -around.xy);
        ivec2 next = cell + triangle_corner(around.z, own == 2 ? 0 : own + 1);
        ivec2 last = cell + triangle_corner(around.z, own == 0 ? 2 : own - 1);
        if (near && exists(cell, around.z))
            taken = taken_by_triangle(taken, texel, next, last, CutCorner(local, led.moved, start.w), plane, collider,
                                      is_mesh);
        ++k;
    } while (near && k < triangles_around_particle);
    vec3 surface = surface_displacement(collider, local);
    if (has_meshes)
        if (is_mesh) surface = mesh_displacement(collider, local);
    vec2 own = skin_of(placed(texel).y * push.grid.x + texel.x, push.contact.zy);
    vec3 moved = taken_displacement(led.moved, taken, surface, collider, own.y);
    bool touched = ordered_dot(taken.by, taken.by) > 0.0f;
    if (again && near && !is_mesh) {
        vec3 bent = bent_contact(collider, start.xyz, moved, normal_across(texel, local, collider), push.contact.x,
                                 own.x, own.y);
        touched = touched || bent != moved;
        moved = bent;
    }
    return Led(moved, touched ? float(number + 1) : led.by);
}

bool near_now(ColliderRecord collider, vec4 start, Led led) {
    return near_edge_of(collider, moved_position(start.xyz, led.moved));
}

#define LED_BY(collider, number) \
    led = led_by(collider, number, texel, start, led, near_now(collider, start, led), false);
/// Returns a particle's displacement after all boxes and meshes, with Led's `by` in w if one moved it, otherwise -1.
vec4 led_by_all(ivec2 texel) {
    vec4 start = LOAD(position, texel), before = LOAD(displacement, texel);
    Led led = Led(before.xyz, again && before.w > 0.0f ? before.w : 0.0f);
    EACH_BOX(LED_BY)
    if (has_meshes) {
        for (int i = capsules_end; i < meshes_end; ++i)
            led = led_by(colliders[push.first + i], i, texel, start, led, true, true);
    }
    return vec4(led.moved, led.by > 0.0f ? led.by : -1.0f);
}

void main() {
    push.first = given.first + push.list;
    read_boxes();
    int column = int(gl_GlobalInvocationID.x), first = int(gl_GlobalInvocationID.y) * strip_rows;
    if (column >= push.grid.x || first >= push.grid.y) return;
    int count = push.grid.y - first < strip_rows ? push.grid.y - first : strip_rows;
    // The default device runs a loop's body at least once for all lanes: here once for a strip instead of once for a
    // particle.
    uint rows = copy_strip(column, first, count);
    do {
        ivec2 texel = ivec2(column, first + max(findLSB(rows), 0));
        if (rows != 0u) STORE_VECTOR(lifted, texel, led_by_all(texel));
        rows &= max(rows, 1u) - 1u;
    } while (rows != 0u);
}
