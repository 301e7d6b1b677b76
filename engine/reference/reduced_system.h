// Solves tridiagonal systems by cyclic reduction in the order of operations of shaders/include/cyclic_group.h.
#pragma once

#include <vector>

#include "reference/kernels.h"

namespace drape {

/// Returns the unknowns of the system with these rows.
std::vector<glsl::vec3> reduced(std::vector<glsl::CyclicRow> rows);

}  // namespace drape
