// Solves the systems of lines by cyclic reduction in the order of operations of shaders/include/cyclic_group.h and
// cyclic_bent_group.h.
#pragma once

#include <vector>

#include "reference/kernels.h"

namespace drape {

/// Returns the unknowns of the system with these rows.
std::vector<glsl::vec3> reduced(std::vector<glsl::CyclicRow> rows);
std::vector<glsl::vec3> reduced(std::vector<glsl::BentRow> rows);

}  // namespace drape
