// Bending relaxed in one sweep per substep: for every method that iterates over springs or lines.
#pragma once

#include "cloth/method.h"

namespace drape {

/// Adds the elements of both axes, then the cells' twist, to the steps taken once: relaxation. What a sweep cannot
/// follow is softened, and said.
void add_bend_sweep(const ClothGeometry& cloth, const MethodSettings& settings, MethodPlan& plan);

/// Adds the cells' twist alone: the lines bend by themselves. `compliance_factor`: of the method's own units on the
/// compliance m/(t h^2) of a backward Euler step.
void add_twist_sweep(const ClothGeometry& cloth, const MethodSettings& settings, double compliance_factor,
                     MethodPlan& plan);

}  // namespace drape
