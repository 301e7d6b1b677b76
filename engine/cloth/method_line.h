// Solves whole rows, columns and diagonals of springs at a time as tridiagonal systems. Without collisions it uses
// BDF2, or backward Euler where the control says so; with collisions always backward Euler (docs/solvers.md, "Line
// solve with BDF2").
#pragma once

#include "cloth/method.h"

namespace drape {

/// A spring in a line has at least this compliance m_inner/(k h_e^2), h_e^2 = h^2 or (4/9) h^2. A taut line without
/// compliance between two held particles has a singular system: all its multipliers may grow by one number. Since
/// tension is carried, a substep solves for its change alone, and what rounding makes of that is small: rigid cloth
/// pulled 0.1 % too long, whose rows and diagonals contradict each other, is within 1e-7 m of the even stretch at 1e-4
/// and at 1e-6. A sheet of 256 rows hanging on 20 substeps at 60 Hz is stretched by 2e-6 at its top.
inline constexpr double least_line_compliance = 1e-5;

MethodScheme line_scheme(const ClothGeometry& cloth, const MethodSettings& settings);

/// Returns substeps from h sqrt(a L)/l, a with the wind's share: 3.3 for a cloth held by an edge, whose lines carry it
/// alone, and 0.35 where crossing directions fight (two corners, a ball), a little less from 64 links on. There the RMS
/// stretch error of the drape from two corners falls as the square of the substeps (64 links: 0.60, 0.28, 0.11 % over
/// half a second with 8, 12, 20). It is 0.75 where nested boxes help at lone pins, and the more the finer the grid:
/// there the worst frame is 1 % off at 4.6, 7.5, 11 substeps of 64, 128, 256 links. Lone pins without nested boxes take
/// 10, 15, 24, 64 and 190 substeps of 64 to 1024 links. It is never fewer than the motion needs.
double line_substeps(const Hang& hang, double frame, double tolerance, const DeviceCosts& costs);

}  // namespace drape
