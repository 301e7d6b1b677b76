// The check between two iterations: does the tolerance ask for another one? Decided on the device, without the host.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Reads position, displacement, tension of the stretch springs and stiffness where the cloth has it; writes the sizes
/// of the next iteration's dispatches (StepDispatch).
void add_check(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SimulationModel& model,
               const Step& step);

/// Copies the number of iterations that the frame has run to the host.
void add_iteration_readback(graph::Graph& graph, const ClothState& state);
std::string iteration_readback_name(const ClothModel& cloth);

}  // namespace drape
