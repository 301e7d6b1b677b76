// This kernel takes one explicit step, or several at once of which none is a frame's first, with the same bits as that
// many dispatches of explicit.comp. Each subgroup goes down the rows of a strip of columns and keeps in registers, for
// every step in flight, the row whose lower neighbours are still to come. Every spring is evaluated once; its other end
// uses the negated numbers. Column neighbours in other invocations come by shuffle, so each step invalidates one more
// column at either end of a strip: strips overlap by 2 * `steps`, and bands of rows begin `steps` early. Unrolling is
// left to the driver, since spirv-opt drops `precise` in loops that it unrolls. Where `masked`, the spring shares come
// from an image.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shared/simulation_types.h"
#include "shared/stream_types.h"
#include "include/explicit.h"
#include "include/push.h"
#include "include/spring.h"
#include "include/verlet.h"
CLOTH_CONSTANTS(ExplicitPush)
#define TOGETHER
#include "include/row_bands.h"
#include "include/state_store.h"

layout(local_size_x = stream_lanes) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
VECTOR_OUT(1, position_out);
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(3, displacement_out);
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D position_remainder_in;
VECTOR_OUT(5, position_remainder_out);
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D displacement_remainder_in;
VECTOR_OUT(7, displacement_remainder_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 8, rgba32f) uniform readonly image2D spring_shares;

layout(constant_id = 0) const bool has_shear = false;
layout(constant_id = 1) const int steps = stream_steps;
layout(constant_id = 2) const bool advance = true;  // as in explicit.comp
#include "include/rest_length.h"

const int columns = stream_columns;

struct Particle {
    vec3 position;
    float weight;
    vec3 displacement;
    float mark;  // the mark beside the displacement (verlet.h)
    vec3 position_remainder;
    vec3 displacement_remainder;
    vec3 pull;  // sum of the springs' pulls so far
};

int lesser(int a, int b) { return a < b ? a : b; }
int greater(int a, int b) { return a > b ? a : b; }

int first_column() {
    return int(gl_WorkGroupID.x) * (stream_width - 2 * steps) + int(gl_SubgroupInvocationID) * columns;
}

/// Loads a row of this invocation's particles. Outside the grid it loads a copy of its border that does not move.
void load_row(int y, out Particle row[columns]) {
    for (int c = 0; c < columns; ++c) {
        int x = first_column() + c;
        ivec2 texel = ivec2(lesser(x, push.grid.x - 1), lesser(y, push.grid.y - 1));
        vec4 position = LOAD(position_in, texel), moved = LOAD(displacement_in, texel);
        row[c].position = position.xyz;
        row[c].weight = x < push.grid.x && y < push.grid.y ? position.w : 0.0f;
        row[c].displacement = moved.xyz;
        row[c].mark = moved.w;
        row[c].position_remainder = LOAD(position_remainder_in, texel).xyz;
        row[c].displacement_remainder = LOAD(displacement_remainder_in, texel).xyz;
        row[c].pull = vec3(0.0f);
    }
}

void store_row(RowBand band, int y, Particle row[columns]) {
    if (!is_of(band, y)) return;
    int within = int(gl_SubgroupInvocationID) * columns;
    int first = gl_WorkGroupID.x == 0 ? 0 : steps;
    int end = gl_WorkGroupID.x + 1 == gl_NumWorkGroups.x ? stream_width : stream_width - steps;
    for (int c = 0; c < columns; ++c) {
        ivec2 texel = ivec2(first_column() + c, y);
        if (within + c < first || within + c >= end || texel.x >= push.grid.x) continue;
        STORE_VECTOR(position_out, texel, vec4(row[c].position, row[c].weight));
        STORE_VECTOR(displacement_out, texel, vec4(row[c].displacement, 0.0f));
        STORE_VECTOR(position_remainder_out, texel, vec4(row[c].position_remainder, 0.0f));
        STORE_VECTOR(displacement_remainder_out, texel, vec4(row[c].displacement_remainder, 0.0f));
    }
}

ivec2 nearest_inside(int x, int y) {
    return ivec2(lesser(x, push.grid.x - 1), greater(lesser(y, push.grid.y - 1), 0));
}

/// Returns the shares of the springs that a particle owns, by direction: half along the grid's borders, 0 for a spring
/// that leaves the grid. Outside the grid they are 0 or 1, which does not affect any result that is stored.
vec4 shares_of(int x, int y) {
    vec4 shares;
    if (masked)
        shares = LOAD(spring_shares, nearest_inside(x, y));
    else
        shares = vec4(border_share(ivec2(x, y), ivec2(1, 0), push.grid),
                      border_share(ivec2(x, y), ivec2(0, 1), push.grid), 1.0f, 1.0f);
    bool right = x + 1 < push.grid.x, below = y >= 0 && y + 1 < push.grid.y;
    return vec4(right ? shares.x : 0.0f, below ? shares.y : 0.0f, right && below ? shares.z : 0.0f,
                x > 0 && x < push.grid.x && below ? shares.w : 0.0f);
}

