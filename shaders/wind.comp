// This pass finds the force of the wind: each particle gathers a third of the force, and of the drag, on each of its up
// to six triangles. An invocation goes down some adjacent columns of particles and hands the triangles between two rows
// on to the lower one, so that most are computed once and not for each of their corners. Every sum keeps the order of
// triangle_around. Where `masked`, the cell image says which triangles exist (holes, cuts). Where gravity changes, what
// it is more than at the start is a force here, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/triangles.h"
#include "include/wind.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;    // the positions lack the last substep's displacement
layout(constant_id = 1) const bool weighs = false;     // each wind is followed by the change of gravity since the start
layout(constant_id = 20) const int strip_rows = 1;     // rows that an invocation processes
layout(constant_id = 21) const int strip_columns = 1;  // columns that it processes, most_columns at most
const int most_columns = 2;
CLOTH_CONSTANTS(WindPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
VECTOR_OUT(2, wind_force);
layout(set = 0, binding = 3, std430) readonly buffer Wind { vec4 wind[]; };
layout(constant_id = 24) const bool masked = false;
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D cells;

struct Member {
    vec3 position, displacement;
};
/// A row of the invocation's particles, with the one before and the one after them.
struct Row {
    Member members[most_columns + 2];
};
/// The force that the triangles between two rows give to each of their corners. Cells are counted from the one before
/// the invocation's first particle.
struct Shares {
    WindForce upper[most_columns + 1], lower[most_columns + 1];
};

vec3 wind_velocity, more_gravity;
int first_column;

/// Loads a row; past the grid's border, the row on the border again.
Row load_row(int y) {
    Row row;
    for (int c = 0; c < strip_columns + 2; ++c) {
        ivec2 at = max(min(ivec2(first_column - 1 + c, y), push.grid - 1), ivec2(0));
        vec3 moved = LOAD(displacement, at).xyz;
        precise vec3 now = LOAD(position, at).xyz;
        if (advance) now = now + moved;
        row.members[c] = Member(now, moved);
    }
    return row;
}

/// Returns bits of the triangles of a cell that exist (triangle_around).
uint triangles_of(ivec2 cell) {
    if (!cell_inside(cell, push.grid)) return 0u;
    if (masked) return imageLoad(cells, placed_cell(cell)).x;
    return 3u;
}

/// Returns a triangle's share; a triangle that does not exist adds nothing to a sum, not even a zero's sign.
WindForce share_of(bool exists, Member a, Member b, Member c) {
    WindForce share = wind_share(a.position, b.position, c.position, a.displacement, b.displacement, c.displacement,
                                 push.inverse_step, wind_velocity, push.drag_coefficient, push.lift_coefficient,
                                 push.area_limit);
    share.force = exists ? share.force : empty_sum();
    share.drag = exists ? share.drag : -0.0f;
    return share;
}

/// Returns the shares of the triangles between row `y` and the one below.
Shares shares_between(Row above, Row below, int y) {
    Shares shares;
    for (int c = 0; c < strip_columns + 1; ++c) {
        uint bits = triangles_of(ivec2(first_column - 1 + c, y));
        // The corners are in the order of triangle_corner.
        shares.upper[c] = share_of((bits & 1u) != 0u, above.members[c], above.members[c + 1], below.members[c]);
        shares.lower[c] = share_of((bits & 2u) != 0u, above.members[c + 1], below.members[c + 1], below.members[c]);
    }
    return shares;
}

void store_row(Shares above, Shares below, int y) {
    for (int c = 0; c < strip_columns; ++c) {
        WindForce sum = WindForce(empty_sum(), 0.0f);
        sum = add_share(sum, above.lower[c]);
        sum = add_share(sum, above.upper[c + 1]);
        sum = add_share(sum, above.lower[c + 1]);
        sum = add_share(sum, below.upper[c]);
        sum = add_share(sum, below.lower[c]);
        sum = add_share(sum, below.upper[c + 1]);
        ivec2 texel = ivec2(first_column + c, y);
        if (texel.x >= push.grid.x) continue;
        if (weighs) sum.force = add_weight(sum.force, more_gravity, push.inner_mass, LOAD(position, texel).w);
        STORE_VECTOR(wind_force, texel, vec4(sum.force, sum.drag));
    }
}

void main() {
    int inputs = (push.first + given.substep) * (weighs ? 2 : 1);
    wind_velocity = wind[inputs].xyz;  // before anything branches (docs/devices.md)
    if (weighs) more_gravity = wind[inputs + 1].xyz;
    first_column = int(gl_GlobalInvocationID.x) * strip_columns;
    int y = int(gl_GlobalInvocationID.y) * strip_rows, end = min(y + strip_rows, push.grid.y);
    if (first_column >= push.grid.x || y >= end) return;
    Row row = load_row(y);
    Shares above = shares_between(load_row(y - 1), row, y - 1);
    for (;;) {
        Row next = load_row(y + 1);
        Shares below = shares_between(row, next, y);
        store_row(above, below, y);
        row = next;
        above = below;
        ++y;
        if (y >= end) break;
    }
}
