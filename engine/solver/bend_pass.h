// Relaxation of bending: one colour of one axis per pass, and of the cells' twist one colour per pass.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Both read position [, spring shares], read and write displacement.
void add_bend(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);
void add_twist(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
