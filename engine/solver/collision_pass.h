// Contact of every particle with every collider, with friction; specialised to the kinds that the scene has.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position and the colliders, reads and writes displacement.
void add_collision(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                   const SimulationModel& model, const Step& step);

}  // namespace drape
