// Adds the contact of what is drawn between particles with the edges of boxes.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

void add_box_edges(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                   const SimulationModel& model, const Step& step);

}  // namespace drape
