// The state on its way from old resources to new ones, and what follows a cut: only what changed crosses the bus.
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "solver/cloth_solver.h"
#include "solver/cut_pass.h"

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

}  // namespace

bool draws_outgrown(const CutImages& before, const CutTopology& topology) {
    const auto other_size = [](std::size_t was, std::size_t is) {
        return (was == 0) != (is == 0) || draw_list_capacity(was) != draw_list_capacity(is);
    };
    return other_size(before.index_count, topology.indices().size()) ||
           other_size(before.vertex_count, topology.vertices().size());
}

CutImages ClothSolver::cut_images(std::size_t cloth) const {
    CutImages images{{}, topologies_[cloth].indices().size(), topologies_[cloth].vertices().size()};
    for (const FieldRow& row : cloth_fields())
        if (follows_cuts(row)) images.fields[static_cast<std::size_t>(row.field)] = row.start(context(cloth));
    return images;
}

void ClothSolver::upload_cut(const graph::ResourcePool& pool, std::size_t cloth, const CutImages& before) const {
    for (const FieldRow& row : cloth_fields())
        if (follows_cuts(row))
            upload_change(pool, row, context(cloth), before.fields[static_cast<std::size_t>(row.field)]);
}

template <class Visit>
void ClothSolver::for_state_images(const graph::ResourcePool& pool, const Visit& visit) const {
    for (std::size_t k = 0; k < state_set_count; ++k)
        for (const FieldRow& row : cloth_fields()) {
            if (row.life != FieldLife::state) continue;
            const auto set = static_cast<StateSet>(k);
            for (const Together& together : together_)
                if (const std::string name = resource_name(together.state, row, set); pool.has(name))
                    visit(pool.image(name), row, set, std::span(together.cloths));
            for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
                if (!is_alone(cloth)) continue;
                if (const std::string name = resource_name(model_.cloths[cloth], row, set); pool.has(name))
                    visit(pool.image(name), row, set, std::span(&cloth, 1));
            }
        }
}

std::map<std::string, std::vector<std::byte>> ClothSolver::download_state(const graph::ResourcePool& pool) const {
    std::map<std::string, std::vector<std::byte>> state;
    for_state_images(pool, [&](const vulkan::Image& image, const FieldRow& row, StateSet set,
                               std::span<const std::size_t> cloths) {
        std::vector<std::byte> bytes(std::size_t{image.description().width} * image.description().height *
                                     row.element.size);
        vulkan::download(pool.device(), image, bytes);
        auto next = bytes.begin();
        for (const std::size_t cloth : cloths) {
            const auto first = std::exchange(next, next + static_cast<std::ptrdiff_t>(bytes.size() / cloths.size()));
            state[resource_name(model_.cloths[cloth], row, set)].assign(first, next);
        }
    });
    if (!model_.self_contact) return state;
    for (const std::string& borne : names_in_sets(borne_name)) {
        if (!pool.has(borne)) continue;
        const vulkan::Buffer& buffer = pool.buffer(borne);
        std::vector<glsl::SelfBorne> entries(buffer.description().byte_count / sizeof(glsl::SelfBorne));
        vulkan::download(pool.device(), buffer, std::as_writable_bytes(std::span(entries)));
        state[borne] = borne_state(std::move(entries));
    }
    return state;
}

std::vector<std::vector<std::byte>> ClothSolver::download_borne(const graph::ResourcePool& pool) const {
    const vulkan::Buffer& buffer = pool.buffer(borne_name(StateSet::run));
    std::vector<glsl::SelfBorne> list(buffer.description().byte_count / sizeof(glsl::SelfBorne));
    vulkan::download(pool.device(), buffer, std::as_writable_bytes(std::span(list)));
    return borne_by_member(list, *model_.self_contact);
}

bool ClothSolver::upload_borne(const graph::ResourcePool& pool, const std::vector<std::vector<std::byte>>& states) {
    const std::vector<glsl::SelfBorne> all = borne_of_all(states, *model_.self_contact);
    if (all.size() - 1 > contact_.capacity.touching) {
        contact_.capacity.touching = static_cast<std::uint32_t>(all.size() - 1);
        contact_.capacity = limited(contact_.capacity, most_list_bytes_);
        return false;
    }
    vulkan::upload_range(pool.device(), pool.buffer(borne_name(StateSet::run)), 0, std::as_bytes(std::span(all)));
    return true;
}

