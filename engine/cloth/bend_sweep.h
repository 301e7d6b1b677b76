// Bending relaxed in one sweep per substep: for every method that iterates over springs or lines.
#pragma once

#include "cloth/method.h"

namespace drape {

/// Adds the elements of both axes, then the cells' twist, to the steps taken once: relaxation. What a sweep cannot
/// follow is softened, and said.
void add_bend_sweep(const ClothGeometry& cloth, const MethodSettings& settings, MethodPlan& plan);

/// What a step multiplies the compliance m/(t h^2) of a backward Euler step by.
struct StepFactors {
    double bdf2;   ///< a BDF2 step
    double least;  ///< that of the steps whose stiffness counts as followed
};

/// Adds the cells' twist alone: the lines bend by themselves.
void add_twist_sweep(const ClothGeometry& cloth, const MethodSettings& settings, const StepFactors& factors,
                     MethodPlan& plan);

}  // namespace drape
