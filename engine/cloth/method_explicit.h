// Takes one explicit micro-step per substep: each particle gathers what its springs and bending elements do.
#pragma once

#include "cloth/method.h"

namespace drape {

/// The stiffness that the micro-step applies, as k h^2/m of an inner particle: dimensionless.
struct RelativeStiffness {
    PerDirection<double> spring{};
    std::array<double, 2> bend{};
    double twist = 0;
    /// Shares are applied / wanted stiffness, 1 = nothing is softened: along columns, along rows, diagonals, bending.
    double columns_share = 1, rows_share = 1, shear_share = 1, bend_share = 1;
    double full_substeps_factor = 1;  ///< times as many substeps would need no softening
    bool softened() const { return full_substeps_factor > 1; }
};

/// Softens stiffness that the step cannot follow stably. Per axis the sum S of the axis spring and its share of the
/// diagonals, and Q, a quarter of the bending's largest eigenvalue (16 (b0 + b1 + t) h^2/m, the twist's included),
/// satisfy Q <= 0.3 and S (1 + 2 kappa) + Q/2 <= 0.45. The cells' own eigenvalues bound those of any assembly of them
/// (borders, holes, cuts); flat cloth would be stable up to S (1 + 2 kappa) + Q = 1, hugely stretched cloth, whose
/// springs resist in every direction, up to half of that.
RelativeStiffness relative_stiffness(const StiffnessConstants& wanted, const std::array<double, 2>& spacing,
                                     double inner_mass, double substep_length, double strain_damping);

MethodScheme explicit_scheme(const ClothGeometry& cloth, const MethodSettings& settings);

/// Returns the substeps that keep a tolerance. Softened springs have the strain g L/c_s^2 at the top, and 1/sqrt 6 of
/// it as RMS over rows and columns, where c_s^2 = K l^2/h^2 and K = 0.45/((1 + r_s)(1 + 2 kappa)), r_s = 0.1, kappa =
/// 0.2 (docs/solvers.md, "Explicit micro-step").
double explicit_substeps(const Hang& hang, double frame, double tolerance, const DeviceCosts& costs);

}  // namespace drape
