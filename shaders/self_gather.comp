// This pass copies a cloth's particles to the sheet, as they are at this point of a substep. Where `masked`, an image
// says which triangles exist (holes, cuts); where `sewn`, some beside seams are left out. Where `supported`, it also copies the surfaces on which they lie, and in
// the substep that `ends_frame` the motions of the one before, which it frees of what was paid in advance. The pass of a member's last cloth also begins the
// member's contact in the substep: the first workgroup computes the common motion relative to which all of its
// particles are measured, from a few samples, or none where some particles are always held, and resets the records for
// the passes to come.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/rotation_types.h"
#include "shared/seam_types.h"
#include "shared/simulation_types.h"
#include "include/push.h"
#include "include/rotation.h"
#include "include/self_contact.h"

layout(local_size_x = workgroup_width) in;
CLOTH_CONSTANTS(SelfClothPush)
#define TOGETHER
#include "include/state_store.h"
#include "include/strips.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
// These two images are the sheet's; what other cloths have there stays.
VECTOR_KEPT(2, positions);
VECTOR_KEPT(3, displacements);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D cells;

layout(constant_id = 24) const bool supported = false;
layout(set = 0, binding = 5, rgba32f) uniform image2D support;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D support_grip;
layout(set = 0, binding = 7, std430) writeonly buffer Supports { vec4 supports[]; };
layout(constant_id = 26) const bool ends_frame = false;
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D displacement_before_in;
VECTOR_KEPT(12, last_motions);
layout(constant_id = 28) const bool pays_ahead = false;
VECTOR_OUT(13, displacement_before_out);
layout(set = 0, binding = 14, rgba32f) uniform readonly image2D paid;
layout(set = 0, binding = 8, std430) readonly buffer Cloths { SelfCloth cloths[]; };
layout(set = 0, binding = 9, std430) buffer Record { SelfRecord record[]; };
layout(set = 0, binding = 10, std430) writeonly buffer Sizes { uvec4 sizes[]; };

layout(constant_id = 34) const bool sews_closing = false;
layout(set = 0, binding = 21, std430) readonly buffer Openings { SeamOpening openings[]; };
#include "include/self_sewn.h"

shared vec3 sampled[workgroup_width];
shared float parts[workgroup_width];

int place_of(ivec2 texel) { return (push.first.y + texel.y) * push.sheet.x + push.first.x + texel.x; }

/// Returns bits of a cell's triangles that meet nothing, for their seams' sake.
uint left_out(ivec2 cell) {
    uint all = sewn_corners[place_of(cell)].left_out, bits = all & 3u;
    if (sews_closing) bits |= openings[given.opening + int(all >> 4)].left.y != 0.0f ? (all >> 2) & 3u : 0u;
    return bits;
}

bool exists(ivec2 cell, int which) {
    if (!cell_inside(cell, push.grid)) return false;
    uint bits = 3u;
    if (masked) bits = imageLoad(cells, placed_cell(cell)).x;
    if (sewn) bits &= ~left_out(cell);
    return (bits & uint(which)) != 0u;
}

/// Returns a particle with the mass of all that it is sewn to.
vec4 with_whole_mass(vec4 position, ivec2 texel) {
    if (sewn) {
        float inverse_mass = sewn_corners[place_of(texel)].inverse_mass;
        if (position.w > 0.0f && inverse_mass > 0.0f) position.w = inverse_mass;
    }
    return position;
}

/// Returns the bits of the primitives that a particle owns and that exist: two triangles, three edges, then itself. A
/// particle that is no triangle's corner meets nothing.
uint owned(ivec2 texel) {
    uint bits = (exists(texel, 1) ? 1u : 0u) | (exists(texel, 2) ? 2u : 0u);
    for (int k = 0; k < 3; ++k) {
        ivec4 one = self_edge_owner(k, 0), other = self_edge_owner(k, 1);
        bool is_edge = exists(texel + ivec2(one.x, one.y), one.z) || exists(texel + ivec2(other.x, other.y), other.z);
        bits |= is_edge ? 4u << k : 0u;
    }
    bool is_corner = false;
    for (int k = 0; k < self_cells_beside; ++k) {
        ivec4 cell = self_cell_beside(k);
        is_corner = is_corner || exists(texel + ivec2(cell.x, cell.y), cell.z);
    }
    if (is_corner) bits |= self_particle_exists;
    return bits;
}

/// Lays the motion of the substep before. Where that `pays_ahead`, it ended with a turn that answers this one's contact.
void lay_last_motion(ivec2 texel, ivec2 laid) {
    vec4 motion = LOAD(displacement_before_in, texel);
    if (pays_ahead) {
        vec3 turn = imageLoad(paid, ivec2(paid_turn, cloth_place())).xyz;
        vec3 centre = imageLoad(paid, ivec2(paid_turn + 1, cloth_place())).xyz;
        vec4 own = LOAD(position, texel);
        vec3 without = without_advance(motion.xyz, turn, centre, own.xyz);
        motion = vec4(own.w > 0.0f ? without : motion.xyz, motion.w);
        STORE_VECTOR(displacement_before_out, texel, motion);
    }
    STORE_IN_COLUMNS(last_motions, laid, push.sheet.x, motion);
}

