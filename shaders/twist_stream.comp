// This kernel is a step of all twist, with the same bits as the four passes of twist.comp. Each subgroup goes down the
// rows of a strip of columns, two rows at a time. With rows 2k and 2k + 1 loaded, it relaxes the cells between those
// two, even columns first, then those between the rows 2k - 1 and 2k, which are done then. `masked` and `second_order`
// are those of twist.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "shared/stream_types.h"
#include "include/bend.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(AllTwistPush)
#define TOGETHER
#include "include/state_store.h"

layout(local_size_x = stream_lanes) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D spring_shares;
#include "include/bend_target.h"
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D line_control;

const int columns = twist_columns, strip_width = twist_width, strip_halo = twist_halo,
          lead = 2;  // rows above a band on which the motion in it depends

#include "include/strip_rows.h"

float compliance;

float share_of(ivec2 cell) {
    if (masked) return twist_share(LOAD(spring_shares, cell), LOAD(spring_shares, cell + ivec2(1, 0)),
                           LOAD(spring_shares, cell + ivec2(0, 1)));
    return 1.0f;
}

/// Relaxes the cell between four particles, the first of which is `corner`. A cell that the grid lacks moves nothing.
void relax(inout Particle upper_left, inout Particle upper_right, inout Particle lower_left, inout Particle lower_right,
           ivec2 corner) {
    bool is_there =
        corner.y >= 0 && corner.y + 1 < push.grid.y && corner.x + 1 < push.grid.x;
    vec3 difference = twist_difference(spring_edge(upper_left.position, upper_right.position, upper_left.displacement,
                                                   upper_right.displacement),
                                       spring_edge(lower_left.position, lower_right.position, lower_left.displacement,
                                                   lower_right.displacement));
    if (is_there) difference = beyond_rest(difference, bend_target(corner, 2));
    float weight = twist_weight(upper_left.weight, upper_right.weight, lower_left.weight, lower_right.weight);
    vec3 correction = project_bend(difference, weight, is_there ? share_of(corner) : 0.0f, compliance);
    vec3 moved_00 = moved_by(upper_left.displacement, correction, upper_left.weight);
    vec3 moved_10 = moved_by(upper_right.displacement, correction, -upper_right.weight);
    vec3 moved_01 = moved_by(lower_left.displacement, correction, -lower_left.weight);
    vec3 moved_11 = moved_by(lower_right.displacement, correction, lower_right.weight);
    upper_left.displacement = is_there ? moved_00 : upper_left.displacement;
    upper_right.displacement = is_there ? moved_10 : upper_right.displacement;
    lower_left.displacement = is_there ? moved_01 : lower_left.displacement;
    lower_right.displacement = is_there ? moved_11 : lower_right.displacement;
}

/// Relaxes the cells between two rows.
void relax_between(inout Particle upper[columns + 1], inout Particle lower[columns + 1], int y) {
    for (int c = 0; c < columns; c += 2)
        relax(upper[c], upper[c + 1], lower[c], lower[c + 1], ivec2(first_column() + c, y));
    fetch_ghost(upper);
    fetch_ghost(lower);
    for (int c = 1; c < columns; c += 2)
        relax(upper[c], upper[c + 1], lower[c], lower[c + 1], ivec2(first_column() + c, y));
    return_ghost(upper);
    return_ghost(lower);
}

void main() {
    compliance = push.compliance;
    if (second_order)
        if (imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u) compliance = push.compliance_bdf2;
    Particle above[columns + 1], upper[columns + 1], lower[columns + 1];
    for (int c = 0; c <= columns; ++c) above[c] = Particle(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    RowBand band = row_band();
    for (int y = lead_in(band, lead); y <= band.end; y += 2) {
        load_row(y, upper);
        load_row(y + 1, lower);
        relax_between(upper, lower, y);
        relax_between(above, upper, y - 1);
        store_row(band, y - 1, above);
        store_row(band, y, upper);
        above = lower;
    }
}
