// Derives from the scene the constants, lists and capacities for the contact of cloths with themselves and each other
// (shaders/include/self_contact.h). Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloth/cloth_model.h"
#include "shared/self_contact_types.h"
#include "world/seam_cover.h"
#include "world/start_crossings.h"

namespace drape {

/// The capacities, in entries, of the lists of primitive pairs, of primitive pairs whose boxes are near each other, of
/// cell pairs, and of pairs that touch. A frame's result does not depend on them, as long as they suffice.
struct ContactCapacity {
    std::uint32_t pairs = 0, near = 0, cells = 0, touching = 0;
    bool operator==(const ContactCapacity&) const = default;
    void add(const ContactCapacity& other);
};

/// The capacities per particle with which a scene begins; crumpled cloth needs 10, 30 and 50.
inline constexpr ContactCapacity capacity_per_particle{32, 64, 64, 16};
/// An entry in the list of near primitives refers to one in the list of cells by 28 bits, and shaders count in signed
/// integers.
inline constexpr std::uint32_t most_contact_entries = (1u << 28) - 1;
/// Cloths begin at columns and rows of the sheet that are multiples of this, with at least one free column or row
/// between two cloths, so that each of the lower nodes of the sheet's tree of boxes belongs to one cloth.
inline constexpr int self_sheet_step = 8;

struct SelfContact {
    /// Cloths of `crossed` that start through each other can touch once they have come apart; those that start lying on
    /// each other never touch.
    SelfContact(const SceneDescription& scene, const std::vector<ClothModel>& models,
                const std::vector<StartCrossing>& crossed);
    /// Joins members' scenes of one shape (cloth/members.h), in none of which cloths start through each other, on one
    /// sheet. Cloths of two members never touch, and each keeps the constants that it has alone.
    explicit SelfContact(const std::vector<const SelfContact*>& members);

    glsl::SelfContactPush push{};         ///< the round and the capacities of lists are set in each step
    ContactCapacity capacity;             ///< capacities of the lists at the start
    std::vector<glsl::SelfCloth> cloths;  ///< by cloth: constants, and its place on the sheet
    /// By place on the sheet; x: thickness kept between layers, m; y: square root of the friction coefficient. Empty:
    /// no cloth has maps of them.
    std::vector<glsl::vec2> skins;
    std::vector<glsl::SelfSewn> sewn;  ///< by place on the sheet; empty: no cloth is sewn
    std::vector<int> sewn_leaders;     ///< the places of particles that others follow
    bool is_sewn() const { return !sewn.empty(); }
    glsl::ivec2 largest{};  ///< the largest numbers of columns and of rows of any cloth
    bool held = false;      ///< some particles are held for good
    std::size_t member_count = 1;
    /// For each pair of a member's cloths: self_meets_not, self_meets or self_meets_apart + index.
    std::vector<glsl::uint> meetings;
    std::vector<glsl::SelfCrossed> to_part;  ///< pairs of cloths that are led apart, as far as they are free to move
    std::vector<StartCrossing> crossed;      ///< cloths that start through each other, or through themselves
    std::vector<int> owners() const;         ///< by place on the sheet: the cloth there, or -1
    /// Returns the first column and row of a member's rectangle on the sheet.
    glsl::ivec2 corner_of(std::size_t member) const { return cloths[member * cloths_each()].first; }
    /// Returns the member whose rectangle contains a place.
    std::size_t member_of(glsl::ivec2 texel) const;
    std::size_t cloths_each() const { return cloths.size() / member_count; }
    /// The step belongs to this substep of its frame; `closings`: SimulationModel::closings.
    glsl::SelfClothPush cloth_push(std::size_t cloth, std::uint32_t substep, std::size_t closings) const;
    std::size_t place_count() const { return std::size_t(push.grid.x) * std::size_t(push.grid.y); }

  private:
    int place_of(std::size_t cloth, std::size_t particle) const;
    void lay_skins(const SceneDescription& scene, const std::vector<ClothModel>& models);
    void lay_seams(const SceneDescription& scene, const std::vector<ClothModel>& models);
    void lay_triangles(const SeamCover& cover, const std::vector<double>& closings);
    void lay_followers(const SeamCover& cover);
};

/// Returns the largest ratio of a list's needed length to its capacity in a frame; above 1, entries were lost.
double self_list_use(const ContactCapacity& capacity, const glsl::SelfRecord& record);
/// Returns the capacities, with each that was too small at least doubled. A list that is filled from one that was too
/// short may still prove too short in the next attempt.
ContactCapacity grown_capacity(const ContactCapacity& capacity, const glsl::SelfRecord& record);

/// Returns the number of boxes in one level of the tree over a sheet; the other function, in all its levels.
std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level);
std::uint64_t self_tree_boxes(glsl::ivec2 grid);

}  // namespace drape
