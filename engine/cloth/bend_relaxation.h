// Methods that iterate over springs or lines relax bending in one pass per substep.
#pragma once

#include "cloth/method.h"

namespace drape {

/// b h^2/m_inner of elements along rows and columns, and of cells.
struct BendStiffness {
    double row, column, twist;
    BendStiffness times(double factor) const { return {factor * row, factor * column, factor * twist}; }
};

/// Returns the push constants of the step that computes the rest positions of bending elements in cloth that rests
/// bent. The two arguments are the elements' stiffness in an Euler step and in a BDF2 step.
glsl::BendTargetPush bend_target_constants(const ClothGeometry& cloth, bool gathers, const BendStiffness& euler,
                                           const BendStiffness& bdf2);

/// Adds the bending elements of both axes, then the twist of the cells, to the steps that relaxation takes once per
/// substep. Stiffness that one pass cannot follow is softened, and a compromise is noted.
void add_bend_relaxation(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);

/// Factors on the compliance m/(t h^2) that a step has in backward Euler.
struct StepFactors {
    double bdf2;   ///< for a BDF2 step
    double least;  ///< for the steps by which stiffness counts as followed
};

/// Adds the cells' twist alone, because the line solve includes bending along lines.
void add_twist_relaxation(const ClothGeometry& cloth, const MethodSettings& settings, const StepFactors& factors,
                          MethodScheme& scheme);

}  // namespace drape
