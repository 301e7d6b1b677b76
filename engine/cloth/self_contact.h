// What contact of cloths with themselves and each other is made with (shaders/include/self_contact.h). Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/cloth_model.h"
#include "scene/start_crossings.h"
#include "shared/self_contact_types.h"

namespace drape {

/// Entries that the lists have room for: pairs, pairs whose boxes are near each other, pairs of cells. What a frame
/// makes does not depend on it, as long as it suffices.
struct ContactCapacity {
    std::uint32_t pairs = 0, near = 0, cells = 0;
    bool operator==(const ContactCapacity&) const = default;
};

/// Per particle, in the beginning: crumpled cloth takes 10, 30 and 50.
inline constexpr ContactCapacity capacity_per_particle{32, 64, 64};
/// An entry of the list of primitives near each other names one of the list of cells in 28 bits, and shaders count in
/// signed integers.
inline constexpr std::uint32_t most_contact_entries = (1u << 28) - 1;
/// Cloths begin at columns and rows of the sheet that are multiples of this, with at least one free between two: then
/// the lower nodes of its tree of boxes are of one cloth each.
inline constexpr int self_sheet_step = 8;

/// How the cloths of a scene meet.
struct SelfContact {
    /// `crossed`: those that start through each other meet once they have come apart, those that start on each other
    /// never.
    SelfContact(const SceneDescription& scene, const std::vector<ClothModel>& models,
                const std::vector<StartCrossing>& crossed);

    glsl::SelfContactPush push{};         ///< level, last, first, round and the capacity of the lists are set per step
    ContactCapacity capacity;             ///< to begin with
    std::vector<glsl::SelfCloth> cloths;  ///< where each lies on the sheet
    glsl::ivec2 largest{};                ///< columns and rows that none of them has more of
    std::vector<glsl::uint> meetings;     ///< by cloth and cloth: self_meets and those beside it
    std::vector<glsl::SelfCrossed> to_part;  ///< those that are worked apart, as far as they are free to move
    std::vector<StartCrossing> crossed;      ///< those that start through each other, or through themselves
    std::vector<int> owners() const;         ///< by place on the sheet: its cloth, or -1
    glsl::SelfClothPush cloth_push(std::size_t cloth) const;
    std::size_t place_count() const { return std::size_t(push.grid.x) * std::size_t(push.grid.y); }
};

/// How full the fullest of the lists came in a frame; above 1 something found no room in it.
double self_list_use(const ContactCapacity& capacity, const glsl::SelfRecord& record);
/// At least twice as much where a list found none; of a list that is filled from another one that was too short not
/// everything is known yet.
ContactCapacity grown_capacity(const ContactCapacity& capacity, const glsl::SelfRecord& record);

/// Boxes of the tree over a sheet: of one level, of all.
std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level);
std::uint64_t self_tree_boxes(glsl::ivec2 grid);

/// The levels that one pass makes, from `level` on: one, or all that are left.
int last_level(const glsl::SelfContactPush& push, int level);

}  // namespace drape
