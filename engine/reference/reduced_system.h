// Tridiagonal systems by cyclic reduction, as shaders/include/cyclic_group.h solves them, in its order of operations.
#pragma once

#include <vector>

#include "reference/kernels.h"

namespace drape {

/// The unknowns of a system, given its rows.
std::vector<glsl::vec3> reduced(std::vector<glsl::CyclicRow> rows);

}  // namespace drape
