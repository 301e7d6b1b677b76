// Tethers: particles farther from where the cloth is held than it reaches come back.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position and tethers, reads and writes displacement.
void add_tether(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
