// A saved state says by a checksum whether it is whole.
#pragma once

#include "drape/simulation.h"

namespace drape {

/// Puts the part "checksum": XXH3-128, low half first, of the number of the other parts and, in the order of their
/// names, the length and bytes of each name and content (engine/docs/checkpoint.md).
void seal(SimulationState& state);
/// Throws Error where the state is not as it was when it was sealed.
void expect_sealed(const SimulationState& state);

}  // namespace drape
