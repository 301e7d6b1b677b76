// Distances on the flat cloth of a panel, beside those of the full grid.
#pragma once

#include "cloth/cloth_model.h"

namespace drape {

/// Returns how near two primitives (particle and triangle, or two edges) that share no corner and are at most four
/// columns and rows apart lie on the flat cloth, over how near they would on the full grid, of the pair for which that
/// is least, at most 1. It is 1 for cloth without an outline.
double least_flat_share(const ClothModel& model);

}  // namespace drape
