// This kernel is a step of all springs, with the same bits as the eight passes of spring.comp. Each subgroup goes down
// the rows of a strip of columns, two rows at a time, and keeps in registers the rows that have passes left. With rows
// 2k and 2k + 1 loaded, every pass takes the rows whose turn it is:
//
//   row          2k-5   2k-4   2k-3   2k-2   2k-1    2k    2k+1
//   along                                            *      *
//   column                                           e------e    even pairs, then
//                                             o------o           odd ones
//   down-right                         e------e
//                               o------o
//   down-left           e-------e
//                o------o
//
// Then the first two rows are done. A ghost beside an invocation's columns is the first column of the invocation on the
// right; its displacement goes back there by shuffle. Where `masked`, the spring shares come from an image. The tension
// is kept for the stretch error, the next iteration or the release of a pin (include/iteration_tension.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shared/simulation_types.h"
#include "shared/stream_types.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(AllSpringsPush)
#define TOGETHER
#include "include/state_store.h"

layout(local_size_x = stream_lanes) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;

#include "include/iteration_tension.h"
#include "include/rest_length.h"

layout(constant_id = 0) const int directions = 15;  // bit d: there are springs of direction d

const int columns = spring_stream_columns, strip_width = spring_stream_width, strip_halo = spring_stream_halo, kept_rows = 5,
          window = kept_rows + 2, lead = 6;  // rows above a band on which the motion in it depends

#include "include/strip_rows.h"

RowBand band;

ivec2 nearest_inside(ivec2 owner) {
    return ivec2(owner.x < push.grid.x ? owner.x : push.grid.x - 1,
                 owner.y < 0 ? 0 : owner.y < push.grid.y ? owner.y : push.grid.y - 1);
}

float share_of(ivec2 owner, ivec2 offset, int channel) {
    if (masked) return LOAD(spring_shares, nearest_inside(owner))[channel];
    return border_share(owner, offset, push.grid);
}

bool exists(ivec2 owner, ivec2 offset) {
    return owner.y >= 0 && owner.y + offset.y < push.grid.y && owner.x < push.grid.x &&
           owner.x + offset.x < push.grid.x;
}

/// Relaxes the spring whose first particle is `owner`. A spring that the grid lacks moves nothing, not even a zero's
/// sign. Takes and returns the spring's tension.
float relax(inout Particle first, inout Particle second, ivec2 owner, ivec2 offset, int channel, float tension) {
    vec3 edge = spring_edge(first.position, second.position, first.displacement, second.displacement);
    precise float weight_sum = first.weight + second.weight;
    SpringResult result =
        project_spring(edge, weight_sum, length_at_rest(push.rest_length[channel], nearest_inside(owner), channel),
                       share_of(owner, offset, channel), push.compression, push.compliance[channel], tension);
    vec3 moved_first = moved_by(first.displacement, result.correction, -first.weight);
    vec3 moved_second = moved_by(second.displacement, result.correction, second.weight);
    bool is_there = exists(owner, offset);
    first.displacement = is_there ? moved_first : first.displacement;
    second.displacement = is_there ? moved_second : second.displacement;
    return result.tension;
}

void store_own(int channel, int c, ivec2 owner, ivec2 offset, float tension) {
    if (is_own(c) && is_of(band, owner.y) && exists(owner, offset)) store_tension_at(owner, channel, tension);
}

void relax_along(inout Particle row[columns + 1], int y) {
    const ivec2 offset = ivec2(1, 0);
    float tension[columns];
    for (int c = 0; c < columns; c += 2) {
        ivec2 owner = ivec2(first_column() + c, y);
        tension[c] = relax(row[c], row[c + 1], owner, offset, 0, tension_at(owner, 0));
    }
    fetch_ghost(row);
    for (int c = 1; c < columns; c += 2) {
        ivec2 owner = ivec2(first_column() + c, y);
        tension[c] = relax(row[c], row[c + 1], owner, offset, 0, tension_at(owner, 0));
    }
    return_ghost(row);
    for (int c = 0; c < columns; ++c)
        store_own(0, c, ivec2(first_column() + c, y), offset, tension[c]);
}

void relax_columns(inout Particle upper[columns + 1], inout Particle lower[columns + 1], int y) {
    const ivec2 offset = ivec2(0, 1);
    for (int c = 0; c < columns; ++c) {
        ivec2 owner = ivec2(first_column() + c, y);
        float tension = relax(upper[c], lower[c], owner, offset, 1, tension_at(owner, 1));
        store_own(1, c, owner, offset, tension);
    }
}

void relax_down_right(inout Particle upper[columns + 1], inout Particle lower[columns + 1], int y) {
    const ivec2 offset = ivec2(1, 1);
    fetch_ghost(lower);
    for (int c = 0; c < columns; ++c) {
        ivec2 owner = ivec2(first_column() + c, y);
        float tension = relax(upper[c], lower[c + 1], owner, offset, 2, tension_at(owner, 2));
        store_own(2, c, owner, offset, tension);
    }
    return_ghost(lower);
}

void relax_down_left(inout Particle upper[columns + 1], inout Particle lower[columns + 1], int y) {
    const ivec2 offset = ivec2(-1, 1);
    fetch_ghost(upper);
    for (int c = 0; c < columns; ++c) {
        ivec2 owner = ivec2(first_column() + c + 1, y);
        float tension = relax(upper[c + 1], lower[c], owner, offset, 3, tension_at(owner, 3));
        store_own(3, c + 1, owner, offset, tension);
    }
    return_ghost(upper);
}

void main() {
    Particle rows[window][columns + 1];  // the rows of the figure above, from the left
    for (int r = 0; r < window; ++r)
        for (int c = 0; c <= columns; ++c) rows[r][c] = Particle(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    band = row_band();
    for (int y = lead_in(band, lead); y < band.end + kept_rows; y += 2) {
        load_row(y, rows[5]);
        load_row(y + 1, rows[6]);
        if ((directions & 1) != 0) {
            relax_along(rows[5], y);
            relax_along(rows[6], y + 1);
        }
        if ((directions & 2) != 0) {
            relax_columns(rows[5], rows[6], y);
            relax_columns(rows[4], rows[5], y - 1);
        }
        if ((directions & 4) != 0) {
            relax_down_right(rows[3], rows[4], y - 2);
            relax_down_right(rows[2], rows[3], y - 3);
        }
        if ((directions & 8) != 0) {
            relax_down_left(rows[1], rows[2], y - 4);
            relax_down_left(rows[0], rows[1], y - 5);
        }
        store_row(band, y - 5, rows[0]);
        store_row(band, y - 4, rows[1]);
        for (int r = 0; r < kept_rows; ++r) rows[r] = rows[r + 2];
    }
}
