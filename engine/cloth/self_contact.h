// What a cloth's contact with itself is made with (shaders/include/self_contact.h). Pure.
#pragma once

#include "cloth/cloth_geometry.h"
#include "shared/self_contact_types.h"

namespace drape {

/// Per particle: pairs that their list has room for, and pairs of cells.
inline constexpr std::uint32_t self_pairs_per_particle = 96, self_cells_per_particle = 48;

/// `extent`: m, largest coordinate that the cloth is expected to have.
glsl::SelfContactPush self_contact_constants(const SceneDescription& scene, const Cloth& cloth,
                                             const ClothGeometry& geometry, double extent);

/// How full the fullest of a cloth's lists came in a frame; above 1 something found no room in it.
double self_list_use(const glsl::SelfContactPush& push, const glsl::SelfRecord& record);

/// Boxes of the tree over a grid's particles: of one level, of all.
std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level);
std::uint64_t self_tree_boxes(glsl::ivec2 grid);

/// The levels that one pass makes, from `level` on: one, or all that are left.
int last_level(const glsl::SelfContactPush& push, int level);

}  // namespace drape
