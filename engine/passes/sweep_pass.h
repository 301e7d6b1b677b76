// All springs of a relaxation iteration, streamed down the rows.
#pragma once

#include "passes/pass_kit.h"

namespace drape {

/// Reads position and displacement, writes the spare image of the displacement, which then is it.
void add_sweep(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);

}  // namespace drape
