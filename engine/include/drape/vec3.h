// Points, directions and extents are these.
#pragma once

#include <array>

namespace drape {

/// x, y, z
using Vec3 = std::array<double, 3>;

}  // namespace drape
