// The part of the solver's uploads that follows a cut: only what changed crosses the bus.
#include <algorithm>
#include <bit>
#include <cstring>

#include "passes/cloth_solver.h"
#include "passes/cut_pass.h"

namespace drape {

namespace {

template <class T>
bool same(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// First and one past the last element that differ; equal when none does. Elements that are new differ.
template <class T>
std::pair<std::size_t, std::size_t> changed_range(const std::vector<T>& before, const std::vector<T>& now) {
    const std::size_t shared = std::min(before.size(), now.size());
    std::size_t first = 0, last = now.size();
    while (first < shared && same(before[first], now[first])) ++first;
    if (now.size() <= before.size())
        while (last > first && same(before[last - 1], now[last - 1])) --last;
    return {first, last};
}

/// Rows of an image of `width` texels a row that hold a change.
template <class T>
void upload_rows(const graph::ResourcePool& pool, const std::string& name, std::uint32_t width,
                 const std::vector<T>& before, const std::vector<T>& now) {
    const auto [first, last] = changed_range(before, now);
    if (first == last || !pool.has(name)) return;
    const auto first_row = static_cast<std::uint32_t>(first / width);
    const auto end_row = static_cast<std::uint32_t>((last + width - 1) / width);
    const std::span<const T> rows(now.data() + std::size_t{first_row} * width,
                                  std::size_t{end_row - first_row} * width);
    vulkan::upload_rows(pool.device(), pool.image(name), first_row, std::as_bytes(rows));
}

template <class T>
void upload_list(const graph::ResourcePool& pool, const std::string& name, const std::vector<T>& before,
                 const std::vector<T>& now) {
    const auto [first, last] = changed_range(before, now);
    if (first == last || !pool.has(name)) return;
    vulkan::upload_range(pool.device(), pool.buffer(name), first * sizeof(T),
                         std::as_bytes(std::span(now).subspan(first, last - first)));
}

}  // namespace

std::vector<std::string> state_image_parts() {
    std::vector<std::string> parts{"position",          "displacement",        "position rest",
                                   "displacement rest", "displacement before", "velocity excess",
                                   "line control"};
    for (const SpringDirection& direction : spring_directions)
        parts.push_back("tension " + std::string(direction.name));
    return parts;
}

std::size_t draw_list_capacity(std::size_t count) { return std::bit_ceil(std::max<std::size_t>(count, 64)); }

CutImages ClothSolver::cut_images(std::size_t cloth) const {
    const CutTopology& topology = topologies_[cloth];
    return {topology.spring_shares(), topology.grid().cells(), topology.indices(), topology.vertices(),
            topology.tethers()};
}

void ClothSolver::upload_cut(const graph::ResourcePool& pool, std::size_t cloth, const CutImages& before) const {
    const ClothModel& model = model_.cloths[cloth];
    const CutTopology& topology = topologies_[cloth];
    upload_rows(pool, model.name + "/stiffness", model.grid.columns(), before.spring_shares, topology.spring_shares());
    upload_rows(pool, model.name + "/cells", model.grid.columns() - 1, before.cells, topology.grid().cells());
    upload_list(pool, model.name + "/triangles", before.indices, topology.indices());
    upload_list(pool, model.name + "/tethers", before.tethers, topology.tethers());
    upload_list(pool, model.name + "/cut vertices", before.vertices, topology.vertices());
}

std::map<std::string, std::vector<std::byte>> ClothSolver::download_state(const graph::ResourcePool& pool) const {
    std::map<std::string, std::vector<std::byte>> state;
    for (const ClothModel& cloth : model_.cloths)
        for (const std::string& part : state_image_parts()) {
            const std::string name = cloth.name + "/" + part;
            if (!pool.has(name)) continue;
            const vulkan::ImageDescription& image = pool.image(name).description();
            std::vector<std::byte>& bytes = state[name];
            bytes.resize(std::size_t{image.width} * image.height * vulkan::texel_size(image.format));
            vulkan::download(pool.device(), pool.image(name), bytes);
        }
    return state;
}

void ClothSolver::upload_state(const graph::ResourcePool& pool,
                               const std::map<std::string, std::vector<std::byte>>& state) const {
    for (const auto& [name, bytes] : state)
        if (pool.has(name)) vulkan::upload(pool.device(), pool.image(name), bytes);
}

void ClothSolver::write_cutters(const graph::ResourcePool& pool, std::uint32_t slot, double frame_start,
                                double frame_end) const {
    const std::vector<glsl::CutterTriangle> triangles = cutter_triangles(model_.scene.cutters, frame_start, frame_end);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(triangles));
    std::memcpy(pool.buffer(cutters_name, slot).mapped().data(), bytes.data(), bytes.size());
}

}  // namespace drape
