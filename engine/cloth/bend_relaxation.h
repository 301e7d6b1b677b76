// Methods that iterate over springs or lines relax bending in one pass per substep.
#pragma once

#include "cloth/method.h"

namespace drape {

/// b h^2/m_inner of elements along rows and columns, and of cells.
struct BendStiffness {
    double row, column, twist;
    BendStiffness times(double factor) const { return {factor * row, factor * column, factor * twist}; }
};

/// Returns the push constants of the step that finds what cloth that rests bent is at rest, where elements have so much
/// stiffness in an Euler step and in one of BDF2.
glsl::BendTargetPush bend_target_constants(const ClothGeometry& cloth, bool gathers, const BendStiffness& euler,
                                           const BendStiffness& bdf2);

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
