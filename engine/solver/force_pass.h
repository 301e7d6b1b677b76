// Verlet: finishes the last substep and predicts the next displacement; and the advance that ends a frame.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads and writes position, displacement and their remainders; reads wind_force when the scene has wind.
void add_force(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

/// Position += displacement, so that the position image holds the state of the frame.
void add_advance(graph::Graph& graph, Pipelines& pipelines, ClothState& state);

}  // namespace drape
