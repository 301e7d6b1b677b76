// Fits a grid to the outline of a panel of cloth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

using PanelPoint = std::array<double, 2>;  ///< m: along u, along v

/// A closed curve of straight pieces. Where it has a corner, a particle lies on that.
struct OutlineCurve {
    std::vector<PanelPoint> points;    ///< the last one is joined to the first one
    std::vector<std::size_t> corners;  ///< indices of points
};

/// A grid whose cells fill an outline. Its particles are where the cells of the full grid meet, but those on the rim,
/// which lie on the outline.
struct FittedPanel {
    std::array<std::uint32_t, 2> grid{};  ///< particles: columns, rows
    PanelPoint low{};                     ///< m: the corner of the outline's box that particle (0, 0) would lie on
    std::array<double, 2> size{};         ///< m: of that box
    std::vector<bool> missing;            ///< by cell, row by row: it is outside
    std::vector<PanelPoint> places;       ///< m from `low`, of every particle, row by row
};

/// Fits a grid of cells of about `spacing` (m) to curves; what an odd number of them goes around is cloth. A cell is
/// cloth if at least half of it is. Particles on the rim go to the nearest point of the curve that they follow, those
/// nearest to corners first, and then slide along it to even distances. Throws std::invalid_argument whose text says
/// what was expected: where the grid would have more than `most_particles`, no cell, or a rim that does not follow the
/// curves because these turn within less than a cell.
FittedPanel fit_panel(std::span<const OutlineCurve> curves, double spacing, std::uint64_t most_particles);

/// Returns what is wrong with the places of a cloth's particles on its panel, as text to follow "expected": their
/// number is wrong, one is not a number, a cell is turned over or too thin, or a spring far from as long as on the full
/// grid. Empty: nothing is wrong.
std::string panel_fault(const Cloth& cloth);

/// Returns the area of each cell of a cloth with an outline at rest over that of a cell of the full grid, row by row;
/// empty: the cloth has none. Missing cells have 1.
std::vector<double> cell_areas(const Cloth& cloth);

/// The triangles of a cell: (i,j) (i+1,j) (i,j+1), and (i+1,j) (i+1,j+1) (i,j+1).
inline constexpr std::uint32_t upper_triangle = 1, lower_triangle = 2;
/// Returns by cell the bits of its triangles, row by row; 0: it is missing. Beside an outline slivers are left out: the
/// surface ends at the diagonal where a triangle's height over it is less than a tenth of that on the full grid, as it
/// is where all three corners lie on a smooth rim.
std::vector<std::uint32_t> cell_triangles(const Cloth& cloth);

/// Returns by particle, for the springs to its right, below it, and below it on the right and on the left, what the
/// cells' shape makes of a spring's constant in a cell of the area 1: L0^2/L^2, L0 on the full grid, L at rest
/// (docs/physics.md 1).
std::vector<std::array<double, 4>> shape_factors(const Cloth& cloth);
/// Returns the largest of these factors times the area of a cell beside the spring.
double stiffest_shape(const Cloth& cloth);

}  // namespace drape
