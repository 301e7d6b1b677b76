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

std::uint32_t Grid::cell(int column, int row) const {
    if (column < 0 || row < 0 || column >= size().x - 1 || row >= size().y - 1) return 0;
    return cells_[static_cast<std::size_t>(row) * (columns_ - 1) + static_cast<std::size_t>(column)];
}

void Grid::remove_triangle(std::size_t cell, std::uint32_t which) {
    cells_[cell] &= ~which;
    whole_ = false;
}

float Grid::relative_inverse_mass(std::uint32_t column, std::uint32_t row) const {
    const int i = static_cast<int>(column), j = static_cast<int>(row);
    int count = 0;
    for (int dj = -1; dj <= 0; ++dj)
        for (int di = -1; di <= 0; ++di) count += cell(i + di, j + dj) != 0;
    return count == 0 ? 0.0f : 4.0f / static_cast<float>(count);
}

float Grid::spring_share(int column, int row, std::size_t direction) const {
    const glsl::ivec2 offset = spring_directions[direction].offset;
    const auto present = [this](int i, int j) { return cell(i, j) != 0 ? 1.0f : 0.0f; };
    if (offset.y == 0) return 0.5f * (present(column, row - 1) + present(column, row));
    if (offset.x == 0) return 0.5f * (present(column - 1, row) + present(column, row));
    return present(offset.x < 0 ? column - 1 : column, row);
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
