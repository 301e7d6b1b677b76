// One parity of one spring direction, plain schedule: one invocation per spring.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position, reads and writes displacement; stiffness where the cloth has it, tension where it is kept.
void add_spring(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
