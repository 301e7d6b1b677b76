// The constants of a cloth's springs and bending elements (docs/physics.md 1). Pure.
#pragma once

#include <array>
#include <cstdint>

#include "cloth/directions.h"
#include "drape/scene.h"

namespace drape {

/// Stands for rigid springs where a finite stiffness is needed, N/m: far above what any substep resolves.
inline constexpr double rigid_stiffness = 1e12;

/// Of one cloth, in order of the direction table.
struct StiffnessConstants {
    PerDirection<double> spring{};       ///< N/m, away from borders
    PerDirection<double> rest_length{};  ///< m
    std::array<double, 2> bend{};        ///< N/m: energy of an element bend/2 |x1 - 2 x2 + x3|^2; along columns, rows
    double twist = 0;                    ///< N/m: energy of a cell twist/2 |x00 - x10 - x01 + x11|^2
};

/// On cells of spacing[0] x spacing[1] metres.
StiffnessConstants stiffness_constants(const Stiffness& stiffness, const double (&spacing)[2]);

}  // namespace drape
