// What a cloth's contact with itself is made with (shaders/include/self_contact.h). Pure.
#pragma once

#include "cloth/cloth_geometry.h"
#include "shared/self_contact_types.h"

namespace drape {

/// Pairs per particle that the list has room for.
inline constexpr std::uint32_t self_pairs_per_particle = 96;

/// `extent`: m, largest coordinate that the cloth is expected to have.
glsl::SelfContactPush self_contact_constants(const SceneDescription& scene, const Cloth& cloth,
                                             const ClothGeometry& geometry, double extent);

/// Boxes of the tree over a grid's particles: of one level, of all.
std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level);
std::uint64_t self_tree_boxes(glsl::ivec2 grid);

/// The levels that one pass makes, from `level` on: one, or all that are left.
int last_level(const glsl::SelfContactPush& push, int level);

}  // namespace drape
