// Pins that move along key frames, and pins that let go.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Before the force: sets w of released particles and their first increment. Reads and writes position,
/// displacement and its remainder [, line control]; reads the tensions and spring shares when springs act after the
/// force.
void add_pin_release(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

/// After the force: displacement of held particles to their pin's motion (reads position, writes displacement).
void add_pin_motion(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
