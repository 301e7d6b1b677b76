#include "solver/cloth_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "cloth/together.h"
#include "solver/kernel_choice.h"

namespace drape {

namespace {

/// A name that no cloth has.
std::string together_name(const SimulationModel& model, std::span<const std::size_t> cloths) {
    std::string name = fmt::format("{} and {} more", model.cloths[cloths.front()].name, cloths.size() - 1);
    while (std::ranges::find(model.cloths, name, &ClothModel::name) != model.cloths.end()) name += '.';
    return name;
}

}  // namespace

ClothLayout::ClothLayout(const vulkan::Device& device, const SimulationModel& of, const Kernels& wanted)
    : model(of), kernels(possible_kernels(device, of, wanted)) {
    lists.most_bytes =
        std::min<std::uint64_t>(device.limits().maxStorageBufferRange, device.capabilities().max_buffer_size);
    if (model.self_contact) lists.resize(model.self_contact->capacity);
    for (const ClothModel& cloth : model.cloths) {
        topologies.emplace_back(cloth);
        iteration_sizes.push_back(std::make_shared<std::vector<glsl::uvec4>>());
    }
    find_together(device);
    list_of_.assign(model.cloths.size(), together.size());
    place_of_.assign(model.cloths.size(), 0);
    for (std::size_t k = 0; k < together.size(); ++k)
        for (std::uint32_t place = 0; place < together[k].cloths.size(); ++place) {
            list_of_[together[k].cloths[place]] = k;
            place_of_[together[k].cloths[place]] = place;
        }
}

void ClothLayout::find_together(const vulkan::Device& device) {
    const auto fit = [&](const ClothModel& cloth, std::size_t count) {
        return cloth.tethers.size() * count <= device.capabilities().most_texels &&
               state_obstacle(device, cloth.grid, static_cast<std::uint32_t>(count), kernels.has(Kernel::buffer_store))
                   .empty();
    };
    const auto have_first_numbers = [&](std::size_t first, std::size_t cloth) {
        return have_same_numbers(model.scene.cloths[first], model.scene.cloths[cloth]);
    };
    for (const std::vector<std::size_t>& alike : cloths_together(model)) {
        // Halves, until they fit.
        std::size_t count = alike.size();
        while (count > 1 && !fit(model.cloths[alike.front()], count)) count = (count + 1) / 2;
        for (std::size_t first = 0; count > 1 && first < alike.size(); first += count) {
            const auto cloths = std::span(alike).subspan(first, std::min(count, alike.size() - first));
            if (cloths.size() < 2) continue;
            const bool unlike = !std::ranges::all_of(cloths, std::bind_front(have_first_numbers, cloths.front()));
            together.push_back({{cloths.begin(), cloths.end()}, unlike, together_name(model, cloths)});
        }
    }
}

bool ClothLayout::all_together() const {
    return std::ranges::none_of(list_of_, [&](std::size_t list) { return list == together.size(); });
}

const std::string& ClothLayout::state_name(std::size_t cloth) const {
    return is_alone(cloth) ? model.cloths[cloth].name : together[list_of_[cloth]].name;
}

std::span<const std::byte> ClothLayout::part_of(std::size_t cloth, const vulkan::Buffer& of_state) const {
    const std::span<const std::byte> all = of_state.mapped();
    const std::size_t size = all.size() / (is_alone(cloth) ? 1 : together[list_of_[cloth]].cloths.size());
    return all.subspan(place_of_[cloth] * size, size);
}

std::vector<std::size_t> ClothLayout::cloths_of(const Step& step) const {
    if (step.together) return together[list_of_[step.cloth]].cloths;
    if (step.cloth < model.cloths.size()) return {step.cloth};
    std::vector<std::size_t> all(model.cloths.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

}  // namespace drape
