// This kernel solves the springs of one direction line by line, as line_cyclic.comp does, where lines are long and do
// not bend. In it an invocation has eight particles of its line, in registers (include/part_group.h), so that a
// workgroup waits for its invocations five times, however long the lines are. Particles are loaded and stored where
// invocations beside each other have texels beside each other, two lines at once, and are handed within a subgroup to
// those that own them. `masked` is that of line.comp. What is done for every particle is written out: code that
// spirv-opt unrolls is not precise any more, and arrays that are not indexed by constants would be no registers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shared/line_types.h"
#include "shared/parts_types.h"
#include "shared/simulation_types.h"
#include "include/part_rows.h"
#include "include/push.h"
#include "include/verlet.h"

layout(local_size_x = 32, local_size_x_id = 0) in;
CLOTH_CONSTANTS(LinePush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
TRIPLE_OUT(2, displacement_out);
layout(set = 0, binding = 3, r32f) uniform readonly image2D tension_in;
SCALAR_OUT(4, tension_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 6, r32ui) uniform uimage2D line_control;
layout(constant_id = 2) const bool first_iteration = true;

#include "include/line_particles.h"
#include "include/part_group.h"

#define FOR_EACH_PARTICLE(act) act(0); act(1); act(2); act(3); act(4); act(5); act(6); act(7)

Line line;         // the line of the particles that this invocation owns
bool is_line;      // it is a line of the cloth; a workgroup may have more places
int first_owned;   // place of the first owned particle on it
bool read_is_line; // the same for the line whose particles this invocation loads
int first_read;    // place of the first of these; each next one is `lanes` farther
ivec2 first_at;    // the texel of that particle
int stride;        // columns from one of them to the next
int read_line_at;  // which of the subgroup's lines that is

// The following belong to the owned particles and the springs after them.
vec3 edge[part_particles];      // edges, m; in the second system, their normals
float weight[part_particles];
float weight_after;             // of the particle after the last
float tension[part_particles];  // per length in the first system, then the tension, m
float excess[part_particles];   // how much too long springs are, m
vec3 delta[part_particles];     // changes of displacements by the first system, m
vec3 delta_after;               // of the particle after the last
vec3 normal_before, normal_after;
float share[part_particles], rest[part_particles];  // where `masked`
uint existing;                                      // otherwise; bit j: spring j exists
float share_at(const int j) {
    if (masked) return share[j];
    return (existing & (1u << j)) != 0u ? line.share : 0.0f;
}
float rest_at(const int j) {
    if (masked) return rest[j];
    return line.rest_length;
}

shared uint wrong[part_lines];  // whether one of a line's springs is wrong
shared vec4 edges_kept[groups * part_lines];
shared vec3 deltas_kept[groups * part_lines], first_normals[groups * part_lines], last_normals[groups * part_lines];
shared float handed[groups * subgroup_lanes * part_particles];  // a number of every particle of a subgroup's parts

/// Returns where `handed` has the i-th number of a subgroup, for one of its two lines. Each of shared memory's 32 banks
/// is used once when invocations write or read one number each, in both orders.
int handed_at(int i, int line_at) {
    int spread = i ^ ((i >> 5) & (part_particles - 1)) ^ (line_at * 16);
    return int(gl_SubgroupID) * subgroup_lanes * part_particles + spread;
}
int read_place(const int j) {
    return handed_at(read_line_at * lanes * part_particles + int(gl_SubgroupInvocationID) / part_lines + j * lanes,
                     read_line_at);
}
int owned_place(const int j) {
    int in_subgroup = int(gl_SubgroupInvocationID);
    return handed_at(in_subgroup * part_particles + j, in_subgroup / lanes);
}
void wait_for_subgroup() {
    subgroupMemoryBarrierShared();
    subgroupBarrier();
}

/// Numbers that are passed from the invocations that loaded particles to their owners, or back to those that store
/// them.
float numbers[part_particles];
void write_read(const int j) { handed[read_place(j)] = numbers[j]; }
void read_read(const int j) { numbers[j] = handed[read_place(j)]; }
void write_owned(const int j) { handed[owned_place(j)] = numbers[j]; }
void read_owned(const int j) { numbers[j] = handed[owned_place(j)]; }
void to_owners() {
    wait_for_subgroup();
    FOR_EACH_PARTICLE(write_read);
    wait_for_subgroup();
    FOR_EACH_PARTICLE(read_owned);
}
void from_owners() {
    wait_for_subgroup();
    FOR_EACH_PARTICLE(write_owned);
    wait_for_subgroup();
    FOR_EACH_PARTICLE(read_read);
}

/// What an invocation loads for a particle and the spring after it.
struct Read {
    vec4 start, moved;
    float tension, share, rest;
};
Read loaded[part_particles];
vec3 read_edge[part_particles];
LineParticle after_part;  // the particle after the subgroup's part of a line, in the invocation that loads its last
ivec2 cursor;             // where the particle at hand is
bool loads_last() { return int(gl_SubgroupInvocationID) >= subgroup_lanes - part_lines; }

/// Place on its line of a particle that this invocation loads.
int read_particle(const int j) { return first_read + j * lanes; }
/// Goes on to the next particle that this invocation loads, if there is one.
void go_on(const int j) {
    if (j + 1 == part_particles || read_particle(j + 1) > line.last) return;
    int x = cursor.x + stride;
    cursor = ivec2(x < 0 ? x + line.columns : x >= line.columns ? x - line.columns : x,
                   cursor.y + line.step.y * lanes);
}

void load(const int j) {
    bool has_spring = read_is_line && read_particle(j) < line.last;
    loaded[j] = Read(LOAD(position, cursor), LOAD(displacement_in, cursor), tension_of(line, cursor),
                     has_spring ? share_of(line, cursor) : 0.0f, rest_of(line, cursor));
    go_on(j);
}

/// Computes the edge of a spring, whose second particle another invocation has loaded. Where the first system is
/// solved, the tension is per length from here on.
void make_edge(const int j) {
    int in_subgroup = int(gl_SubgroupInvocationID);
    Read own = loaded[j], asked = own;
    if (in_subgroup < part_lines) asked = loaded[min(j + 1, part_particles - 1)];  // the part's last ones ask for it
    uint from = uint((in_subgroup + part_lines) % subgroup_lanes);
    vec3 start = subgroupShuffle(asked.start.xyz, from), moved = subgroupShuffle(asked.moved.xyz, from);
    if (j + 1 == part_particles && loads_last()) {
        start = after_part.position.xyz;
        moved = after_part.moved.xyz;
    }
    bool has_spring = read_is_line && read_particle(j) < line.last;
    read_edge[j] = has_spring ? spring_edge(own.start.xyz, start, own.moved.xyz, moved) : vec3(0.0f, 0.0f, 0.0f);
    precise vec3 start_edge = start - own.start.xyz;
    if (first_iteration) loaded[j].tension = tension_per_length(own.tension, start_edge, own.rest);
}

void give_x(const int j) { numbers[j] = read_edge[j].x; }
void give_y(const int j) { numbers[j] = read_edge[j].y; }
void give_z(const int j) { numbers[j] = read_edge[j].z; }
void give_tension(const int j) { numbers[j] = loaded[j].tension; }
void give_weight(const int j) { numbers[j] = dragged_weight(loaded[j].start.w, loaded[j].moved.w); }
void own_x(const int j) { edge[j].x = numbers[j]; }
void own_y(const int j) { edge[j].y = numbers[j]; }
void own_z(const int j) { edge[j].z = numbers[j]; }
void own_tension(const int j) { tension[j] = numbers[j]; }
void own_weight(const int j) { weight[j] = numbers[j]; }
void give_share(const int j) { numbers[j] = loaded[j].share; }
void give_rest(const int j) { numbers[j] = loaded[j].rest; }
void own_share(const int j) { share[j] = numbers[j]; }
void own_rest_length(const int j) { rest[j] = numbers[j]; }
void same_rest(const int j) { rest[j] = line.rest_length; }

void find_masked_springs() {
    FOR_EACH_PARTICLE(give_share);
    to_owners();
    FOR_EACH_PARTICLE(own_share);
    if (!own_rest) {
        FOR_EACH_PARTICLE(same_rest);
        return;
    }
    FOR_EACH_PARTICLE(give_rest);
    to_owners();
    FOR_EACH_PARTICLE(own_rest_length);
}
ivec2 owned_at;
void find_spring(const int j) {
    if (is_line && first_owned + j < line.last && owned_at.x != line.seam) existing |= 1u << j;
    owned_at = next_on_line(owned_at, line.step, line.columns);
}
void find_springs() {
    if (masked) {
        find_masked_springs();
        return;
    }
    existing = 0u;
    owned_at = line_end(line.index, line.step, min(first_owned, line.last) + 1, line.columns);
    FOR_EACH_PARTICLE(find_spring);
}

void read_particles() {
    cursor = first_at;
    FOR_EACH_PARTICLE(load);
    after_part = LineParticle(cursor, vec4(0.0f), vec4(0.0f));
    if (loads_last() && read_particle(part_particles - 1) < line.last)
        after_part = load_particle(next_on_line(cursor, line.step, line.columns));
    FOR_EACH_PARTICLE(make_edge);
    FOR_EACH_PARTICLE(give_x);
    to_owners();
    FOR_EACH_PARTICLE(own_x);
    FOR_EACH_PARTICLE(give_y);
    to_owners();
    FOR_EACH_PARTICLE(own_y);
    FOR_EACH_PARTICLE(give_z);
    to_owners();
    FOR_EACH_PARTICLE(own_z);
    FOR_EACH_PARTICLE(give_tension);
    to_owners();
    FOR_EACH_PARTICLE(own_tension);
    FOR_EACH_PARTICLE(give_weight);
    to_owners();
    FOR_EACH_PARTICLE(own_weight);
    find_springs();
    float beyond = subgroupShuffle(after_part.position.w, uint(subgroup_lanes - part_lines + system));
    weight_after = from_lane(weight[0], min(lane + 1, lanes - 1));
    if (lane == lanes - 1) weight_after = beyond;
}

vec4 edge_before;  // of the spring before the one at hand; w: its stiffness
vec4 stiff_edge(const int j) {
    return vec4(edge[j], geometric_stiffness(tension[j], share_at(j), line.per_compliance));
}
void make_particle_row(const int j) {
    vec4 after = stiff_edge(j);
    row[j] = particle_row(edge_before.xyz, edge_before.w, after.xyz, after.w, weight[j]);
    if (first_owned + j > line.last) row[j] = no_cyclic_row();
    edge_before = after;
}
void keep_delta(const int j) { delta[j] = solution[j]; }
void keep_no_delta(const int j) { delta[j] = vec3(0.0f, 0.0f, 0.0f); }

/// Solves the first system.
void filter_deltas() {
    vec4 last_edge = stiff_edge(part_particles - 1);
    if (lane == lanes - 1) edges_kept[group_at] = last_edge;
    edge_before = vec4(from_lane(last_edge.xyz, max(lane - 1, 0)), from_lane(last_edge.w, max(lane - 1, 0)));
    barrier();
    if (lane == 0) edge_before = group > 0 ? edges_kept[group_at - 1] : vec4(0.0f, 0.0f, 0.0f, 0.0f);
    FOR_EACH_PARTICLE(make_particle_row);
    solve(true);
    FOR_EACH_PARTICLE(keep_delta);
    if (lane == 0) deltas_kept[group_at] = delta[0];
    delta_after = from_lane(delta[0], min(lane + 1, lanes - 1));
    barrier();
    if (lane == lanes - 1) delta_after = group + 1 < groups ? deltas_kept[group_at + 1] : vec3(0.0f, 0.0f, 0.0f);
}

void make_spring(const int j) {
    vec3 after = j + 1 < part_particles ? delta[min(j + 1, part_particles - 1)] : delta_after;
    precise vec3 now = edge[j] + (after - delta[j]);
    LineSpring spring = line_spring(now, rest_at(j));
    if (!is_line || first_owned + j >= line.last) spring = LineSpring(vec3(0.0f, 0.0f, 0.0f), 0.0f, 0.0f);
    edge[j] = spring.normal;
    excess[j] = spring.excess;
    if (first_iteration) tension[j] = filtered_tension(tension[j], spring);
}
vec3 normal_at(const int j) {
    return j < 0 ? normal_before : j == part_particles ? normal_after : edge[min(max(j, 0), part_particles - 1)];
}
float largest;  // |C - T| of the springs
void make_spring_row(const int j) {
    LineSpring spring = LineSpring(edge[j], 0.0f, excess[j]);
    float next_weight = j + 1 < part_particles ? weight[min(j + 1, part_particles - 1)] : weight_after;
    row[j] = spring_row(normal_at(j - 1), spring, normal_at(j + 1), weight[j], next_weight, share_at(j),
                        line.compression, line.compliance, tension[j]);
    largest = larger_violation(largest, spring, share_at(j), line.compression, tension[j]);
}

/// Solves the second system.
void solve_springs() {
    FOR_EACH_PARTICLE(make_spring);
    if (lane == 0) first_normals[group_at] = edge[0];
    if (lane == lanes - 1) last_normals[group_at] = edge[part_particles - 1];
    normal_before = from_lane(edge[part_particles - 1], max(lane - 1, 0));
    normal_after = from_lane(edge[0], min(lane + 1, lanes - 1));
    barrier();
    const vec3 none = vec3(0.0f, 0.0f, 0.0f);
    if (lane == 0) normal_before = group > 0 ? last_normals[group_at - 1] : none;
    if (lane == lanes - 1) normal_after = group + 1 < groups ? first_normals[group_at + 1] : none;
    largest = 0.0f;
    FOR_EACH_PARTICLE(make_spring_row);
    if (line_is_wrong(largest, line.rest_length)) atomicOr(wrong[system], 1u);
    solve(false);
}

/// After this, `delta` is the change of a displacement by both systems, and the tension is in the form in which it is
/// stored.
void correct(const int j) {
    float before = j > 0 ? solution[max(j - 1, 0)].x : solution_before.x, change = solution[j].x;
    vec3 correction = line_correction(normal_at(j - 1), before, edge[j], change);
    precise vec3 both = delta[j] + correction * weight[j];
    delta[j] = both;
    float own = share_at(j);
    tension[j] = stored_tension(changed_tension(tension[j], change, own, SPRING_COMPLIANCE(line, own)), line.followed);
}

vec4 displaced[part_particles];
void load_displaced(const int j) {
    displaced[j] = LOAD(displacement_in, cursor);
    go_on(j);
}
void hand_x(const int j) { numbers[j] = delta[j].x; }
void hand_y(const int j) { numbers[j] = delta[j].y; }
void hand_z(const int j) { numbers[j] = delta[j].z; }
void hand_tension(const int j) { numbers[j] = tension[j]; }
void move_x(const int j) { read_edge[j].x = numbers[j]; }
void move_y(const int j) { read_edge[j].y = numbers[j]; }
void move_z(const int j) { read_edge[j].z = numbers[j]; }

void store(const int j) {
    precise vec3 moved = displaced[j].xyz + read_edge[j];
    if (read_is_line && read_particle(j) <= line.last) STORE_TRIPLE(displacement_out, cursor, moved, displaced[j].w);
    if (read_is_line && read_particle(j) < line.last) STORE_SCALAR(tension_out, cursor, numbers[j]);
    go_on(j);
}

void store_particles() {
    FOR_EACH_PARTICLE(correct);
    cursor = first_at + (push.line_count < 0 ? 1 : 0);  // recomputed, so that registers need not keep it
    FOR_EACH_PARTICLE(load_displaced);
    FOR_EACH_PARTICLE(hand_x);
    from_owners();
    FOR_EACH_PARTICLE(move_x);
    FOR_EACH_PARTICLE(hand_y);
    from_owners();
    FOR_EACH_PARTICLE(move_y);
    FOR_EACH_PARTICLE(hand_z);
    from_owners();
    FOR_EACH_PARTICLE(move_z);
    FOR_EACH_PARTICLE(hand_tension);
    from_owners();
    cursor = first_at;
    FOR_EACH_PARTICLE(store);
}

void take_places() {
    take_group_places();
    int in_subgroup = int(gl_SubgroupInvocationID), first_line = int(gl_WorkGroupID.y) * part_lines;
    is_line = first_line + system < push.line_count;
    line = read_line(min(first_line + system, push.line_count - 1));
    first_owned = (group * lanes + lane) * part_particles;
    read_line_at = in_subgroup % part_lines;
    read_is_line = first_line + read_line_at < push.line_count;
    first_read = group * lanes * part_particles + in_subgroup / part_lines;
    int index = min(first_line + read_line_at, push.line_count - 1);
    first_at = line_end(index, line.step, min(first_read, line.last) + 1, line.columns);
    stride = line.step.x * (lanes % line.columns);
}

void main() {
    take_places();
    if (lane == 0 && group == 0) wrong[system] = 0u;  // seen by all after the first barrier
    read_particles();
    delta_after = vec3(0.0f, 0.0f, 0.0f);
    FOR_EACH_PARTICLE(keep_no_delta);
    if (first_iteration) filter_deltas();
    solve_springs();
    store_particles();
    if (lane == 0 && group == 0 && wrong[system] != 0u)
        imageAtomicAdd(line_control, ivec2(control_wrong_lines, cloth_place()), 1u);
}
