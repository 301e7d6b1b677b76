// The state that contact between the cloths has of its own (docs/physics.md 5): what its passes hand each other, by
// place on the sheet on which all cloths lie side by side. Pure.
#pragma once

#include "cloth/self_contact.h"
#include "cloth/state_row.h"

namespace drape {

enum class ContactField : std::uint8_t {
    owners,         ///< by place on the sheet: its cloth, or -1
    cloths,         ///< where the cloths lie on the sheet (shared/self_contact_types.h)
    skins,          ///< SelfContact::skins
    meetings,       ///< by cloth and cloth: self_meets and those beside it
    crossed,        ///< pairs of cloths that started through each other
    crossings,      ///< what the substep found of them
    led,            ///< by cloth: what it is led by to come apart from others, m
    positions,      ///< by place: position at the start of the substep, m; w: relative inverse mass
    displacements,  ///< by place: motion within the substep, m; w: bits of the triangles and edges that it owns
    boxes,          ///< by place: what its cell is in in this substep (shaders/include/self_contact.h)
    kept,           ///< tree of boxes in which cells were looked for, the lowest level first
    blocks,         ///< pairs of blocks of 2 x 2 cells that the search found
    candidates,     ///< pairs of cells that may come near each other until the next search
    cells,          ///< those that are near in this substep
    near,           ///< pairs of primitives whose boxes are near each other
    pairs,          ///< corners of those that may meet
    touching,       ///< those that touch, with their impulses
    borne,          ///< what pairs bore in the last substep, which the next one begins with
    first_borne,    ///< by place and chain: the first entry of a pair whose first corner it is
    sums,           ///< of impulses, by round and place
    supports,       ///< by place: plane and grip of the surface that the particle lies on (Support), two texels
    before,         ///< displacement before contact, m; w: what moved the particle since (self_pushed)
    velocities,     ///< of those, m a substep
    made_good,      ///< their motion that makes a missing thickness good, m
    led_ways,       ///< ways by which colliders lead particles out of overlaps, m; `before` says whose
    shares,         ///< bits of the share of its motion that a particle may make, by round
    record,         ///< what contact was in the frame
    sizes,          ///< of the dispatches that go through lists
};
inline constexpr std::size_t contact_field_count = static_cast<std::size_t>(ContactField::sizes) + 1;

struct ContactContext {
    const SelfContact& contact;
    ContactCapacity capacity;
};

using ContactRow = StateRow<ContactField, ContactContext>;

/// By ContactField.
std::span<const ContactRow> contact_fields();
/// The field that shaders call by this name, if there is one.
std::optional<ContactField> contact_field_called(std::string_view variable);
/// "contact <name>": the resource, which no cloth's is, since those have a stroke in their names.
std::string resource_name(const ContactRow& row);
/// Returns, as the state of a run, what pairs bore: the entries that the list holds, without the links between them, in
/// the order of their corners, since that of the list means nothing.
std::vector<std::byte> borne_state(std::vector<glsl::SelfBorne> list);
/// Returns whether bytes are such a state, of places on this sheet.
bool is_borne_state(std::span<const std::byte> bytes, const SelfContact& contact);
/// Splits the list of what pairs bore into states of the members (SelfContact), each as of a run of its own.
std::vector<std::vector<std::byte>> borne_by_member(const std::vector<glsl::SelfBorne>& list,
                                                    const SelfContact& contact);
/// Joins such states to a list.
std::vector<glsl::SelfBorne> borne_of_all(const std::vector<std::vector<std::byte>>& states,
                                          const SelfContact& contact);
/// Returns how many entries follow the first one.
std::uint32_t borne_count(std::span<const std::byte> bytes);

/// As far as a buffer of so many bytes can hold each of the lists.
ContactCapacity limited(const ContactCapacity& capacity, std::uint64_t most_bytes);

}  // namespace drape
