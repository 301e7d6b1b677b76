// The grid on the CPU: which cells and triangles exist, and the masses and spring stiffnesses that follow from them
// (docs/physics.md 1: each cell gives a quarter of its mass to each corner, half a spring to each side, and both its
// diagonals).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "drape/scene.h"
#include "shared/glsl_types.h"
#include "world/panel.h"

namespace drape {

class Grid {
  public:
    /// `holes` are boxes of particle indices whose inner cells are missing.
    Grid(std::uint32_t columns, std::uint32_t rows, std::span<const IndexBox> holes = {});
    /// Makes a cloth's grid, with its holes, without the slivers of its outline, and with the factors of its cells.
    explicit Grid(const Cloth& cloth);

    std::uint32_t columns() const { return columns_; }
    std::uint32_t rows() const { return rows_; }
    glsl::ivec2 size() const { return {static_cast<int>(columns_), static_cast<int>(rows_)}; }
    std::size_t particle_count() const { return std::size_t{columns_} * rows_; }
    std::uint32_t particle(std::uint32_t column, std::uint32_t row) const { return row * columns_ + column; }

    /// Returns the bits of cell (column, row); 0 outside the grid.
    std::uint32_t cell(int column, int row) const;
    /// Returns (columns-1) x (rows-1) cells, row by row.
    const std::vector<std::uint32_t>& cells() const { return cells_; }
    /// Removes a triangle that was cut: wind, normals and rest pieces ignore it; masses and springs stay.
    void remove_triangle(std::size_t cell, std::uint32_t which);
    /// Returns whether every cell exists and has the same factors; then no mask is needed anywhere.
    bool whole() const { return whole_; }

    /// Returns a cell's area at rest over that of a whole one: 1 but beside an outline; 0: the cell is missing.
    double cell_area(int column, int row) const;
    /// Returns the factor of a cell's mass; 0: the cell is missing.
    float cell_density(int column, int row) const;
    /// Returns the sum of the factors of the mass of the cells around a particle, in units of a quarter of a cell's
    /// mass.
    double cell_masses(std::uint32_t column, std::uint32_t row) const;
    /// Returns the inverse mass relative to an inner particle: 4 / cell_masses; 1 inside, 2 on a border, 4 at a
    /// corner, 0 for a particle without any cell.
    float relative_inverse_mass(std::uint32_t column, std::uint32_t row) const;
    /// Returns the factor of a cell's stiffness; 0: the cell is missing.
    float cell_stiffness(int column, int row) const;
    /// Returns by direction the share of the stiffness of the springs that this particle owns: 0, 0.5 or 1, or a value
    /// between, by the factors of the cells beside the spring.
    glsl::vec4 spring_shares(std::uint32_t column, std::uint32_t row) const;

    /// Returns three particle indices per existing triangle, cell by cell, upper before lower.
    std::vector<std::uint32_t> triangle_indices() const;

  private:
    float spring_share(int column, int row, std::size_t direction) const;
    std::uint32_t columns_, rows_;
    std::vector<std::uint32_t> cells_;
    std::vector<float> stiffness_, density_;    ///< factors by cell; empty: 1
    std::vector<double> areas_;                 ///< by cell, of an outline; empty: 1
    std::vector<std::array<double, 4>> shape_;  ///< factors by particle and direction, of an outline; empty: 1
    bool whole_ = true;
};

}  // namespace drape
