// The state on its way between host and device: the start, what is carried over to new resources, members' states, and
// what follows a cut.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "solver/cloth_layout.h"

namespace drape {

/// The bytes that the host had put into a cloth's fields before a cut, by field.
struct CutImages {
    std::array<std::vector<std::byte>, field_count> fields;
    std::size_t index_count, vertex_count;  ///< those of the triangles that were drawn
};

/// The state of a cloth, by field.
using ClothBytes = std::map<std::string, std::vector<std::byte>>;
/// Returns one of them; nothing where it is not there.
std::vector<std::byte> field_of(const ClothBytes& state, Field field);

/// Returns whether a cut leaves so much to draw that it needs other buffers.
bool draws_outgrown(const CutImages& before, const CutTopology& topology);

/// Uploads the initial state, masks, triangles and pins to whatever of them the pool holds.
void upload_start(const ClothLayout& layout, const graph::ResourcePool& pool);
/// Returns what a field of a cloth starts with; nothing: with zeros.
std::vector<std::byte> start_of_field(const ClothLayout& layout, std::size_t cloth, Field field);

/// Fetches the state of all cloths, by resource, so that it can be carried over to new resources.
/// In every set that the pool has.
std::map<std::string, std::vector<std::byte>> download_state(const ClothLayout& layout,
                                                             const graph::ResourcePool& pool);
void upload_state(const ClothLayout& layout, const graph::ResourcePool& pool,
                  const std::map<std::string, std::vector<std::byte>>& state);
/// Returns whether saved bytes can take the place of a part of the state as it is now; a list has room for them
/// from the next `declare` on.
bool takes(ClothLayout& layout, const std::string& name, std::span<const std::byte> now,
           std::span<const std::byte> saved);

/// Fetches the state of some cloths.
std::vector<ClothBytes> download_cloths(const ClothLayout& layout, const graph::ResourcePool& pool,
                                        std::span<const std::size_t> cloths, StateSet set = StateSet::run);
/// Uploads the state of some cloths and leaves the others as they are; null: as the cloth starts. Throws
/// std::invalid_argument where one is not of such a cloth, before anything is uploaded.
void upload_cloths(const ClothLayout& layout, const graph::ResourcePool& pool,
                   const std::map<std::size_t, const ClothBytes*>& states, StateSet set = StateSet::run);
/// Fetches what pairs bore, by member, as a run of each of them has it (cloth/contact_state.h).
std::vector<std::vector<std::byte>> download_borne(const SelfContact& about, const graph::ResourcePool& pool);
/// Uploads it. Returns false, and uploads nothing, where the list has no room for it until the next `declare`.
bool upload_borne(ClothLayout& layout, const graph::ResourcePool& pool,
                  const std::vector<std::vector<std::byte>>& states);

/// Copies the host's side of a cloth's fields, for `upload_cut` to compare with.
CutImages cut_images(const ClothLayout& layout, std::size_t cloth);
/// Uploads the parts of a cut cloth's fields that differ from `before`.
void upload_cut(const ClothLayout& layout, const graph::ResourcePool& pool, std::size_t cloth, const CutImages& before);

}  // namespace drape
