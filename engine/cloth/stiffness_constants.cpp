#include "cloth/stiffness_constants.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

constexpr double elastic_limit = 0.45, bend_limit = 0.3;

}  // namespace

StiffnessConstants stiffness_constants(const Stiffness& stiffness, const double (&spacing)[2]) {
    const double dx = spacing[0], dy = spacing[1];
    const double stretch = stiffness.rigid ? rigid_stiffness : stiffness.stretch;
    const double shear = stiffness.rigid ? rigid_stiffness : stiffness.shear;
    StiffnessConstants constants;
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
        const SpringDirection& row = spring_directions[direction];
        const bool along_columns = row.offset.y == 0;
        constants.spring[direction] = row.family == SpringFamily::shear ? shear * (dx * dx + dy * dy) / (2 * dx * dy)
                                      : along_columns                   ? stretch * dy / dx
                                                                        : stretch * dx / dy;
        constants.rest_length[direction] = std::hypot(row.offset.x * dx, row.offset.y * dy);
    }
    constants.twist = 2 * stiffness.bend / (dx * dy);
    constants.bend = {stiffness.bend * dy / (dx * dx * dx), stiffness.bend * dx / (dy * dy * dy)};
    return constants;
}

ExplicitStiffness explicit_stiffness(const StiffnessConstants& wanted, const double (&spacing)[2], double inner_mass,
                                     double substep_length, double strain_damping) {
    const double scale = substep_length * substep_length / inner_mass;
    const double diagonal_squared = spacing[0] * spacing[0] + spacing[1] * spacing[1];
    ExplicitStiffness used;
    // Largest eigenvalue of a chain of bending elements: 16 b. Of a cell's twist, t c c^T with c = (1, -1, -1, 1),
    // against the quarter of a mass that the cell gives each of its corners: 4 t/(1/4) = 16 t. They add: all three are
    // largest for the checkerboard.
    const double bend = 4 * (wanted.bend[0] + wanted.bend[1] + wanted.twist) * scale;
    used.bend_share = std::min(1.0, bend_limit / std::max(bend, bend_limit));
    const double limit = elastic_limit - 0.5 * bend * used.bend_share;
    double worst = std::max(1.0, bend / bend_limit);
    double shares[2];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double cosine_squared = spacing[axis] * spacing[axis] / diagonal_squared;
        const double diagonals = wanted.spring[2] + wanted.spring[3];
        const double sum = (wanted.spring[axis] + diagonals * cosine_squared) * scale * (1 + 2 * strain_damping);
        shares[axis] = std::min(1.0, limit / std::max(sum, limit));
        worst = std::max(worst, (sum + 0.5 * bend) / elastic_limit);
    }
    used.columns_share = shares[0];
    used.rows_share = shares[1];
    used.shear_share = std::min(shares[0], shares[1]);
    used.spring = {wanted.spring[0] * scale * used.columns_share, wanted.spring[1] * scale * used.rows_share,
                   wanted.spring[2] * scale * used.shear_share, wanted.spring[3] * scale * used.shear_share};
    used.bend = {wanted.bend[0] * scale * used.bend_share, wanted.bend[1] * scale * used.bend_share};
    used.twist = wanted.twist * scale * used.bend_share;
    used.full_substeps_factor = std::sqrt(worst);
    return used;
}

}  // namespace drape
