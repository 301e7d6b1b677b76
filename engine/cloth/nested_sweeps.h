// Nested sweeps of the line method around particles that are held alone (docs/solvers.md).
#pragma once

#include "cloth/method.h"

namespace drape {

/// Adds the sweeps around every held particle without a held neighbour to the steps of an iteration, after the lines of
/// the plan; or says why not. Sets its `nested_table`.
void add_nested_sweeps(const ClothGeometry& cloth, MethodPlan& plan);

}  // namespace drape
