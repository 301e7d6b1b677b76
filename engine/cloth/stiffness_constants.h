#pragma once

#include <array>
#include <cstdint>

#include "cloth/directions.h"
#include "drape/scene.h"

namespace drape {

/// The stiffness of rigid springs where a finite number is needed, N/m: far above what any substep resolves.
inline constexpr double rigid_stiffness = 1e12;

/// The constants of one cloth's springs and bending elements, in the order of the direction table (docs/physics.md 1).
struct StiffnessConstants {
    PerDirection<double> spring{};       ///< N/m, away from borders
    PerDirection<double> rest_length{};  ///< m
    std::array<double, 2> bend{};        ///< N/m: energy of an element bend/2 |x1 - 2 x2 + x3|^2; along columns, rows
    double twist = 0;                    ///< N/m: energy of a cell twist/2 |x00 - x10 - x01 + x11|^2
};

/// Returns the constants for cells of spacing[0] x spacing[1] metres.
StiffnessConstants stiffness_constants(const Stiffness& stiffness, const std::array<double, 2>& spacing);

}  // namespace drape
