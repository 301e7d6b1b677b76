// Structs of the passes that keep cloths from passing through themselves and each other, shared by GLSL and C++, in
// std430.
#ifndef DRAPE_SELF_CONTACT_TYPES_H
#define DRAPE_SELF_CONTACT_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A workgroup has so many by so many invocations to make the tree of boxes, each with 4 x 4 cells: so many a side,
/// which are one box at the level named.
const int self_tile_side = 8, self_tile_cells = 4 * self_tile_side, self_tile_top = 5;
/// Units of a weight in 1: integers, so that atomic sums are exact in any order.
const float self_weight_units = 65536.0f;

/// A missing thickness is given back at this speed, m/s, and so many times as fast where nothing is left of it.
const float self_recovery_speed = 0.1f, self_deep_recovery = 10.0f;

/// Box of a particle's cell while its corners make any part of their motions, or of a node of the tree of boxes, in
/// which level 0 has a box per particle and each next one a box per 2 x 2 of the level below.
struct SelfBox {
    vec4 lower;  // xyz m; w unused
    vec4 upper;  // xyz m; w unused
};

/// So many times the impulses of a substep's contacts are found from each other.
const int self_iterations = 3;
/// Sums of impulses by place: those that contacts begin with, those after each round, what lacks of thicknesses, and
/// couples of pairs.
const int self_sum_count = self_iterations + 3, self_sum_of_thickness = self_iterations + 1,
          self_sum_of_couples = self_iterations + 2;
/// In so many rounds motions grow from none to as much as crosses nothing.
const int self_rounds = 3;
/// Words of a cloth's shares: whether its particles all make the same share of their motions, then by round the least
/// share of any of them, as bits.
const int self_cloth_words = self_rounds + 1;

/// Index into the sizes of indirect dispatches that a pass takes; a pass of several rounds or levels has one for each.
/// The one for a search is no size: x says whether there is one in this substep, w how many workgroups have come to the
/// end of the pass that asks for it, as beside the size of the tree. A pass is dispatched only for entries that exist:
/// an invocation without work costs the default device as much as one with.
const int self_size_search = 0, self_size_tree = 1, self_size_blocks = 2, self_size_primitives = self_size_blocks + 1,
          self_size_pairs = self_size_primitives + 1, self_size_contact = self_size_pairs + 1,
          self_size_push = self_size_contact + 1, self_size_limit = self_size_push + 1,
          self_size_count = self_size_limit + self_rounds;

/// By these a particle was moved since contact gathered its motion; 0 is by nothing. A collider leads it out of an
/// overlap.
const float self_pushed = 1.0f, self_led_out = 2.0f, self_pushed_and_led = 3.0f;

/// A pair that touches in this substep, or would.
struct SelfTouch {
    uvec4 corners;
    vec4 weights;  // the corners' weighted sum leads from the first primitive's nearest point to the other's
    vec4 normal;   // xyz: direction of that sum, unit length; w: m by which the two may come nearer
    vec4 impulse;  // xyz: on the second primitive, in masses of the first cloth's particle times m; w: friction
};

/// The force that a pair that touched had to bear.
struct SelfBorne {
    uvec4 corners;
    uvec4 force;  // xyz: bits of the impulse over the square of the substep; w: 1 for two edges, which may have the
                  // same corners as a particle and a triangle, and twice the next entry of its chain
};
/// The first entry of the list of what pairs bore says how many follow, in its first corner. The others are chained by
/// their first corner's place and by the parities of their third one's column and row, so that chains are short.
const uint self_no_entry = 0u;
const int self_chains = 4;

/// Sums of impulses at a place, an integer in two words per component (include/self_impulse.h).
struct SelfSum {
    uvec4 xy;
    uvec4 z_weight;  // xy: z; of the first sum z: sum of the weights with which pairs hold the corner; w: their number
};

struct SelfCloth {
    ivec2 first;       // column, row of its first particle
    ivec2 grid;        // columns, rows
    vec2 spacing;      // m along columns, rows, at rest
    float thickness;   // m kept between its own layers
    float friction;    // between its own layers
    float least_flat;  // m, least distance of two primitives of the flat cloth that share no corner
    float lightness;   // factor from its particles' relative inverse masses to those of its scene's first cloth
    float least;       // m, distances that rounding leaves in doubt in its scene
    float largest;     // m, the largest thickness that a cloth of its scene keeps
    int held;          // 1: some particles of it, or of cloths that it is sewn to, are held at first
    int body;          // index of the first of the cloths that it is sewn to, its own where it is sewn to none
};

/// What seams make of a place on the sheet. Particles that are one are corners of their own, which lie alike: impulses
/// and shares of motions are summed at the leader, which moves them all.
struct SelfSewn {
    int leader;          // the place of the particle that it follows, its own where it follows none
    int next;            // the place of the next particle that follows the same leader, or -1
    uint left_out;       // bits of its cell's triangles that meet nothing, for good (0, 1) or until their seams have
                         // closed (2, 3); from bit 4 on: which of the openings is the last of these seams'
    float inverse_mass;  // of all that is sewn there, over that of an inner particle of its cloth; 0: it is not sewn
    float thickness;     // m, the least that the cloths there keep
};

