// Nested sweeps of the line solver around lone pins.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// One round: reads position, nested sweeps, spring shares and control; updates displacement and all tensions.
void add_nested(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
