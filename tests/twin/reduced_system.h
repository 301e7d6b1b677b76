// Solves the systems of lines by cyclic reduction in the order of operations of shaders/include/cyclic_group.h,
// cyclic_bent_group.h and part_group.h.
#pragma once

#include <vector>

#include "twin/kernels.h"

namespace drape {

/// Returns the unknowns of the system with these rows.
std::vector<glsl::vec3> reduced(std::vector<glsl::CyclicRow> rows);
std::vector<glsl::vec3> reduced(std::vector<glsl::BentRow> rows);
/// The same in parts, by subgroups of so many invocations.
std::vector<glsl::vec3> reduced_in_parts(std::vector<glsl::CyclicRow> rows, std::uint32_t subgroup);

}  // namespace drape
