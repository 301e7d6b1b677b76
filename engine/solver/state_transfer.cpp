#include "solver/state_transfer.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace drape {

namespace {

using Bytes = std::vector<std::byte>;

/// First and one past the last element of `size` bytes that differ; equal when none does. Elements that are new differ.
std::pair<std::size_t, std::size_t> changed_range(const Bytes& before, const Bytes& now, std::size_t size) {
    const auto same = [&](std::size_t i) { return std::memcmp(&before[i * size], &now[i * size], size) == 0; };
    const std::size_t shared = std::min(before.size(), now.size()) / size;
    std::size_t first = 0, last = now.size() / size;
    while (first < shared && same(first)) ++first;
    if (now.size() <= before.size())
        while (last > first && same(last - 1)) --last;
    return {first, last};
}

/// Rows of an image, or elements of a buffer, that hold a change.
void upload_change(const graph::ResourcePool& pool, const FieldRow& row, const FieldContext& about,
                   const Bytes& before) {
    const std::string name = resource_name(about.cloth, row);
    if (!pool.has(name)) return;
    const Bytes now = row.start(about);
    const std::size_t size = row.element.size * (row.is_image() ? row.extent(about).width : 1);
    const auto [first, last] = changed_range(before, now, size);
    if (first == last) return;
    const auto changed = std::span(now).subspan(first * size, (last - first) * size);
    if (row.is_image())
        vulkan::upload_rows(pool.device(), pool.image(name), static_cast<std::uint32_t>(first), changed);
    else
        vulkan::upload_range(pool.device(), pool.buffer(name), first * size, changed);
}

/// Returns whether the host makes a field that a cut may change.
bool follows_cuts(const FieldRow& row) { return row.life == FieldLife::constant && row.start != nullptr; }

std::string borne_name(StateSet set) {
    return resource_name(contact_fields()[static_cast<std::size_t>(ContactField::borne)], set);
}

std::vector<std::byte> bytes_of(const vulkan::Device& device, const vulkan::Image& image, const FieldRow& row) {
    std::vector<std::byte> bytes(std::size_t{image.description().width} * image.description().height *
                                 row.element.size);
    vulkan::download(device, image, bytes);
    return bytes;
}

std::vector<glsl::SelfBorne> borne_list(const graph::ResourcePool& pool, const std::string& name) {
    const vulkan::Buffer& buffer = pool.buffer(name);
    std::vector<glsl::SelfBorne> list(buffer.description().byte_count / sizeof(glsl::SelfBorne));
    vulkan::download(pool.device(), buffer, std::as_writable_bytes(std::span(list)));
    return list;
}

/// Returns a cloth's pinned particles with texel and motion counted over all cloths.
std::vector<glsl::PinnedParticle> placed_pins(const ClothModel& cloth, int first_row, int first_pin) {
    std::vector<glsl::PinnedParticle> pins = cloth.pinned;
    for (glsl::PinnedParticle& pin : pins) {
        pin.index.y += first_row;
        pin.index.z += first_pin;
        pin.index.w = first_row;
    }
    return pins;
}

/// Returns what a field of cloths together starts with, cloth by cloth.
Bytes start_of(const ClothLayout& layout, const Together& together, const FieldRow& row) {
    Bytes all;
    int first_row = 0, first_pin = 0;
    for (const std::size_t cloth : together.cloths) {
        const ClothModel& model = layout.model.cloths[cloth];
        const Bytes own = row.field == Field::pinned_particles ? bytes_of_list(placed_pins(model, first_row, first_pin))
                                                               : row.start(layout.context(cloth));
        all.insert(all.end(), own.begin(), own.end());
        first_row += static_cast<int>(model.grid.rows());
        first_pin += static_cast<int>(model.dynamic_pins.size());
    }
    return all;
}

/// Uploads what a field starts with wherever it is, in all sets.
template <class Row, class NameOf, class StartOf>
void upload_row(const graph::ResourcePool& pool, const Row& row, const NameOf& name_of, const StartOf& start_of) {
    if (!row.start) return;
    for (const std::string& name : names_in_sets(name_of)) {
        if (!pool.has(name)) continue;
        const Bytes bytes = start_of();
        if (row.is_image())
            vulkan::upload(pool.device(), pool.image(name), bytes);
        else
            vulkan::upload_range(pool.device(), pool.buffer(name), 0, bytes);  // lists have more room
    }
}

/// Calls `visit` with each image of the pool that is of the state, its row, its set and the cloths that lie in it.
template <class Visit>
void for_state_images(const ClothLayout& layout, const graph::ResourcePool& pool, const Visit& visit) {
    for (std::size_t k = 0; k < state_set_count; ++k)
        for (const FieldRow& row : cloth_fields()) {
            if (row.life != FieldLife::state) continue;
            const auto set = static_cast<StateSet>(k);
            for (const Together& together : layout.together)
                if (const std::string name = resource_name(together.name, row, set); pool.has(name))
                    visit(pool.image(name), row, set, std::span(together.cloths));
            for (std::size_t cloth = 0; cloth < layout.model.cloths.size(); ++cloth) {
                if (!layout.is_alone(cloth)) continue;
                if (const std::string name = resource_name(layout.model.cloths[cloth], row, set); pool.has(name))
                    visit(pool.image(name), row, set, std::span(&cloth, 1));
            }
        }
}

}  // namespace

