// The record that contact between the cloths leaves of a frame, and what it says of the lists' lengths.
#pragma once

#include "solver/cloth_layout.h"

namespace drape {

void add_contact_readback(graph::Graph& graph, const ContactHandles& contact, const SelfContact& about);
/// Returns the record of the slot's last simulated frame, zeros where there is no contact. Where cloths of several
/// members lie on the sheet, the first one's has the counts of all lists.
glsl::SelfRecord self_record(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot);
/// Returns what a member's record would be if it were alone, but for lists that are no pairs.
glsl::SelfRecord self_record_of(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                                std::size_t member);
/// Returns how full the fullest of contact's lists was, 0 where there is none; above 1 the frame is no result.
double self_list_use(const ClothLayout& layout, const glsl::SelfRecord& record);
/// Lengthens the lists that were too short for that frame, from the next `declare` on; false: the device cannot.
bool grow_lists(ContactLists& lists, const glsl::SelfRecord& record);

}  // namespace drape
