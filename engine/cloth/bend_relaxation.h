// Methods that iterate over springs or lines relax bending in one pass per substep.
#pragma once

#include "cloth/method.h"

namespace drape {

/// Adds what other steps of bending need of cloth that rests bent.
void add_bend_targets(const ClothGeometry& cloth, std::vector<MethodStep>& steps);

/// Adds the elements of both axes, then the cells' twist, to the steps taken once, for relaxation. What a sweep cannot
/// follow is softened, and said.
void add_bend_relaxation(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);

/// A step multiplies the compliance m/(t h^2) of a backward Euler step by these.
struct StepFactors {
    double bdf2;   ///< for a BDF2 step
    double least;  ///< for those steps whose stiffness counts as followed
};

/// Adds the cells' twist alone, because the lines bend by themselves.
void add_twist_relaxation(const ClothGeometry& cloth, const MethodSettings& settings, const StepFactors& factors,
                          MethodScheme& scheme);

}  // namespace drape