bool draws_outgrown(const CutImages& before, const CutTopology& topology) {
    const auto other_size = [](std::size_t was, std::size_t is) {
        return (was == 0) != (is == 0) || draw_list_capacity(was) != draw_list_capacity(is);
    };
    return other_size(before.index_count, topology.indices().size()) ||
           other_size(before.vertex_count, topology.vertices().size());
}

void upload_start(const ClothLayout& layout, const graph::ResourcePool& pool) {
    const SimulationModel& model = layout.model;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const ClothModel& about = model.cloths[cloth];
        for (const FieldRow& row : cloth_fields())
            if (layout.is_alone(cloth) || !lies_together(row))
                upload_row(
                    pool, row, [&](StateSet set) { return resource_name(about, row, set); },
                    [&] { return row.start(layout.context(cloth)); });
        const std::string name = resource_name(about, row_of(Field::iteration_sizes));
        if (!pool.has(name)) continue;
        std::vector<glsl::uvec4> sizes = *layout.iteration_sizes[cloth];
        sizes.resize(glsl::iteration_size_count);
        vulkan::upload(pool.device(), pool.buffer(name), std::as_bytes(std::span(sizes)));
    }
    if (!model.mesh_fields.empty() && pool.has(mesh_fields_name))
        vulkan::upload(pool.device(), pool.buffer(mesh_fields_name),
                       std::as_bytes(std::span(model.mesh_fields.texels())));
    if (model.self_contact)
        for (const ContactRow& row : contact_fields())
            upload_row(
                pool, row, [&](StateSet set) { return resource_name(row, set); },
                [&] {
                    return row.start({*model.self_contact, layout.lists.capacity});
                });
    for (const Together& together : layout.together)
        for (const FieldRow& row : cloth_fields())
            upload_row(
                pool, row, [&](StateSet set) { return resource_name(together.name, row, set); },
                [&] { return start_of(layout, together, row); });
}

CutImages cut_images(const ClothLayout& layout, std::size_t cloth) {
    const CutTopology& topology = layout.topologies[cloth];
    CutImages images{{}, topology.indices().size(), topology.vertices().size()};
    for (const FieldRow& row : cloth_fields())
        if (follows_cuts(row)) images.fields[static_cast<std::size_t>(row.field)] = row.start(layout.context(cloth));
    return images;
}

void upload_cut(const ClothLayout& layout, const graph::ResourcePool& pool, std::size_t cloth,
                const CutImages& before) {
    for (const FieldRow& row : cloth_fields())
        if (follows_cuts(row))
            upload_change(pool, row, layout.context(cloth), before.fields[static_cast<std::size_t>(row.field)]);
}

std::map<std::string, Bytes> download_state(const ClothLayout& layout, const graph::ResourcePool& pool) {
    std::map<std::string, Bytes> state;
    for_state_images(
        layout, pool,
        [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            const Bytes bytes = bytes_of(pool.device(), image, row);
            auto next = bytes.begin();
            for (const std::size_t cloth : cloths) {
                const auto first =
                    std::exchange(next, next + static_cast<std::ptrdiff_t>(bytes.size() / cloths.size()));
                state[resource_name(layout.model.cloths[cloth], row, set)].assign(first, next);
            }
        });
    if (!layout.model.self_contact) return state;
    for (const std::string& borne : names_in_sets(borne_name))
        if (pool.has(borne)) state[borne] = borne_state(borne_list(pool, borne));
    return state;
}

std::vector<Bytes> download_borne(const SelfContact& about, const graph::ResourcePool& pool) {
    return borne_by_member(borne_list(pool, borne_name(StateSet::run)), about);
}

