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
/// Bit of a pair's first particle: two edges, else a particle and a triangle.
const uint self_edge_pair = 0x80000000u;
/// Units of a correction in a thickness; of a weight in 1. Integers, so that atomic sums are exact in any order.
const float self_correction_units = 1048576.0f, self_weight_units = 65536.0f;

/// A node of the tree of boxes, in which level 0 has a box per particle and each next one a box per 2 x 2 of those
/// before. In the box: the triangles and edges that a particle owns, or all that of the nodes below.
struct SelfBox {
    vec4 lower;  // xyz m; w: most that one of its particles moves in this substep, m
    vec4 upper;  // xyz m; w unused
};

/// Times that pairs push each other in a substep.
const int self_iterations = 3;
/// Rounds in which motions grow from none to as much as crosses nothing.
const int self_rounds = 3;

/// The particles of all cloths lie on one sheet, each cloth's grid at a place of its own and no two next to each other,
/// so that what holds for a grid holds for it, and a column and a row name a particle of the scene.
struct SelfContactPush {
    ivec2 grid;       // columns, rows of the sheet
    float thickness;  // m: the largest that a cloth keeps
    float recovery;   // m that a substep gives back of a thickness that is missing
    float least;      // m: distances that rounding leaves in doubt
    float margin;     // m: by how much more than it needs to the search for cells looks
    int pair_room;    // pairs that the list can hold
    int cell_room;    // likewise of pairs of cells, and of candidates
    int level;        // boxes: the first that this pass makes
    int last;         // boxes: the last
    int top;          // level of the root
    int first;        // 1: the frame's first substep
    int round;        // contact, push, room: which
    int held;         // 1: some particles are always held, so that nothing is carried along with all
    int cloth_count;
};

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

/// Of the passes between a cloth's own fields and the sheet.
struct SelfClothPush {
    ivec2 grid;   // the cloth's
    ivec2 first;  // where it lies on the sheet
    int columns;  // the sheet's
};

/// What contact between the scene's cloths was in the substeps of a frame so far. m.
struct SelfRecord {
    vec4 carried;          // motion that all particles are measured against in this substep; w unused
    uint pair_count;       // of this substep, those that found no room included
    uint most_pairs;       // of the frame
    uint unproved;         // motions of held particles that were not proved to cross nothing, pairs that touched
    uint truncated;        // motions of free particles that were cut short
    uint cell_count;       // pairs of cells of this substep, those that found no room included
    uint candidate_count;  // pairs of cells that may meet in it or later, likewise
    uint most_cells;       // the larger of the two, of the frame
    uint search;           // 1: candidates are searched in this substep
    uint moved;            // bits: most that a particle moved in the substep before
    float drift;           // twice what was moved since the last search, summed by substep
    uint short_rounds;     // bit k: round k left a motion short
    uint block_count;      // pairs of blocks of cells that the last search found, likewise
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
