#include "cloth/grid.h"

#include <cstdlib>

#include "cloth/directions.h"

namespace drape {

Grid::Grid(std::uint32_t columns, std::uint32_t rows, std::span<const IndexBox> holes)
    : columns_(columns), rows_(rows), cells_(std::size_t{columns - 1} * (rows - 1), upper_triangle | lower_triangle) {
    for (const IndexBox& hole : holes)
        for (std::uint32_t row = hole.first[1]; row < hole.last[1]; ++row)
            for (std::uint32_t column = hole.first[0]; column < hole.last[0]; ++column) {
                cells_[std::size_t{row} * (columns_ - 1) + column] = 0;
                whole_ = false;
            }
}

Grid::Grid(const Cloth& cloth) : Grid(cloth.grid[0], cloth.grid[1], cloth.holes) {
    stiffness_ = cloth.cell_stiffness;
    density_ = cloth.cell_density;
    if (!cloth.panel.empty()) {
        areas_ = cell_areas(cloth);
        for (std::vector<float>* factors : {&stiffness_, &density_}) {
            factors->resize(areas_.size(), 1);
            for (std::size_t cell = 0; cell < areas_.size(); ++cell)
                (*factors)[cell] = static_cast<float>(double{(*factors)[cell]} * areas_[cell]);
        }
        shape_ = shape_factors(cloth);
        cells_ = cell_triangles(cloth);
    }
    whole_ = whole_ && stiffness_.empty() && density_.empty();
}

std::uint32_t Grid::cell(int column, int row) const {
    if (column < 0 || row < 0 || column >= size().x - 1 || row >= size().y - 1) return 0;
    return cells_[static_cast<std::size_t>(row) * (columns_ - 1) + static_cast<std::size_t>(column)];
}

void Grid::remove_triangle(std::size_t cell, std::uint32_t which) {
    cells_[cell] &= ~which;
    whole_ = false;
}

double Grid::cell_masses(std::uint32_t column, std::uint32_t row) const {
    const int i = static_cast<int>(column), j = static_cast<int>(row);
    double sum = 0;
    for (const int y : {j - 1, j})
        for (const int x : {i - 1, i}) sum += cell_density(x, y);
    return sum;
}

double Grid::cell_area(int column, int row) const {
    if (cell(column, row) == 0) return 0;
    return areas_.empty() ? 1.0 : areas_[static_cast<std::size_t>(row) * (columns_ - 1) + column];
}

float Grid::cell_density(int column, int row) const {
    if (cell(column, row) == 0) return 0;
    return density_.empty() ? 1.0f : density_[static_cast<std::size_t>(row) * (columns_ - 1) + column];
}

float Grid::relative_inverse_mass(std::uint32_t column, std::uint32_t row) const {
    const auto sum = static_cast<float>(cell_masses(column, row));
    return sum > 0 ? 4.0f / sum : 0.0f;
}

float Grid::cell_stiffness(int column, int row) const {
    if (cell(column, row) == 0) return 0;
    return stiffness_.empty() ? 1.0f : stiffness_[static_cast<std::size_t>(row) * (columns_ - 1) + column];
}

float Grid::spring_share(int column, int row, std::size_t direction) const {
    const glsl::ivec2 offset = spring_directions[direction].offset;
    const float cells = offset.y == 0   ? 0.5f * (cell_stiffness(column, row - 1) + cell_stiffness(column, row))
                        : offset.x == 0 ? 0.5f * (cell_stiffness(column - 1, row) + cell_stiffness(column, row))
                                        : cell_stiffness(offset.x < 0 ? column - 1 : column, row);
    if (shape_.empty()) return cells;
    const std::uint32_t owner = particle(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    return static_cast<float>(double{cells} * shape_[owner][direction]);
}

glsl::vec4 Grid::spring_shares(std::uint32_t column, std::uint32_t row) const {
    const int i = static_cast<int>(column), j = static_cast<int>(row);
    return {spring_share(i, j, 0), spring_share(i, j, 1), spring_share(i, j, 2), spring_share(i, j, 3)};
}

std::vector<std::uint32_t> Grid::triangle_indices() const {
    std::vector<std::uint32_t> indices;
    indices.reserve(cells_.size() * 6);
    for (std::uint32_t j = 0; j + 1 < rows_; ++j)
        for (std::uint32_t i = 0; i + 1 < columns_; ++i) {
            const std::uint32_t bits = cells_[std::size_t{j} * (columns_ - 1) + i];
            const std::uint32_t a = particle(i, j), b = particle(i + 1, j), c = particle(i, j + 1), d = c + 1;
            if (bits & upper_triangle) indices.insert(indices.end(), {a, b, c});
            if (bits & lower_triangle) indices.insert(indices.end(), {b, d, c});
        }
    return indices;
}

}  // namespace drape
