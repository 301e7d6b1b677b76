// The state that belongs to contact between cloths (docs/physics.md 5): what its passes hand each other, by place on
// the sheet on which all cloths lie side by side. Pure.
#pragma once

#include "cloth/self_contact.h"
#include "cloth/state_row.h"

namespace drape {

enum class ContactField : std::uint8_t {
    owners,         ///< by place on the sheet: the cloth there, or -1
    cloths,         ///< where the cloths lie on the sheet (shared/self_contact_types.h)
    skins,          ///< SelfContact::skins
    sewn_corners,   ///< SelfContact::sewn
    sewn_leaders,   ///< SelfContact::sewn_leaders
    meetings,       ///< for each pair of cloths: self_meets or another value of its kind
    crossed,        ///< pairs of cloths that started through each other
    crossings,      ///< what the substep found about the crossed pairs
    led,            ///< by cloth: the displacement that leads it apart from others, m
    positions,      ///< by place: position at the start of the substep, m; w: relative inverse mass
    displacements,  ///< by place: motion within the substep, m; w: bits of the triangles and edges that it owns
    last_motions,   ///< by place: motion within the substep before a frame's last one, m, as contact would have left it
    boxes,          ///< by place: a box around the cell during this substep (shaders/include/self_contact.h)
    kept,           ///< tree of the boxes in which cells were searched for, the lowest level first
    blocks,         ///< pairs of blocks of 2 x 2 cells that the search found
    candidates,     ///< pairs of cells that may come near each other until the next search
    cells,          ///< the candidates that are near each other in this substep
    near,           ///< pairs of primitives whose boxes are close to each other
    pairs,          ///< the corners of the pairs that may touch
    touching,       ///< the pairs that touch, with their impulses
    borne,          ///< what pairs bore in the last substep, with which the next one starts
    first_borne,    ///< by place and chain: the first entry of a pair that has this place as its first corner
    sums,           ///< of impulses, by round and place
    supports,       ///< by place: plane and grip of the surface that the particle lies on (Support), two texels
    before,         ///< displacement before contact, m; w: what moved the particle since (self_pushed)
    velocities,     ///< particles' velocities, m per substep
    made_good,      ///< the motion that restores a missing thickness, m
    led_ways,  ///< displacements by which colliders lead particles out of overlaps, m; `before` marks these particles
    shares,    ///< by round: the bits of the share of its motion that a particle may make
    cloth_shares,  ///< self_cloth_words for each cloth
    record,        ///< a summary of the frame's contact
    sizes,         ///< sizes of the dispatches that process lists
};
inline constexpr std::size_t contact_field_count = static_cast<std::size_t>(ContactField::sizes) + 1;

struct ContactContext {
    const SelfContact& contact;
    ContactCapacity capacity;
};

using ContactRow = StateRow<ContactField, ContactContext>;

/// Returns the table, in the order of ContactField.
std::span<const ContactRow> contact_fields();
/// Returns the field with this name in shaders, if there is one.
std::optional<ContactField> contact_field_called(std::string_view variable);
/// Returns the resource's name, "contact <name>". No field of a cloth has such a name, since theirs contain a slash.
std::string resource_name(const ContactRow& row);
/// Returns what pairs bore, in the form that a saved state has: the list's entries, without the links between them,
/// sorted by their corners, since their order in the list means nothing.
std::vector<std::byte> borne_state(std::vector<glsl::SelfBorne> list);
/// Returns whether these bytes are such a state, with places on this sheet.
bool is_borne_state(std::span<const std::byte> bytes, const SelfContact& contact);
/// Splits the list of what pairs bore into states of the members (SelfContact), each as in a run of its own.
std::vector<std::vector<std::byte>> borne_by_member(const std::vector<glsl::SelfBorne>& list,
                                                    const SelfContact& contact);
/// Joins the members' states to one list.
std::vector<glsl::SelfBorne> borne_of_all(const std::vector<std::vector<std::byte>>& states,
                                          const SelfContact& contact);
/// Returns the number of entries that follow the first one.
std::uint32_t borne_count(std::span<const std::byte> bytes);

/// Returns the capacities, reduced so that no list exceeds a buffer of `most_bytes`.
ContactCapacity limited(const ContactCapacity& capacity, std::uint64_t most_bytes);

}  // namespace drape
