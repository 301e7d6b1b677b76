// The constants of the line solver: the lines of each spring direction with their compliance, and the prediction in
// second order (docs/solvers.md, "Line solve with BDF2"). Pure.
#pragma once

#include <vector>

#include "cloth/stiffness_constants.h"
#include "shared/line_types.h"
#include "shared/simulation_types.h"

namespace drape {

/// Smallest compliance m_inner/(k h^2) of a spring in a line. A taut line without compliance between two held particles
/// has a singular system: all its multipliers may grow by one number. From 1e-4 on rounding moves no particle visibly;
/// but where rows and diagonals contradict each other (rigid cloth pulled 0.1 % too long) they push each other about,
/// by 1e-4 m in a sheet of a metre, and at 1e-3 by 5e-7 m. A sheet of 256 rows hanging on 20 substeps at 60 Hz is
/// stretched by 2e-4 at its top.
inline constexpr double least_line_compliance = 1e-3;

/// All lines of one direction.
struct LineWork {
    int direction;        ///< row of spring_directions = channel
    bool compliant;       ///< of finite stiffness: its tension accounts for a stretch
    glsl::LinePush push;  ///< first_iteration is set per iteration
};

/// What the constants follow from.
struct LineSettings {
    glsl::ivec2 grid;
    double inner_mass;      ///< kg
    double substep_length;  ///< s
    double damping;         ///< 1/s
    bool rigid;             ///< whatever its compliance here, the springs are not to stretch
    bool second_order;      ///< BDF2, with backward Euler where the control says so; else backward Euler alone
};

/// In order of solution: both diagonals, rows, columns; without those of zero stiffness.
std::vector<LineWork> line_passes(const StiffnessConstants& stiffness, const LineSettings& settings);

/// Stiffness (N/m) that a line's spring of constant `stiffness` has, given the least compliance.
double line_stiffness(double stiffness, const LineSettings& settings);

/// Compliance m/(k h^2) of a spring or bending element of constant k (N/m) in the method's own units: BDF2 multiplies
/// it by (9/4) (1 + (2/3) c h).
double method_compliance(double constant, const LineSettings& settings);

/// `euler`: the constants of a backward Euler step.
glsl::PredictPush predict_constants(const glsl::ForcePush& euler, const LineSettings& settings, const Vec3& gravity);

}  // namespace drape
