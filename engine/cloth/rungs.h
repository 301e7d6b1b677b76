// A closed loop chooses the substeps of a frame from a ladder of numbers.
#pragma once

#include <cstdint>
#include <span>

#include "cloth/method.h"

namespace drape {

/// Returns the numbers of substeps per frame to choose from: ascending, even, up to the method's largest.
std::span<const std::uint32_t> substep_rungs(const Method& method);
/// Returns the index of the first rung with at least so many substeps, or of the last rung.
std::uint32_t first_rung(const Method& method, double substeps);

}  // namespace drape