bool upload_borne(ClothLayout& layout, const graph::ResourcePool& pool, const std::vector<Bytes>& states) {
    const std::vector<glsl::SelfBorne> all = borne_of_all(states, *layout.model.self_contact);
    ContactCapacity wanted = layout.lists.capacity;
    if (all.size() - 1 > wanted.touching) {
        wanted.touching = static_cast<std::uint32_t>(all.size() - 1);
        layout.lists.resize(wanted);
        return false;
    }
    vulkan::upload_range(pool.device(), pool.buffer(borne_name(StateSet::run)), 0, std::as_bytes(std::span(all)));
    return true;
}

bool takes(ClothLayout& layout, const std::string& name, std::span<const std::byte> now,
           std::span<const std::byte> saved) {
    const std::optional<SelfContact>& contact = layout.model.self_contact;
    if (!contact || !std::ranges::count(names_in_sets(borne_name), name)) return now.size() == saved.size();
    if (!is_borne_state(saved, *contact)) return false;
    ContactCapacity wanted = layout.lists.capacity;
    wanted.touching = std::max(wanted.touching, borne_count(saved));
    return layout.lists.resize(wanted);
}

void upload_state(const ClothLayout& layout, const graph::ResourcePool& pool,
                  const std::map<std::string, Bytes>& state) {
    for_state_images(
        layout, pool,
        [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            Bytes all;
            for (const std::size_t cloth : cloths)
                if (const auto own = state.find(resource_name(layout.model.cloths[cloth], row, set));
                    own != state.end())
                    all.insert(all.end(), own->second.begin(), own->second.end());
            if (!all.empty()) vulkan::upload(pool.device(), image, all);
        });
    for (const std::string& name : names_in_sets(borne_name))
        if (const auto borne = state.find(name); borne != state.end() && pool.has(name))
            vulkan::upload_range(pool.device(), pool.buffer(name), 0, borne->second);  // lists have more room
}

Bytes field_of(const ClothBytes& state, Field field) {
    const auto found = state.find(std::string(row_of(field).name));
    return found == state.end() ? Bytes() : found->second;
}

std::vector<ClothBytes> download_cloths(const ClothLayout& layout, const graph::ResourcePool& pool,
                                        std::span<const std::size_t> wanted, StateSet of_set) {
    std::vector<ClothBytes> states(wanted.size());
    for_state_images(
        layout, pool,
        [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            const auto is_in_it = [&](std::size_t cloth) { return std::ranges::find(cloths, cloth) != cloths.end(); };
            if (set != of_set || std::ranges::none_of(wanted, is_in_it)) return;
            const Bytes bytes = bytes_of(pool.device(), image, row);
            const std::size_t size = bytes.size() / cloths.size();
            for (std::size_t k = 0; k < wanted.size(); ++k) {
                if (!is_in_it(wanted[k])) continue;
                const auto part = std::span(bytes).subspan(layout.place_of(wanted[k]) * size, size);
                states[k][std::string(row.name)].assign(part.begin(), part.end());
            }
        });
    return states;
}

void upload_cloths(const ClothLayout& layout, const graph::ResourcePool& pool,
                   const std::map<std::size_t, const ClothBytes*>& states, StateSet of_set) {
    std::vector<vulkan::RowsOfImage> uploads;
    for_state_images(
        layout, pool,
        [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            if (set != of_set) return;
            const auto height = static_cast<std::uint32_t>(image.description().height / cloths.size());
            const std::size_t size = std::size_t{image.description().width} * height * row.element.size;
            for (const std::size_t cloth : cloths) {
                const auto state = states.find(cloth);
                if (state == states.end()) continue;
                Bytes bytes =
                    state->second ? field_of(*state->second, row.field) : start_of_field(layout, cloth, row.field);
                if (!state->second && bytes.empty()) bytes.resize(size);  // it starts zeroed
                if (bytes.size() != size)
                    throw std::invalid_argument("the saved state is not of this scene: field '" +
                                                std::string(row.name) + "'");
                uploads.push_back({&image, layout.place_of(cloth) * height, std::move(bytes)});
            }
        });
    vulkan::upload_rows(pool.device(), uploads);
}

Bytes start_of_field(const ClothLayout& layout, std::size_t cloth, Field field) {
    const FieldRow& row = row_of(field);
    return row.start ? row.start(layout.context(cloth)) : Bytes();
}

}  // namespace drape
