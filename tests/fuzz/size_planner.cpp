// Random graphs of resources of any size: the plan's bytes, and what the memory budget lets pass, agree with sums in
// 128 bits.
#include <fmt/format.h>

#include <set>

#include "fuzz.h"
#include "graph/plan.h"
#include "vulkan/device.h"
#include "vulkan/error.h"
#include "vulkan/frame_slots.h"

namespace drape {
namespace {

using fuzz::Dice;
using fuzz::require;
using graph::Access;
using graph::Lifetime;

// No standard type is wider than 64 bits, so this is an extension of the compiler.
__extension__ using Wide = unsigned __int128;
constexpr Wide most = UINT64_MAX;

struct Sized {
    graph::Handle handle;
    Wide bytes;  ///< sum over all copies
};

/// Returns a number of any magnitude, those at which sums overflow among them.
std::uint64_t magnitude(Dice& dice, int bits) {
    const auto shift = static_cast<int>(dice.below(static_cast<std::uint32_t>(bits)));
    const std::uint64_t top = std::uint64_t{1} << shift;
    return top | (dice.bits(8) & (top - 1));
}

Sized declare(graph::Graph& graph, Dice& dice, std::uint32_t number) {
    const std::string name = fmt::format("r{}", number);
    if (dice.chance(0.5)) {
        const Lifetime lifetime = dice.chance(0.5) ? Lifetime::transient : Lifetime::persistent;
        const auto width = static_cast<std::uint32_t>(magnitude(dice, 32)),
                   height = static_cast<std::uint32_t>(magnitude(dice, 32));
        const bool four = dice.chance(0.3);
        const bool floats = dice.chance(0.5);
        const graph::Handle handle =
            graph.image({name, floats ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                         four ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT, lifetime});
        return {handle, Wide{width} * height * (floats ? 4u : 16u) * (four ? 4u : 1u)};
    }
    const Lifetime lifetimes[] = {Lifetime::transient, Lifetime::persistent, Lifetime::constant, Lifetime::host_input,
                                  Lifetime::host_output};
    const Lifetime lifetime = lifetimes[dice.below(5)];
    const std::uint64_t bytes = magnitude(dice, 62) * 4;
    const bool per_slot = lifetime == Lifetime::host_input || lifetime == Lifetime::host_output;
    return {graph.buffer({name, bytes, lifetime}), Wide{bytes} * (per_slot ? vulkan::frame_slot_count : 1)};
}

void add_pass(graph::Graph& graph, Dice& dice, std::vector<Sized>& resources) {
    graph.add_pass(
        {"pass", "stage", "pass"},
        [&](graph::PassSetup& setup) {
            for (std::uint32_t uses = 1 + dice.below(3); uses > 0; --uses) {
                Sized& sized = resources[dice.below(static_cast<std::uint32_t>(resources.size()))];
                if (dice.chance(0.5))
                    setup.read(sized.handle, Access::transfer_read);
                else
                    sized.handle = setup.write(sized.handle, Access::transfer_write);
            }
        },
        [](graph::PassContext&) {});
}

void check_budget(Dice& dice) {
    const std::uint64_t limit = magnitude(dice, 64);
    vulkan::MemoryBudget budget(limit);
    Wide used = 0;
    for (int k = 0; k < 8; ++k) {
        const std::uint64_t bytes = magnitude(dice, 64);
        const bool fits = used + bytes <= limit;
        bool reserved = true;
        try {
            budget.reserve(bytes, "r");
        } catch (const vulkan::VulkanError&) {
            reserved = false;
        }
        require(reserved == fits, "the budget lets pass what does not fit, or not what fits");
        if (fits) used += bytes;
        if (fits && dice.chance(0.3)) budget.release(bytes), used -= bytes;
        require(budget.used() == used, "the budget lost count");
    }
}

void check_plan(Dice& dice) {
    graph::Graph graph;
    std::vector<Sized> resources;
    Wide all = 0, used = 0;
    for (std::uint32_t count = 1 + dice.below(8); resources.size() < count;) {
        resources.push_back(declare(graph, dice, static_cast<std::uint32_t>(resources.size())));
        all += resources.back().bytes;
    }
    try {
        for (std::uint32_t passes = 1 + dice.below(6); passes > 0; --passes) add_pass(graph, dice, resources);
        const graph::Plan plan = make_plan(graph);
        std::set<std::uint32_t> found;
        for (const graph::PlannedPass& planned : plan.passes)
            for (const graph::Use& use : graph.passes()[planned.pass].uses) found.insert(use.handle.resource);
        for (const std::uint32_t resource : found) used += resources[resource].bytes;
        require(used == plan.byte_count, "the plan's bytes are not the sum of what its passes use");
    } catch (const graph::GraphError&) {  // a random use that is impossible
    } catch (const vulkan::VulkanError&) {
        require(all > most, "sizes within 64 bits are refused");
    }
}

}  // namespace
}  // namespace drape

extern "C" int DRAPE_FUZZ_ENTRY(size_planner)(const std::uint8_t* data, std::size_t size) {
    drape::fuzz::Dice dice({data, size});
    drape::check_budget(dice);
    drape::check_plan(dice);
    return 0;
}
