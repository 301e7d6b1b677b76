// Structs of the passes that keep cloths from passing through themselves and each other, shared by GLSL and C++.
// std430.
#ifndef DRAPE_SELF_CONTACT_TYPES_H
#define DRAPE_SELF_CONTACT_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// Boxes of a level of the tree that one workgroup makes together with all levels above.
const int self_tree_tail = 1024;
/// Units of a correction in a thickness; of a weight in 1. Integers, so that atomic sums are exact in any order.
const float self_correction_units = 1048576.0f, self_weight_units = 65536.0f;

/// How many times as fast as of one that is all but kept a missing thickness is given back where nothing is left of it.
const float self_deep_recovery = 10.0f;

/// What a particle's cell is in while its corners make any part of their motions; or, of a node of the tree of boxes,
/// in which level 0 has a box per particle and each next one a box per 2 x 2 of those before, all of the nodes below.
struct SelfBox {
    vec4 lower;  // xyz m; w unused
    vec4 upper;  // likewise
};

/// Times that pairs push each other in a substep.
const int self_iterations = 3;
/// Rounds in which motions grow from none to as much as crosses nothing.
const int self_rounds = 3;

/// Levels that a tree may have above its lowest: those of a sheet of 2^16 x 2^16 places.
const int self_most_levels = 16;
/// Which of the sizes of indirect dispatches a pass takes: those of its own round, or level, where it has several. What
/// there is nothing to do for is not dispatched: on the default device an invocation without work costs what one with
/// it does.
const int self_size_near = 0, self_size_search = 1, self_size_kept = 2, self_size_levels = 3,
          self_size_blocks = self_size_levels + self_most_levels, self_size_cells = self_size_blocks + 1,
          self_size_primitives = self_size_cells + 1, self_size_pairs = self_size_primitives + 1,
          self_size_contact = self_size_pairs + 1, self_size_push = self_size_contact + self_iterations,
          self_size_limit = self_size_push + self_iterations, self_size_count = self_size_limit + self_rounds;
/// The first of those that begin anew with every substep, not with a search.
const int self_size_of_substep = self_size_search;

/// A cloth on the sheet.
struct SelfCloth {
    ivec2 first;       // column, row of its first particle
    ivec2 grid;        // columns, rows
    vec2 spacing;      // m along columns, rows, at rest
    float thickness;   // m kept between its layers
    float friction;    // between them
    float least_flat;  // m: least distance of two primitives of the flat cloth that share no corner
    float lightness;   // of its particles' relative inverse masses, in those of the first cloth
};

/// Two cloths that started through each other, and how they are worked apart.
struct SelfCrossed {
    vec4 way;      // xyz: unit, along which the second one leaves the first; w unused
    ivec2 cloths;  // the first, the second
    vec2 parts;    // how much of the way apart each of them goes: 1 together, or 0 where both are held
};

/// What a substep found of them.
struct SelfCrossings {
    int count;  // pairs of cells that cross
    int sum;    // of how fast these part, self_parting_units to each that parts as fast as it should
};
const int self_parting_units = 1024;

/// Of a pair of cloths in the table of meetings: they do not meet, they do; from here on, those that started through
/// each other meet in substeps that begin with no crossing of the two.
const uint self_meets_not = 0u, self_meets = 1u, self_meets_apart = 2u;

/// The particles of all cloths lie on one sheet, each cloth's grid at a place of its own and no two next to each other,
/// so that what holds for a grid holds for it, and a column and a row name a particle of the scene.
struct SelfContactPush {
    ivec2 grid;         // columns, rows of the sheet
    float thickness;    // m: the largest that a cloth keeps
    float recovery;     // m that a substep gives back of a thickness that is all but kept
    float least;        // m: distances that rounding leaves in doubt
    float margin;       // m: by how much more than it needs to, and than it foresees, the search for cells looks
    int pair_capacity;  // pairs that their list can hold
    int near_capacity;  // likewise of pairs of primitives whose boxes are near each other
    int cell_capacity;  // likewise of pairs of cells, and of candidates
    int level;          // boxes: the first that this pass makes
    int last;           // boxes: the last
    int top;            // level of the root
    int first;          // 1: the frame's first substep
    int round;          // contact, push, room: which
    int held;           // 1: some particles are always held, so that nothing is carried along with all
    int cloth_count;
    vec2 parting;       // m that cloths that started through each other should part by in a substep, and by which more
                        // than in the one before, at most
    int crossed_count;  // pairs of them
    int unused;
    SelfCloth cloth;  // the first: looked up here where it is the only one
};

/// Of the passes between a cloth's own fields and the sheet.
struct SelfClothPush {
    ivec2 grid;   // the cloth's
    ivec2 first;  // where it lies on the sheet
    int columns;  // the sheet's
};

/// What contact between the scene's cloths was in the substeps of a frame so far. m. Counts include what found no room.
struct SelfRecord {
    vec4 carried;           // motion that all particles are measured against in this substep; w unused
    vec4 mean;              // of the motions of a few in this substep, before contact; w unused
    vec4 travel;            // m: sum of those since the last search; w unused
    uint point_count;       // pairs of this substep of a particle and a triangle
    uint edge_count;        // of two edges
    uint near_point_count;  // of both kinds those whose boxes are near each other
    uint near_edge_count;
    uint cell_count;       // pairs of cells of this substep
    uint candidate_count;  // pairs of cells that may meet in it or later
    uint block_count;      // pairs of blocks of cells that the last search found
    uint crossing_count;   // pairs of cells of cloths that started through each other and still cross in this substep
    uint most_pairs;       // of the frame
    uint most_near;        // likewise, by boxes
    uint most_cells;       // likewise, the most of the three
    uint unproved;         // motions of held particles that were not proved to cross nothing, pairs that touched
    uint truncated;        // motions of free particles that were cut short
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
