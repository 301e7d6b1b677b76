// Relaxation of bending, one colour of one axis per pass.
#pragma once

#include "passes/pass_kit.h"

namespace drape {

/// Reads position [, stiffness], reads and writes displacement.
void add_bend(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);

}  // namespace drape
