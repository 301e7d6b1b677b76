// Positions to the host, for exports and checks; never on the simulation's way.
#pragma once

#include "passes/pass_kit.h"

namespace drape {

/// Name of the host_output buffer that `add_position_readback` fills: particles x 16 bytes, xyz metres and w.
std::string position_readback_name(const ClothModel& cloth);

/// Copies the position image into a host_output buffer.
void add_position_readback(graph::Graph& graph, ClothState& state);

}  // namespace drape
