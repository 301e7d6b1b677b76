// The constants of a cloth's springs and bending elements (docs/physics.md 1), and what of them an explicit micro-step
// can use without becoming unstable. Pure.
#pragma once

#include <array>
#include <cstdint>

#include "cloth/directions.h"
#include "scene/scene_description.h"

namespace drape {

/// Stands for rigid springs where a finite stiffness is needed, N/m: far above what any substep resolves.
inline constexpr double rigid_stiffness = 1e12;

/// Of one cloth, in order of the direction table.
struct StiffnessConstants {
    std::array<double, 4> spring{};       ///< N/m, away from borders
    std::array<double, 4> rest_length{};  ///< m
    std::array<double, 2> bend{};         ///< N/m: energy of an element bend/2 |x1 - 2 x2 + x3|^2; along columns, rows
    double twist = 0;                     ///< N/m: energy of a cell twist/2 |x00 - x10 - x01 + x11|^2
};

/// On cells of spacing[0] x spacing[1] metres.
StiffnessConstants stiffness_constants(const Stiffness& stiffness, const double (&spacing)[2]);

/// What the explicit micro-step uses, dimensionless: k h^2/m of an inner particle.
struct ExplicitStiffness {
    std::array<double, 4> spring{};
    std::array<double, 2> bend{};
    double twist = 0;
    /// Used / wanted: 1 = nothing softened. Along columns, along rows, diagonals, bending.
    double columns_share = 1, rows_share = 1, shear_share = 1, bend_share = 1;
    double full_substeps_factor = 1;  ///< times as many substeps would soften nothing
    bool softened() const { return full_substeps_factor > 1; }
};

/// Softens what the step could not follow. Per axis the sum S of the axis spring and its share of the diagonals, and Q,
/// a quarter of the bending's largest eigenvalue (16 (b0 + b1 + t) h^2/m, the twist's included), satisfy Q <= 0.3 and
/// S (1 + 2 kappa) + Q/2 <= 0.45. The cells' own eigenvalues bound those of any assembly of them (borders, holes,
/// cuts); flat cloth would be stable up to S (1 + 2 kappa) + Q = 1, hugely stretched cloth, whose springs resist in
/// every direction, up to half of that.
ExplicitStiffness explicit_stiffness(const StiffnessConstants& wanted, const double (&spacing)[2], double inner_mass,
                                     double substep_length, double strain_damping);

}  // namespace drape
