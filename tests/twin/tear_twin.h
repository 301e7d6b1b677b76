// The tear pass once more in C++.
#pragma once

#include <vector>

#include "cloth/cut_topology.h"

namespace drape {

/// Returns the loads over their limits that the device finds, bit for bit (cloth/tear.h), of a cloth that tears.
std::vector<glsl::vec4> tear_loads(const CutTopology& topology, const std::vector<glsl::vec4>& position);

}  // namespace drape
