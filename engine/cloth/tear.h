// The limits at which a cloth tears, and the choice of the springs that tear: a tear is a line.
#pragma once

#include <vector>

#include "cloth/cut_topology.h"
#include "drape/scene.h"
#include "shared/cut_types.h"

namespace drape {

/// Returns for each particle, row by row, the limits of the springs that it owns. x, y: the strain of the spring along
/// the row and along the column at which it tears by itself (m/m). z, w: what the summed strains of the diagonals
/// beside it, weighted by their shares, add to that strain; 0 where the limit is a strain. The tension of a cloth, N/m,
/// is the force that its springs, diagonals included, transmit through a line perpendicular to one of them, divided by
/// the width that the spring's cells give it (docs/physics.md 8).
std::vector<glsl::vec4> tear_limits(const Cloth& cloth, const Grid& grid);

glsl::TearPush tear_push(const ClothGeometry& cloth);

/// Chooses the springs that tear at the end of a frame. `loads` are the loads over their limits of the springs along
/// row (x) and column (y) that each particle owns. A tear goes on from where the cloth is torn or cut: through the cell
/// behind a spring that ended, by the side that bears most, as long as that is more than its limit; a cell that it has
/// touched in this frame is left alone. Only in a piece in which none goes on a new one begins, at the spring that
/// bears most (of equal ones the first), to both sides. A tear that comes to a border or to another may have parted the
/// piece, so nothing else of that piece tears in the frame. Diagonals end where both ways around a cell between
/// their ends have. The fractions are one half.
CutFindings torn_springs(const CutTopology& topology, const std::vector<glsl::vec4>& loads);

}  // namespace drape
