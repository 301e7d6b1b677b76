// The search for springs of a cloth that bear too much, at the end of a frame.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Names of what the pass leaves for the host. `tear_count_name`: one uint, springs that bear too much, per frame slot.
std::string tear_count_name(const ClothModel& cloth);
std::string tear_loads_name(const ClothModel& cloth);

/// Reads position and limits (and the shares of a cloth that has them); writes loads over limits and the count. The
/// cloth must be one that tears.
void add_tear(graph::Graph& graph, Pipelines& pipelines, ClothState& state);

/// Fetches the loads of a cloth that bears too much (cloth/tear.h): a submit and a wait.
std::vector<glsl::vec4> read_tear_loads(const graph::ResourcePool& pool, const ClothModel& cloth);

}  // namespace drape
