// The constants of a pass over cloths together: pushed where all have the same, else records in a buffer, one by cloth
// (CLOTH_CONSTANTS in shaders/include/push.h).
#pragma once

#include <functional>

#include "graph/push_constants.h"
#include "solver/pass_kit.h"

namespace drape {

/// Returns what `push` gives for each of a state's cloths.
std::vector<graph::PushConstants> pushes_of(const ClothState& state, const SimulationModel& model,
                                            const std::function<graph::PushConstants(const ClothModel&)>& push);

/// Returns the buffer that has them for a pass by `module`, called `pass`; none where the first are for all cloths.
graph::Handle own_constants(graph::Graph& graph, ClothState& state, const std::string& module, const std::string& pass,
                            const std::vector<graph::PushConstants>& each);

}  // namespace drape
