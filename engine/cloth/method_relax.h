// Relaxes springs direction by direction and parity by parity, as the 2004 slides outline the algorithm.
#pragma once

#include "cloth/method.h"

namespace drape {

MethodScheme relax_scheme(const ClothGeometry& cloth, const MethodSettings& settings);

/// Returns the substeps that keep a tolerance by the relaxation's law, as RMS over rows and columns: 0.83/sqrt 2 of N^2
/// g h^2/(2 L) = n g h^2/(2 l) (docs/physics.md 2).
double relax_substeps(const Hang& hang, double frame, double tolerance, const DeviceCosts& costs);

}  // namespace drape
