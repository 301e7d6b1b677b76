#include "cloth/directions.h"

#include <cstdlib>

namespace drape {

SpringPass spring_pass(int direction, int parity, glsl::ivec2 grid) {
    const SpringDirection& row = spring_directions[static_cast<std::size_t>(direction)];
    // Springs along each axis before the parity split.
    const int columns = grid.x - std::abs(row.offset.x);
    const int rows = grid.y - std::abs(row.offset.y);
    const auto half = [parity](int count) { return (count - parity + 1) / 2; };
    return {direction, parity,
            {row.parity_axis == 0 ? half(columns) : columns, row.parity_axis == 1 ? half(rows) : rows}};
}

std::vector<SpringPass> spring_passes(glsl::ivec2 grid) {
    std::vector<SpringPass> passes;
    for (int direction = 0; direction < static_cast<int>(spring_directions.size()); ++direction)
        for (int parity = 0; parity < 2; ++parity) passes.push_back(spring_pass(direction, parity, grid));
    return passes;
}

}  // namespace drape