void lay(ivec2 texel) {
    ivec2 laid = push.first + texel;
    STORE_IN_COLUMNS(positions, laid, push.sheet.x, with_whole_mass(LOAD(position, texel), texel));
    vec3 moved = LOAD(displacement, texel).xyz;
    STORE_IN_COLUMNS(displacements, laid, push.sheet.x, vec4(moved, float(owned(texel))));
    if (ends_frame) lay_last_motion(texel, laid);
    if (!supported) return;
    // The mark is reset, since this substep's last collision decides anew where a particle lies.
    vec4 plane = LOAD(support, texel);
    int at = 2 * (laid.y * push.sheet.x + laid.x);
    supports[at] = plane;
    supports[at + 1] = LOAD(support_grip, texel);
    if (plane.x != 0.0f || plane.y != 0.0f || plane.z != 0.0f) imageStore(support, placed(texel), vec4(0.0f));
}

void lay_all() { FOR_STRIP(texel, push.grid, lay(texel)) }

/// Returns the motion of the k-th sample of all the member's cloths.
vec3 sample_of(int k) {
    SelfCloth cloth = cloths[push.member * push.cloth_count + k / self_cloth_samples];
    ivec2 own = self_sample(cloth.grid, k % self_cloth_samples);
    // This pass may not have copied its own cloth yet.
    if (cloth.first == push.first) return LOAD(displacement, own).xyz;
    vec4 laid;
    LOAD_IN_COLUMNS(laid, displacements, cloth.first + own, push.sheet.x)
    return laid.xyz;
}

/// Returns the mean motion of all samples. A workgroup loads them at once and one invocation sums them in order: on the
/// default device each further subgroup that did so would take as long again.
vec3 mean_of_samples(int count) {
    int lane = int(gl_LocalInvocationIndex);
    precise vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (int first = 0; first < count; first += workgroup_width) {
        if (first + lane < count) sampled[lane] = sample_of(first + lane);
        barrier();
        int adds = lane == 0 ? min(workgroup_width, count - first) : 0;
        for (int k = 0; k < adds; ++k) sum = sum + sampled[k];
        barrier();
    }
    if (lane == 0) sampled[0] = self_mean(sum, push.cloth_count);
    barrier();
    return sampled[0];
}

/// Returns, in the first invocation, the smallest part of the mean motion that any sample makes, at most 1.
float least_part_of(vec3 mean, int count) {
    int lane = int(gl_LocalInvocationIndex);
    float least = 1.0f;
    for (int first = 0; first < count; first += workgroup_width) {
        if (first + lane < count) parts[lane] = self_part_made(sample_of(first + lane), mean);
        barrier();
        int looks = lane == 0 ? min(workgroup_width, count - first) : 0;
        for (int k = 0; k < looks; ++k) least = self_least(least, parts[k]);
        barrier();
    }
    return least;
}

void reset_sizes() {
    for (int k = 0; k < self_size_count; ++k) sizes[k] = uvec4(0u, 1u, 1u, 0u);
    if (given.begins_frame != 0) sizes[self_size_search].x = 1u;
}

void reset_record(int member) {
    record[member].point_count = 0u;
    record[member].edge_count = 0u;
    record[member].near_point_count = 0u;
    record[member].near_edge_count = 0u;
    record[member].cell_count = 0u;
    record[member].touching_point_count = 0u;
    record[member].touching_edge_count = 0u;
    record[member].own_pairs = 0u;
    if (given.begins_frame == 0) return;
    record[member].most_pairs = 0u;
    record[member].most_own_pairs = 0u;
    record[member].most_near = 0u;
    record[member].most_cells = 0u;
    record[member].most_touching = 0u;
    record[member].most_lag = 0u;
    record[member].unproved = 0u;
    record[member].truncated = 0u;
}

void begin_contact() {
    int count = self_cloth_samples * push.cloth_count;
    vec3 mean = mean_of_samples(count);
    vec3 made = self_common_motion(mean, least_part_of(mean, count));
    if (gl_LocalInvocationIndex > 0u) return;
    int member = push.member;
    record[member].carried = vec4(push.held != 0 ? vec3(0.0f, 0.0f, 0.0f) : made, 0.0f);
    record[member].travel = vec4(self_travelled(record[member].travel.xyz, record[member].mean.xyz), 0.0f);
    record[member].mean = vec4(mean, 0.0f);
    reset_record(member);
    if (member == 0) reset_sizes();
}

void main() {
    lay_all();
    if (push.cloth_count > 0 && gl_WorkGroupID.x == 0u && gl_WorkGroupID.y == 0u) begin_contact();
}
