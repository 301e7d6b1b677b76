// This pass finds the force of the air on each particle, which is that on its up to four quarters of cells. An
// invocation goes down some adjacent columns of particles and keeps the rows above and below, so that most particles
// are loaded once. Where `masked`, an image says which quarters and neighbours a particle has (holes, cuts). Where
// gravity changes, what it is more than at the start is a force here, too, and so are the loads on a particle, up to
// `load_depth`, and the pressure of gas that the cloth `encloses`. Where it `books`, it sums the forces of air and loads.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/gas_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/wind.h"
#include "include/gas.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;    // the positions lack the last substep's displacement
layout(constant_id = 1) const bool weighs = false;     // each wind is followed by the change of gravity since the start
layout(constant_id = 2) const int weather_vectors = 1;  // of a substep, in `wind`
layout(constant_id = 20) const int strip_rows = 1;     // rows that an invocation processes
layout(constant_id = 21) const int strip_columns = 1;  // columns that it processes, most_columns at most
const int most_columns = 2;
CLOTH_CONSTANTS(WindPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
VECTOR_OUT(2, wind_force);
layout(constant_id = 28) const bool books = false;
#define IMPULSES_SLOT 5
#include "include/book_impulses.h"
layout(set = 0, binding = 3, std430) readonly buffer Wind { vec4 wind[]; };
layout(constant_id = 24) const bool masked = false;
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D air;
layout(constant_id = 3) const int load_depth = 0;  // texels of a particle in `loads`
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D loads;
layout(constant_id = 4) const bool encloses = false;
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D gas;
const bool loaded = load_depth > 0 || encloses;

struct Member {
    vec3 position, displacement;
};
/// A row of the invocation's particles, with the one before and the one after them.
struct Row {
    Member members[most_columns + 2];
};

vec3 wind_velocity, more_gravity;
int first_column;
float per_newton;                   // units of impulse of a newton
ImpulseSum by_air = no_impulse();  // on the invocation's particles
ImpulseSum by_loads = no_impulse();
int first_load;      // in `wind`, of the cloth
float gas_pressure;  // Pa

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

vec3 edge_between(Member from, Member to) {
    precise vec3 edge = to.position - from.position;
    return edge;
}

/// Returns what all its loads give to a particle.
vec3 loads_on(ivec2 texel, vec3 area) {
    vec3 sum = empty_sum();
    for (int k = 0; k < load_depth; ++k) {
        vec4 share = LOAD(loads, ivec2(texel.x * load_depth + k, texel.y));
        if (share.x < 0.0f) break;
        sum = add_load(sum, wind[first_load + int(share.x)], share, area);
    }
    return sum;
}

/// Returns `sum` plus what gas gives to the c-th particle of a row.
vec3 with_gas(vec3 sum, Row above, Row row, Row below, int c, uint air) {
    Member own = row.members[c];
    GasEdges edges =
        GasEdges(edge_between(own, row.members[c - 1]), edge_between(own, row.members[c + 1]),
                 edge_between(own, above.members[c]), edge_between(own, below.members[c]),
                 edge_between(own, above.members[c - 1]), edge_between(own, above.members[c + 1]),
                 edge_between(own, below.members[c - 1]), edge_between(own, below.members[c + 1]));
    return gas_force(sum, gas_area(edges, air), gas_pressure, push.gas_sign);
}

void store_row(Row above, Row row, Row below, int y) {
    for (int c = 0; c < strip_columns; ++c) {
        ivec2 texel = ivec2(first_column + c, y);
        if (texel.x >= push.grid.x) continue;
        Member own = row.members[c + 1];
        AirEdges edges = AirEdges(edge_between(own, row.members[c]), edge_between(own, row.members[c + 2]),
                                  edge_between(own, above.members[c + 1]), edge_between(own, below.members[c + 1]));
        vec3 relative = relative_wind(wind_velocity, own.displacement, push.inverse_step);
        uint felt = border_air(texel, push.grid);
        AirEdges all_edges = edges;
        if (masked) {
            felt = LOAD(air, texel).x;
            edges = own_edges(edges, felt, relative, push.spacing);
        }
        WindForce sum = particle_wind_force(edges, felt, relative, push.inverse_step, push.drag_coefficient,
                                            push.lift_coefficient, push.spacing);
        if (books) by_air = with_impulse(by_air, sum.force, per_newton);
        if (loaded) {
            vec3 borne = empty_sum();
            if (load_depth > 0) borne = loads_on(texel, area_vector(all_edges, felt));
            if (encloses) borne = with_gas(borne, above, row, below, c + 1, felt);
            if (books) by_loads = with_impulse(by_loads, borne, per_newton);
            sum.force = with_loads(sum.force, borne, LOAD(position, texel).w);
        }
        if (weighs) sum.force = add_weight(sum.force, more_gravity, push.inner_mass, LOAD(position, texel).w);
        STORE_VECTOR(wind_force, texel, vec4(sum.force, sum.drag));
    }
}

void main() {
    int inputs = (push.first + given.substep) * weather_vectors;
    wind_velocity = wind[inputs].xyz;  // before anything branches (docs/devices.md)
    gas_pressure = 0.0f;
    if (encloses) gas_pressure = imageLoad(gas, ivec2(0, cloth_place())).x;
    first_load = inputs + (weighs ? 2 : 1) + push.first_load;
    if (weighs) more_gravity = wind[inputs + 1].xyz;
    if (books) per_newton = units_per_newton(impulse_units(), push.inverse_step, push.inner_mass);
    first_column = int(gl_GlobalInvocationID.x) * strip_columns;
    int y = int(gl_GlobalInvocationID.y) * strip_rows, end = min(y + strip_rows, push.grid.y);
    if (first_column >= push.grid.x || y >= end) return;
    Row above = load_row(y - 1), row = load_row(y);
    for (;;) {
        Row below = load_row(y + 1);
        store_row(above, row, below, y);
        above = row;
        row = below;
        ++y;
        if (y >= end) break;
    }
    if (books) book(impulse_air, 0, by_air);
    if (books && loaded) book(impulse_loads, 0, by_loads);
}
