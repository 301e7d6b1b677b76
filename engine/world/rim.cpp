#include "world/rim.h"

#include <utility>

namespace drape {

std::vector<std::vector<std::uint32_t>> rims_of(const std::array<std::uint32_t, 2>& grid,
                                                const std::vector<bool>& missing) {
    constexpr std::uint32_t outside = UINT32_MAX;
    const auto [columns, rows] = grid;
    const auto is_cloth = [&, cells = std::int64_t{columns} - 1](std::int64_t column, std::int64_t row) {
        if (column < 0 || row < 0 || column >= cells || row + 1 >= rows) return false;
        return !missing[static_cast<std::size_t>(row * cells + column)];
    };
    std::vector<std::uint32_t> next(std::size_t{columns} * rows, outside);
    const auto particle = [width = columns](std::int64_t column, std::int64_t row) {
        return static_cast<std::uint32_t>(row * width + column);
    };
    for (std::int64_t row = 0; row + 1 < rows; ++row)
        for (std::int64_t column = 0; column + 1 < columns; ++column) {
            if (!is_cloth(column, row)) continue;
            if (!is_cloth(column, row - 1)) next[particle(column, row)] = particle(column + 1, row);
            if (!is_cloth(column + 1, row)) next[particle(column + 1, row)] = particle(column + 1, row + 1);
            if (!is_cloth(column, row + 1)) next[particle(column + 1, row + 1)] = particle(column, row + 1);
            if (!is_cloth(column - 1, row)) next[particle(column, row + 1)] = particle(column, row);
        }
    std::vector<std::vector<std::uint32_t>> rims;
    for (std::uint32_t start = 0; start < next.size(); ++start) {
        if (next[start] == outside) continue;
        std::vector<std::uint32_t>& rim = rims.emplace_back();
        for (std::uint32_t at = start; next[at] != outside;) {
            rim.push_back(at);
            at = std::exchange(next[at], outside);
        }
    }
    return rims;
}

}  // namespace drape
