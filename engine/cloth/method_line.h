// Whole rows, columns and diagonals of springs solved at a time as tridiagonal systems; BDF2 where nothing collides,
// with backward Euler where the control says so, else backward Euler alone (docs/solvers.md, "Line solve with BDF2").
#pragma once

#include "cloth/method.h"

namespace drape {

/// Smallest compliance m_inner/(k h^2) of a spring in a line. A taut line without compliance between two held particles
/// has a singular system: all its multipliers may grow by one number. From 1e-4 on rounding moves no particle visibly;
/// but where rows and diagonals contradict each other (rigid cloth pulled 0.1 % too long) they push each other about,
/// by 1e-4 m in a sheet of a metre, and at 1e-3 by 5e-7 m. A sheet of 256 rows hanging on 20 substeps at 60 Hz is
/// stretched by 2e-4 at its top.
inline constexpr double least_line_compliance = 1e-3;

MethodPlan plan_line(const ClothGeometry& cloth, const MethodSettings& settings);

/// h sqrt(g L)/l at which a substep is cheapest, sweeps and the further iterations that the tolerance asks for taken
/// together: 1.3 for a cloth held by an edge, whose lines carry it alone; 0.45 where crossing directions fight (two
/// corners, a ball), less from 64 links on, since iterations carry news by one line only. Measured on ten scenes of
/// `bench accuracy --filter random` (seed 1000); docs/solvers.md has 0.67 for a single sweep to 0.04 %.
double line_substeps(const Hang& hang, double frame, double tolerance);

}  // namespace drape
