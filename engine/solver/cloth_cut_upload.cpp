// The part of the solver's uploads that follows a cut: only what changed crosses the bus.
#include <algorithm>
#include <cstring>

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

std::string borne_name() { return resource_name(contact_fields()[static_cast<std::size_t>(ContactField::borne)]); }

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

std::map<std::string, std::vector<std::byte>> ClothSolver::download_state(const graph::ResourcePool& pool) const {
    std::map<std::string, std::vector<std::byte>> state;
    for (const ClothModel& cloth : model_.cloths)
        for (const FieldRow& row : cloth_fields()) {
            const std::string name = resource_name(cloth, row);
            if (row.life != FieldLife::state || !pool.has(name)) continue;
            const vulkan::ImageDescription& image = pool.image(name).description();
            std::vector<std::byte>& bytes = state[name];
            bytes.resize(std::size_t{image.width} * image.height * row.element.size);
            vulkan::download(pool.device(), pool.image(name), bytes);
        }
    if (!model_.self_contact) return state;
    const std::string borne = borne_name();
    const vulkan::Buffer& buffer = pool.buffer(borne);
    std::vector<glsl::SelfBorne> entries(buffer.description().byte_count / sizeof(glsl::SelfBorne));
    vulkan::download(pool.device(), buffer, std::as_writable_bytes(std::span(entries)));
    state[borne] = borne_state(std::move(entries));
    return state;
}

bool ClothSolver::takes(const std::string& name, std::span<const std::byte> now, std::span<const std::byte> saved) {
    if (!model_.self_contact || name != borne_name()) return now.size() == saved.size();
    if (!is_borne_state(saved, *model_.self_contact)) return false;
    ContactCapacity wanted = contact_.capacity;
    wanted.touching = std::max(wanted.touching, borne_count(saved));
    contact_.capacity = limited(wanted, most_list_bytes_);
    return contact_.capacity == wanted;
}

void ClothSolver::upload_state(const graph::ResourcePool& pool,
                               const std::map<std::string, std::vector<std::byte>>& state) const {
    for (const auto& [name, bytes] : state)
        if (pool.has(name) && name != borne_name())
            vulkan::upload(pool.device(), pool.image(name), bytes);
        else if (pool.has(name))
            vulkan::upload_range(pool.device(), pool.buffer(name), 0, bytes);  // lists have more room
}

void ClothSolver::write_cutters(const graph::ResourcePool& pool, std::uint32_t slot, double frame_start,
                                double frame_end) const {
    const std::vector<glsl::CutterTriangle> triangles = cutter_triangles(model_.scene.cutters, frame_start, frame_end);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(triangles));
    std::memcpy(pool.buffer(cutters_name, slot).mapped().data(), bytes.data(), bytes.size());
}

}  // namespace drape
