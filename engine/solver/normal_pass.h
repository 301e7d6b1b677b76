// Normals of a cloth from its positions: for drawing only.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position, writes normal.
void add_normals(graph::Graph& graph, Pipelines& pipelines, ClothState& state);

}  // namespace drape