/// Returns the pull of the spring between two particles on the first of them. The spring's own first one is at `x`,
/// `y`.
vec3 pull_between(Particle from, Particle to, int x, int y, int channel, float share) {
    precise vec3 closing = to.displacement - from.displacement;
    precise float stiffness = push.relative_stiffness[channel] * share;
    precise vec3 edge = to.position - from.position;
    if (advance) edge = spring_edge(from.position, to.position, from.displacement, to.displacement);
    float rest = length_at_rest(push.rest_length[channel], nearest_inside(x, y), channel);
    return spring_pull(edge, closing, rest, stiffness, push.compression.x, push.strain_damping);
}

/// Returns the pull that another invocation computed; 0 at the strip's end, where `lane` is the invocation's own.
vec3 pull_of(vec3 pull, int lane) {
    vec3 other = subgroupShuffle(pull, uint(lane));
    return lane == int(gl_SubgroupInvocationID) ? vec3(0.0f) : other;
}

Particle shuffled(Particle particle, int lane) {
    particle.position = subgroupShuffle(particle.position, uint(lane));
    particle.displacement = subgroupShuffle(particle.displacement, uint(lane));
    return particle;
}

/// Adds the springs between the row above and row `y`, and those along row `y`, in the order of neighbour().
void add_springs(inout Particle above[columns], inout Particle row[columns], int y) {
    int lane = int(gl_SubgroupInvocationID), left = greater(lane - 1, 0), right = lesser(lane + 1, stream_lanes - 1);
    Particle before = shuffled(row[columns - 1], left), after = shuffled(row[0], right);
    vec3 down_left[columns], down[columns], down_right[columns], ahead[columns];
    for (int c = 0; c < columns; ++c) {
        int x = first_column() + c;
        vec4 upper_shares = shares_of(x, y - 1), shares = shares_of(x, y);
        Particle next = after, last = before;
        if (c + 1 < columns) next = row[lesser(c + 1, columns - 1)];
        if (c > 0) last = row[greater(c - 1, 0)];
        if (has_shear) {
            down_left[c] = pull_between(above[c], last, x, y - 1, 3, upper_shares.w);
            down_right[c] = pull_between(above[c], next, x, y - 1, 2, upper_shares.z);
        }
        down[c] = pull_between(above[c], row[c], x, y - 1, 1, upper_shares.y);
        ahead[c] = pull_between(row[c], next, x, y, 0, shares.x);
    }
    vec3 upper_left = vec3(0.0f), upper_right = vec3(0.0f);
    if (has_shear) {
        upper_left = pull_of(down_right[columns - 1], left);
        upper_right = pull_of(down_left[0], right);
    }
    vec3 behind = pull_of(ahead[columns - 1], left);
    for (int c = 0; c < columns; ++c) {
        precise vec3 finished = above[c].pull;
        precise vec3 sum;
        if (has_shear) {
            finished = finished + down_left[c];
            finished = finished + down[c];
            finished = finished + down_right[c];
            sum = -(c > 0 ? down_right[greater(c - 1, 0)] : upper_left);
            sum = sum - down[c];
            sum = sum - (c + 1 < columns ? down_left[lesser(c + 1, columns - 1)] : upper_right);
        } else {
            finished = finished + down[c];
            sum = -down[c];
        }
        sum = sum - (c > 0 ? ahead[greater(c - 1, 0)] : behind);
        sum = sum + ahead[c];
        above[c].pull = finished;
        row[c].pull = sum;
    }
}

Particle stepped(Particle particle, float mark) {
    Particle next = particle;
    if (advance) {
        CompensatedSum advanced =
            compensated_add(particle.position, particle.displacement, particle.position_remainder);
        next.position = advanced.value;
        next.position_remainder = advanced.remainder;
    }
    vec3 increment = explicit_increment(particle.displacement, push.gravity_step.xyz, vec3(0.0f), particle.pull,
                                        particle.weight, push.force_step, push.damping_loss);
    CompensatedSum moved = compensated_add(particle.displacement, released_increment(increment, mark),
                                           particle.displacement_remainder);
    if (particle.weight != 0.0f) {
        next.displacement = moved.value;
        next.displacement_remainder = moved.remainder;
    }
    return next;
}

/// Adds row `y` to a step: the row above it then has all its springs, takes the step and replaces `row`. `first`: this
/// step is the first of those in flight.
void take_step(inout Particle above[columns], inout Particle row[columns], int y, bool first) {
    Particle done[columns];
    add_springs(above, row, y);
    for (int c = 0; c < columns; ++c) {
        done[c] = stepped(above[c], first ? above[c].mark : 0.0f);
        above[c] = row[c];
    }
    row = done;
}

void main() {
    Particle above[stream_steps][columns];
    for (int s = 0; s < steps; ++s)
        for (int c = 0; c < columns; ++c)
            above[s][c] = Particle(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f, vec3(0.0f), vec3(0.0f), vec3(0.0f));
    RowBand band = row_band();
    for (int y = lead_in(band, steps); y < band.end + steps; ++y) {
        Particle row[columns];
        load_row(y, row);
        if (steps == 1)  // a loop of one round would stay one, and index its arrays lane by lane
            take_step(above[0], row, y, true);
        else
            for (int s = 0; s < steps; ++s) take_step(above[s], row, y - s, s == 0);
        store_row(band, y - steps, row);
    }
}
