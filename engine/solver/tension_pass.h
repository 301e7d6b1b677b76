// Tension of the springs of a cloth that takes explicit micro-steps: for the statistics only.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position and displacement at a frame's end, writes the tension of the stretch springs.
void add_tension(graph::Graph& graph, Pipelines& pipelines, ClothState& state);

}  // namespace drape
