// The explicit micro-step: one pass per substep that gathers the springs around every particle.
#pragma once

#include "passes/pass_kit.h"

namespace drape {

/// Reads position, displacement [, wind_force, spring shares]; writes the spare images, which become position and
/// displacement, and both remainders. After the first substep of a frame it begins with X += d.
void add_explicit_step(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);

}  // namespace drape
