// All springs of a relaxation iteration, and the twist of all cells, streamed down the rows.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Both read position and displacement [, spring shares], write the spare image of the displacement, which then is it.
void add_sweep(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);
void add_twist_sweep(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
