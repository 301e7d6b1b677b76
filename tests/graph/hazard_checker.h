// Finds missing and too weak barriers by brute force: every pair of conflicting uses of a resource, in every execution
// of a sequence of plans, must be joined by a chain of barriers. It is written from the Vulkan specification (chapter
// "Synchronization and Cache Control"), with its own table of accesses, and shares no code with make_plan. It takes
// every barrier to concern its resource alone, and counts no stage as logically earlier or later than another, which
// are both stricter than Vulkan.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "graph/plan.h"

namespace drape::graph {

struct Execution {
    const Graph* graph;
    const Plan* plan;
};

struct Hazard {
    std::string resource, earlier, later;
    std::string problem;  ///< "no execution dependency", "not made visible", ...
    std::string text() const { return resource + ": " + earlier + " -> " + later + ": " + problem; }
};

/// Finds the hazards of plans submitted one after another, after a set-up that wrote every persistent and constant
/// resource by transfer. Resources of different graphs are the same when their names are. `only` names one to look at.
std::vector<Hazard> find_hazards(std::span<const Execution> sequence, const std::string& only = {});

/// Place of a barrier in a plan: before passes[pass], or, past the last pass, among the final barriers.
struct BarrierPlace {
    std::size_t pass, index;
};
std::vector<BarrierPlace> barrier_places(const Plan& plan);
Barrier& barrier_at(Plan& plan, BarrierPlace place);
void remove_barrier(Plan& plan, BarrierPlace place);

/// Returns the barriers without any one of which the plan, run twice, still has no hazard.
std::vector<BarrierPlace> redundant_barriers(const Graph& graph, const Plan& plan);

}  // namespace drape::graph
