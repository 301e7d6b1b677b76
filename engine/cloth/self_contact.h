// Derives from the scene the constants, lists and capacities of the contact of cloths with themselves and each other
// (shaders/include/self_contact.h). Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/cloth_model.h"
#include "shared/self_contact_types.h"
#include "world/start_crossings.h"

namespace drape {

/// The capacities, in entries, of the lists of pairs of primitives, of those whose boxes are near each other, of pairs
/// of cells, and of pairs that touch. The result of a frame does not depend on them, as long as they suffice.
struct ContactCapacity {
    std::uint32_t pairs = 0, near = 0, cells = 0, touching = 0;
    bool operator==(const ContactCapacity&) const = default;
    void add(const ContactCapacity& other);
};

/// A scene begins with these capacities per particle; crumpled cloth takes 10, 30 and 50.
inline constexpr ContactCapacity capacity_per_particle{32, 64, 64, 16};
/// An entry of the list of primitives near each other names one of the list of cells in 28 bits, and shaders count in
/// signed integers.
inline constexpr std::uint32_t most_contact_entries = (1u << 28) - 1;
/// Cloths begin at columns and rows of the sheet that are multiples of this, with at least one free between two, so
/// that each of the lower nodes of the sheet's tree of boxes belongs to one cloth.
inline constexpr int self_sheet_step = 8;

struct SelfContact {
    /// Cloths of `crossed` that start through each other meet once they have come apart; those that start on each other
    /// never meet.
    SelfContact(const SceneDescription& scene, const std::vector<ClothModel>& models,
                const std::vector<StartCrossing>& crossed);
    /// Puts those of scenes of one shape (cloth/members.h), in none of which cloths start through each other, on one
    /// sheet. Nothing of two members meets, and each keeps the constants that it has alone.
    explicit SelfContact(const std::vector<const SelfContact*>& members);

    glsl::SelfContactPush push{};         ///< round and the capacity of the lists are set per step
    ContactCapacity capacity;             ///< capacity of the lists in the beginning
    std::vector<glsl::SelfCloth> cloths;  ///< constants of each cloth and its place on the sheet
    /// By place on the sheet; x: thickness kept between layers, m; y: square root of the friction coefficient. Empty:
    /// no cloth has maps of these.
    std::vector<glsl::vec2> skins;
    glsl::ivec2 largest{};  ///< most columns and most rows of any cloth
    bool held = false;      ///< whether some particles are always held
    std::size_t member_count = 1;
    /// It has, by cloth and cloth of a member, self_meets_not, self_meets or self_meets_apart + index.
    std::vector<glsl::uint> meetings;
    std::vector<glsl::SelfCrossed> to_part;  ///< pairs of cloths that are worked apart, as far as they are free to move
    std::vector<StartCrossing> crossed;      ///< cloths that start through each other, or through themselves
    std::vector<int> owners() const;         ///< by place on the sheet: its cloth, or -1
    /// Returns the first column and row of a member's rectangle on the sheet.
    glsl::ivec2 corner_of(std::size_t member) const { return cloths[member * cloths_each()].first; }
    /// Returns the member in whose rectangle a place is.
    std::size_t member_of(glsl::ivec2 texel) const;
    std::size_t cloths_each() const { return cloths.size() / member_count; }
    /// `begins_frame`: in the frame's first substep.
    glsl::SelfClothPush cloth_push(std::size_t cloth, bool begins_frame) const;
    std::size_t place_count() const { return std::size_t(push.grid.x) * std::size_t(push.grid.y); }

  private:
    void lay_skins(const SceneDescription& scene, const std::vector<ClothModel>& models);
};

/// Returns the largest share of a list's capacity that a frame asked for; above 1 entries did not fit.
double self_list_use(const ContactCapacity& capacity, const glsl::SelfRecord& record);
/// Returns at least twice the capacity for every list that was too short, and the same for the others. A list that is
/// filled from one that was too short may prove too short in the next attempt.
ContactCapacity grown_capacity(const ContactCapacity& capacity, const glsl::SelfRecord& record);

/// Returns the number of boxes of one level of the tree over a sheet, and of all its levels.
std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level);
std::uint64_t self_tree_boxes(glsl::ivec2 grid);

}  // namespace drape
