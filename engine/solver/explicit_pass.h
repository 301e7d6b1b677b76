// The explicit micro-step: one pass per substep that gathers the springs around every particle, or one per
// stream_steps substeps that streams down the rows.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position, displacement, both remainders [, wind_force, spring shares]; writes their spare images, which become
/// the state. After the first substep of a frame it begins with X += d.
void add_explicit_step(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