/// Two cloths that started through each other, and how they are worked apart.
struct SelfCrossed {
    vec4 way;      // xyz: unit vector along which the second one leaves the first; w unused
    ivec2 cloths;  // the first, the second
    vec2 parts;    // share of the way apart that each of them goes: 1 together, or 0 where both are held
};

/// Crossings that a substep found of two cloths that started through each other.
struct SelfCrossings {
    int count;  // pairs of cells that cross
    int sum;    // how fast these part, each self_parting_units where it parts as fast as it should
};
const int self_parting_units = 1024;
/// They come to part at this speed, m/s, with this acceleration, m/s^2.
const float self_parting_speed = 1.0f, self_parting_acceleration = 40.0f;

/// States of a pair of cloths in the table of meetings: they do not meet, or they do; from the third on they started
/// through each other and meet in substeps that begin with no crossing of the two.
const uint self_meets_not = 0u, self_meets = 1u, self_meets_apart = 2u;

/// The particles of all cloths lie on one sheet, each cloth's grid at a place of its own and no two next to each other.
/// So the sheet is treated as a grid, and a column and a row name a particle of the scene. The members of an ensemble
/// have a rectangle of the sheet each, all of one size, in which their cloths lie alike.
struct SelfContactPush {
    ivec2 grid;         // columns, rows of the sheet
    float thickness;    // m, the largest that any cloth keeps
    float step;         // s, of the substep
    float least;        // m, the largest distances that rounding leaves in doubt
    float margin;       // m by which the search for cells looks farther than it needs to and foresees
    int pair_capacity;  // capacity of the list of pairs
    int near_capacity;  // capacity of the list of pairs of primitives whose boxes are near each other
    int cell_capacity;  // capacity of the list of pairs of cells, and of candidates
    int top;            // level of the root
    int round;          // contact, push, room: which round
    int cloth_count;
    int crossed_count;      // pairs of cloths that started through each other
    int touching_capacity;  // capacity of the list of pairs that touch, and of what they bore
    SelfCloth cloth;        // the first cloth, looked up here where it is the only one
    ivec2 member_size;      // columns, rows of a member's rectangle
    int sewn_count;         // particles that others follow
    int unused;
};

/// Push constants of the passes between a cloth's own fields and the sheet.
struct SelfClothPush {
    ivec2 grid;        // the cloth's
    ivec2 first;       // where it lies on the sheet
    ivec2 sheet;       // columns, rows of the sheet
    int cloth_count;   // the member's cloths where this is the last of them to be laid and taken back, else 0
    int held;          // gather: 1: some particles are always held, so that nothing is carried along with all
    int begins_frame;  // gather: 1: the frame's first substep
    float thickness;   // m kept between the cloth's own layers
    int member;        // whose cloth it is
    int member_count;  // of those on the sheet
    int opening;       // the first of the substep's openings
    int body;          // SelfCloth::body
};

/// Contact between the scene's cloths in a frame's substeps so far, m. Counts include entries that found no room. Each
/// member has a record of its own for motions and what was cut short; the lists are of all, counted in the first's.
struct SelfRecord {
    vec4 carried;           // motion that all particles are measured against in this substep; w unused
    vec4 mean;              // mean motion of a few particles in this substep, before contact; w unused
    vec4 travel;            // sum of the means since the last search; w unused
    uint point_count;       // pairs of a particle and a triangle in this substep
    uint edge_count;        // pairs of two edges in this substep
    uint near_point_count;  // pairs of primitives whose boxes are near each other, by kind
    uint near_edge_count;
    uint cell_count;       // pairs of cells of this substep
    uint candidate_count;  // pairs of cells that may meet in it or later
    uint block_count;      // pairs of blocks of cells that the last search found
    uint crossing_count;   // pairs of cells of cloths that started through each other and still cross in this substep
    uint touching_point_count;  // pairs of a particle and a triangle that touch in this substep
    uint touching_edge_count;   // pairs of two edges that do
    uint most_pairs;            // largest number of pairs in a substep of the frame
    uint most_near;             // largest number of pairs near each other by boxes
    uint most_cells;            // largest number of pairs of cells, candidates or blocks
    uint most_touching;         // largest number of pairs that touch
    uint unproved;              // motions of held particles that were not proved to cross nothing, pairs that touched
    uint truncated;             // motions of free particles that were cut short
    uint most_lag;              // bits of the longest way (m) that a free particle was held back by in a substep
    uint own_pairs;             // pairs of the member in this substep, where the lists are of several
    uint most_own_pairs;        // largest number of these in a substep of the frame
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