bool ClothSolver::takes(const std::string& name, std::span<const std::byte> now, std::span<const std::byte> saved) {
    if (!model_.self_contact || !std::ranges::count(names_in_sets(borne_name), name)) return now.size() == saved.size();
    if (!is_borne_state(saved, *model_.self_contact)) return false;
    ContactCapacity wanted = contact_.capacity;
    wanted.touching = std::max(wanted.touching, borne_count(saved));
    contact_.capacity = limited(wanted, most_list_bytes_);
    return contact_.capacity == wanted;
}

void ClothSolver::upload_state(const graph::ResourcePool& pool,
                               const std::map<std::string, std::vector<std::byte>>& state) const {
    for_state_images(
        pool, [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            std::vector<std::byte> all;
            for (const std::size_t cloth : cloths)
                if (const auto own = state.find(resource_name(model_.cloths[cloth], row, set)); own != state.end())
                    all.insert(all.end(), own->second.begin(), own->second.end());
            if (!all.empty()) vulkan::upload(pool.device(), image, all);
        });
    for (const std::string& name : names_in_sets(borne_name))
        if (const auto borne = state.find(name); borne != state.end() && pool.has(name))
            vulkan::upload_range(pool.device(), pool.buffer(name), 0, borne->second);  // lists have more room
}

std::vector<std::byte> field_of(const ClothBytes& state, Field field) {
    const auto found = state.find(std::string(row_of(field).name));
    return found == state.end() ? std::vector<std::byte>() : found->second;
}

std::vector<ClothBytes> ClothSolver::download_cloths(const graph::ResourcePool& pool,
                                                     std::span<const std::size_t> wanted, StateSet of_set) const {
    std::vector<ClothBytes> states(wanted.size());
    for_state_images(
        pool, [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            const auto is_in_it = [&](std::size_t cloth) { return std::ranges::find(cloths, cloth) != cloths.end(); };
            if (set != of_set || std::ranges::none_of(wanted, is_in_it)) return;
            std::vector<std::byte> bytes(std::size_t{image.description().width} * image.description().height *
                                         row.element.size);
            vulkan::download(pool.device(), image, bytes);
            const std::size_t size = bytes.size() / cloths.size();
            for (std::size_t k = 0; k < wanted.size(); ++k) {
                if (!is_in_it(wanted[k])) continue;
                const auto part = std::span(bytes).subspan(place_of_[wanted[k]] * size, size);
                states[k][std::string(row.name)].assign(part.begin(), part.end());
            }
        });
    return states;
}

void ClothSolver::upload_cloths(const graph::ResourcePool& pool, const std::map<std::size_t, const ClothBytes*>& states,
                                StateSet of_set) const {
    std::vector<vulkan::RowsOfImage> uploads;
    for_state_images(
        pool, [&](const vulkan::Image& image, const FieldRow& row, StateSet set, std::span<const std::size_t> cloths) {
            if (set != of_set) return;
            const auto height = static_cast<std::uint32_t>(image.description().height / cloths.size());
            const std::size_t size = std::size_t{image.description().width} * height * row.element.size;
            for (const std::size_t cloth : cloths) {
                const auto state = states.find(cloth);
                if (state == states.end()) continue;
                std::vector<std::byte> bytes =
                    state->second ? field_of(*state->second, row.field) : start_of_field(cloth, row.field);
                if (!state->second && bytes.empty()) bytes.resize(size);  // it starts zeroed
                if (bytes.size() != size)
                    throw std::invalid_argument("the saved state is not of this scene: field '" +
                                                std::string(row.name) + "'");
                uploads.push_back({&image, place_of_[cloth] * height, std::move(bytes)});
            }
        });
    vulkan::upload_rows(pool.device(), uploads);
}

std::vector<std::byte> ClothSolver::start_of_field(std::size_t cloth, Field field) const {
    const FieldRow& row = row_of(field);
    return row.start ? row.start(context(cloth)) : std::vector<std::byte>();
}

void ClothSolver::write_cutters(const graph::ResourcePool& pool, std::uint32_t slot, double frame_start,
                                double frame_end) const {
    if (model_.scene.cutters.empty()) return;
    const std::vector<glsl::CutterTriangle> triangles = cutter_triangles(model_.scene.cutters, frame_start, frame_end);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(triangles));
    std::memcpy(pool.buffer(cutters_name, slot).mapped().data(), bytes.data(), bytes.size());
}

}  // namespace drape
