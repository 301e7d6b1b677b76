// This is the cut pass in plain C++, with the shader's own predicate.
#pragma once

#include <vector>

#include "cloth/cut_topology.h"

namespace drape {

/// Returns the cuts in `position` (one texel per particle), equal to the device's images bit for bit.
CutFindings find_cuts(const CutTopology& topology, const std::vector<glsl::vec4>& position,
                      const std::vector<glsl::CutterTriangle>& cutters);

}  // namespace drape
