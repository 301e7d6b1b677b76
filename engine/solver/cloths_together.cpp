// The part of the solver that is about cloths simulated together: which they are, the handles that a cloth and its
// image share, the lists of all of them as one, and what the host writes for them.
#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "cloth/together.h"
#include "solver/cloth_solver.h"
#include "solver/compute_pass.h"
#include "solver/kernel_choice.h"

namespace drape {

using graph::Lifetime;

namespace {

/// Lists that cloths together have one after the other in one buffer.
constexpr Field joined_lists[] = {Field::nested_boxes, Field::tethers, Field::skin, Field::pinned_particles,
                                  Field::pin_motions};

std::string present_name(const std::string& state) { return state + "/present"; }
std::string present_sizes_name(const std::string& state) { return state + "/sizes of present"; }

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

}  // namespace

void ClothSolver::find_together(const vulkan::Device& device) {
    const bool buffered = kernels_.has(Kernel::buffer_store);
    const auto fit = [&](const ClothModel& cloth, std::size_t count) {
        return cloth.tethers.size() * count <= device.limits().maxTexelBufferElements &&
               state_obstacle(device, cloth.grid, static_cast<std::uint32_t>(count), buffered).empty();
    };
    const auto have_first_numbers = [&](std::size_t first, std::size_t cloth) {
        return have_same_numbers(model_.scene.cloths[first], model_.scene.cloths[cloth]);
    };
    for (const std::vector<std::size_t>& alike : cloths_together(model_)) {
        // Halves, until they fit.
        std::size_t count = alike.size();
        while (count > 1 && !fit(model_.cloths[alike.front()], count)) count = (count + 1) / 2;
        for (std::size_t first = 0; count > 1 && first < alike.size(); first += count) {
            const auto begin = alike.begin() + static_cast<std::ptrdiff_t>(first);
            const auto end = begin + static_cast<std::ptrdiff_t>(std::min(count, alike.size() - first));
            if (end - begin < 2) continue;
            const bool unlike = !std::all_of(begin, end, std::bind_front(have_first_numbers, *begin));
            together_.push_back({{begin, end}, unlike, {}, {}});
        }
    }
    together_of_.assign(model_.cloths.size(), together_.size());
    place_of_.assign(model_.cloths.size(), 0);
    for (std::size_t k = 0; k < together_.size(); ++k)
        for (std::uint32_t place = 0; place < together_[k].cloths.size(); ++place) {
            together_of_[together_[k].cloths[place]] = k;
            place_of_[together_[k].cloths[place]] = place;
        }
}

const std::string& ClothSolver::state_name(std::size_t cloth) const {
    return is_alone(cloth) ? model_.cloths[cloth].name : together_[together_of_[cloth]].state.name;
}

std::span<const std::byte> ClothSolver::part_of(std::size_t cloth, const vulkan::Buffer& of_state) const {
    const std::span<const std::byte> all = of_state.mapped();
    const std::size_t size = all.size() / (is_alone(cloth) ? 1 : together_[together_of_[cloth]].cloths.size());
    return all.subspan(place_of_[cloth] * size, size);
}

void ClothSolver::take(std::size_t cloth) {
    if (is_alone(cloth)) return;
    const Together& together = together_[together_of_[cloth]];
    const std::uint32_t place = place_of_[cloth];
    ClothState& state = cloths_[cloth];
    state.away = together.state.away;
    for (const FieldRow& row : cloth_fields()) {
        const graph::Handle whole = together.state[row.field];
        if (lies_together(row) && state[row.field].valid()) state[row.field] = {whole.resource, whole.version, place};
    }
}

void ClothSolver::give(std::size_t cloth) {
    if (is_alone(cloth)) return;
    ClothState& whole = together_[together_of_[cloth]].state;
    const ClothState& state = cloths_[cloth];
    if (state.away != whole.away) throw std::logic_error("a cloth left those that it is together with");
    for (const FieldRow& row : cloth_fields())
        if (lies_together(row) && state[row.field].valid())
            whole[row.field] = {state[row.field].resource, state[row.field].version};
}

void ClothSolver::declare_lists(graph::Graph& graph, Together& together, const FrameNeeds& needs) {
    ClothState& whole = together.state;
    whole.pinned_count = whole.pin_count = 0;
    for (const std::size_t cloth : together.cloths) {
        whole.pinned_count += cloths_[cloth].pinned_count;
        whole.pin_count += cloths_[cloth].pin_count;
    }
    for (const Field field : joined_lists) {
        const FieldRow& row = row_of(field);
        std::uint64_t count = 0;
        for (const std::size_t cloth : together.cloths)
            if (const FieldContext about = context(cloth, needs, *run_); row.needed(about))
                count += row.extent(about).count();
        if (count == 0) continue;
        whole[field] = graph.buffer({resource_name(whole, row), count * row.element.size,
                                     row.life == FieldLife::constant ? Lifetime::constant : Lifetime::host_input,
                                     &row.element, row.view == FieldView::texel_buffer});
    }
}

bool ClothSolver::all_together() const {
    return std::ranges::none_of(together_of_, [&](std::size_t list) { return list == together_.size(); });
}

void ClothSolver::declare_present(graph::Graph& graph, Together& together) const {
    ClothState& whole = together.state;
    if (!together.sizes_of_present) together.sizes_of_present = std::make_shared<std::vector<glsl::uvec4>>();
    whole.sizes_of_present = together.sizes_of_present;
    whole.present =
        graph.buffer<glsl::uint>(present_name(whole.name), 2 * together.cloths.size(), Lifetime::host_input);
    whole.present_sizes =
        graph.buffer<glsl::uvec4>(present_sizes_name(whole.name), most_present_sizes, Lifetime::host_input);
}

void ClothSolver::write_present(const graph::ResourcePool& pool, std::uint32_t slot,
                                const std::vector<bool>& cloths) const {
    for (const Together& together : together_) {
        const std::size_t count = together.cloths.size();
        std::vector<glsl::uint> present(2 * count);
        glsl::uint layers = 0;
        for (std::size_t place = 0; place < count; ++place)
            if (cloths[together.cloths[place]]) {
                present[layers++] = static_cast<glsl::uint>(place);
                present[count + place] = 1;
            }
        std::vector<glsl::uvec4> sizes = *together.sizes_of_present;
        for (glsl::uvec4& size : sizes) size.z = layers;
        const auto put = [&](const std::string& name, const auto& values) {
            if (pool.has(name))
                std::memcpy(pool.buffer(name, slot).mapped().data(), values.data(), std::span(values).size_bytes());
        };
        put(present_name(together.state.name), present);
        put(present_sizes_name(together.state.name), sizes);
    }
}

std::vector<std::byte> ClothSolver::start_of(const Together& together, const FieldRow& row) const {
    std::vector<std::byte> all;
    int first_row = 0, first_pin = 0;
    for (const std::size_t cloth : together.cloths) {
        const ClothModel& model = model_.cloths[cloth];
        const std::vector<std::byte> own = row.field == Field::pinned_particles
                                               ? bytes_of_list(placed_pins(model, first_row, first_pin))
                                               : row.start(context(cloth));
        all.insert(all.end(), own.begin(), own.end());
        first_row += static_cast<int>(model.grid.rows());
        first_pin += static_cast<int>(model.dynamic_pins.size());
    }
    return all;
}

void ClothSolver::upload_together(const graph::ResourcePool& pool) const {
    for (const Together& together : together_)
        for (const FieldRow& row : cloth_fields()) {
            if (!row.start) continue;
            for (const std::string& name :
                 names_in_sets([&](StateSet set) { return resource_name(together.state, row, set); })) {
                if (!pool.has(name)) continue;
                const std::vector<std::byte> bytes = start_of(together, row);
                if (row.is_image())
                    vulkan::upload(pool.device(), pool.image(name), bytes);
                else
                    vulkan::upload(pool.device(), pool.buffer(name), bytes);
            }
        }
}

void ClothSolver::write_changes(const graph::ResourcePool& pool, std::uint32_t slot,
                                const std::vector<glsl::SubstepChange>& changes) const {
    std::vector<glsl::SubstepChange> all;  // in the order of for_each_dispatch
    for (const Together& together : together_)
        for (const std::size_t cloth : together.cloths) all.push_back(changes[cloth]);
    for (std::size_t cloth = 0; cloth < changes.size(); ++cloth)
        if (is_alone(cloth)) all.push_back(changes[cloth]);
    std::memcpy(pool.buffer(attempt_name, slot).mapped().data(), all.data(), std::span(all).size_bytes());
}

void ClothSolver::write_together(const graph::ResourcePool& pool, std::uint32_t slot, const FrameInputs& inputs,
                                 std::uint32_t substeps) const {
    for (const Together& together : together_) {
        const std::string name = resource_name(together.state, row_of(Field::pin_motions));
        if (!pool.has(name)) continue;
        std::vector<glsl::PinMotion> all;  // of each substep, cloth by cloth
        for (std::size_t substep = 0; substep < substeps; ++substep)
            for (const std::size_t cloth : together.cloths) {
                const std::vector<glsl::PinMotion>& own = inputs.pins[cloth];
                const auto count = static_cast<std::ptrdiff_t>(model_.cloths[cloth].dynamic_pins.size());
                const auto first = own.begin() + static_cast<std::ptrdiff_t>(substep) * count;
                all.insert(all.end(), first, first + count);
            }
        std::memcpy(pool.buffer(name, slot).mapped().data(), all.data(), all.size() * sizeof(glsl::PinMotion));
    }
}

void ClothSolver::write_constants(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t substeps) const {
    for (const Together& together : together_)
        for (const auto& [constants, bytes] : *together.constants.at(substeps))
            if (pool.has(constants))
                std::memcpy(pool.buffer(constants, slot).mapped().data(), bytes.data(), bytes.size());
}

}  // namespace drape
