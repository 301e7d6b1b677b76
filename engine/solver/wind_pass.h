// Force of the wind on every particle: drag and lift per triangle.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position, displacement and the wind; writes wind_force.
void add_wind(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
              const Step& step);

}  // namespace drape
