// Positions from another device, for pictures that are drawn on one of their own.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Name of the host_input buffer that `add_position_upload` reads: particles x 16 bytes.
std::string position_upload_name(const ClothModel& cloth);

/// Copies that buffer into the cloth's position image.
void add_position_upload(graph::Graph& graph, ClothState& state);

}  // namespace drape
