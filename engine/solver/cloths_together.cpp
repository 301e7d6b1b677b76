// The part of the solver that is about cloths simulated together: which they are, the handles that a cloth and its
// image share, and the lists of all their pins as one.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <tuple>

#include "cloth/together.h"
#include "solver/cloth_solver.h"
#include "solver/kernel_choice.h"

namespace drape {

using graph::Lifetime;

namespace {

/// Returns the name of the buffer with all pins of cloths together.
std::string pins_name(const ClothState& whole, Field field) {
    return fmt::format("{}/{}", whole.name, row_of(field).name);
}

/// Returns lists of cloths that are alike, have the same contact with colliders, which depends on where they are
/// placed, and turn at the same steps where steps go to and fro between two sets of images.
std::vector<std::vector<std::size_t>> lists_of(const SimulationModel& model) {
    std::vector<std::vector<std::size_t>> lists;
    for (const std::vector<std::size_t>& alike : cloths_alike(model.scene)) {
        std::map<std::tuple<std::size_t, float, bool, bool>, std::vector<std::size_t>> parts;
        for (const std::size_t index : alike) {
            const ClothModel& cloth = model.cloths[index];
            const bool turns = cloth.scheme.spare_state || cloth.scheme.spare_displacement;
            parts[{cloth.collider_list, cloth.edge_reach, turns && cloth.has_motion, turns && cloth.has_release}]
                .push_back(index);
        }
        for (auto& [key, part] : parts) lists.push_back(std::move(part));
    }
    return lists;
}

}  // namespace

void ClothSolver::find_together(const vulkan::Device& device) {
    for (const std::vector<std::size_t>& alike : lists_of(model_)) {
        const Grid& grid = model_.cloths[alike.front()].grid;
        // Halves, until they fit.
        std::size_t count = alike.size();
        while (count > 1 && !buffer_store_obstacle(device, grid, static_cast<std::uint32_t>(count)).empty())
            count = (count + 1) / 2;
        for (std::size_t first = 0; count > 1 && first < alike.size(); first += count) {
            const auto begin = alike.begin() + static_cast<std::ptrdiff_t>(first);
            const std::size_t some = std::min(count, alike.size() - first);
            if (some > 1) together_.push_back({{begin, begin + static_cast<std::ptrdiff_t>(some)}, {}});
        }
    }
}

std::uint32_t ClothSolver::place_of(std::size_t cloth) const {
    if (together_of_[cloth] == together_.size()) return 0;
    const std::vector<std::size_t>& cloths = together_[together_of_[cloth]].cloths;
    return static_cast<std::uint32_t>(std::ranges::find(cloths, cloth) - cloths.begin());
}

void ClothSolver::take(std::size_t cloth) {
    if (together_of_[cloth] == together_.size()) return;
    const Together& together = together_[together_of_[cloth]];
    const std::uint32_t place = place_of(cloth);
    ClothState& state = cloths_[cloth];
    state.away = together.state.away;
    for (const FieldRow& row : cloth_fields()) {
        const graph::Handle whole = together.state[row.field];
        if (lies_together(row) && state[row.field].valid()) state[row.field] = {whole.resource, whole.version, place};
    }
}

void ClothSolver::give(std::size_t cloth) {
    if (together_of_[cloth] == together_.size()) return;
    ClothState& whole = together_[together_of_[cloth]].state;
    const ClothState& state = cloths_[cloth];
    if (state.away != whole.away) throw std::logic_error("a cloth left those that it is together with");
    for (const FieldRow& row : cloth_fields())
        if (lies_together(row) && state[row.field].valid())
            whole[row.field] = {state[row.field].resource, state[row.field].version};
}

void ClothSolver::declare_pins(graph::Graph& graph, Together& together, const FrameNeeds& needs) {
    ClothState& whole = together.state;
    whole.pinned_count = whole.pin_count = 0;
    for (const std::size_t cloth : together.cloths) {
        whole.pinned_count += cloths_[cloth].pinned_count;
        whole.pin_count += cloths_[cloth].pin_count;
    }
    if (whole.pinned_count == 0) return;
    for (const Field field : {Field::pinned_particles, Field::pin_motions}) {
        const FieldRow& row = row_of(field);
        std::uint64_t count = 0;
        for (const std::size_t cloth : together.cloths)
            if (const FieldContext about = context(cloth, needs, *run_); row.needed(about))
                count += row.extent(about).count();
        whole[field] =
            graph.buffer({pins_name(whole, field), count * row.element.size,
                          row.life == FieldLife::constant ? Lifetime::constant : Lifetime::host_input, &row.element});
    }
}

void ClothSolver::upload_pins(const graph::ResourcePool& pool) const {
    for (const Together& together : together_) {
        const std::string name = pins_name(together.state, Field::pinned_particles);
        if (!pool.has(name)) continue;
        std::vector<glsl::PinnedParticle> all;
        int first_row = 0, first_pin = 0;
        for (const std::size_t cloth : together.cloths) {
            const ClothModel& model = model_.cloths[cloth];
            for (glsl::PinnedParticle particle : model.pinned) {
                particle.index.y += first_row;
                particle.index.z += first_pin;
                all.push_back(particle);
            }
            first_row += static_cast<int>(model.grid.rows());
            first_pin += static_cast<int>(model.dynamic_pins.size());
        }
        vulkan::upload(pool.device(), pool.buffer(name), std::as_bytes(std::span(all)));
    }
}

void ClothSolver::write_pins(const graph::ResourcePool& pool, std::uint32_t slot, const FrameInputs& inputs,
                             std::uint32_t substeps) const {
    for (const Together& together : together_) {
        std::vector<glsl::PinMotion> all;  // of each substep, cloth by cloth
        for (std::size_t substep = 0; substep < substeps; ++substep)
            for (const std::size_t cloth : together.cloths) {
                const std::vector<glsl::PinMotion>& own = inputs.pins[cloth];
                const auto count = static_cast<std::ptrdiff_t>(model_.cloths[cloth].dynamic_pins.size());
                const auto first = own.begin() + static_cast<std::ptrdiff_t>(substep) * count;
                all.insert(all.end(), first, first + count);
            }
        const std::string name = pins_name(together.state, Field::pin_motions);
        if (pool.has(name))
            std::memcpy(pool.buffer(name, slot).mapped().data(), all.data(), all.size() * sizeof(glsl::PinMotion));
    }
}

}  // namespace drape
