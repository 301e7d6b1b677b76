#include "cloth/directions.h"

#include <cstdlib>

namespace drape {

SpringPass spring_pass(int direction, int parity, glsl::ivec2 grid) {
    const SpringDirection& row = spring_directions[static_cast<std::size_t>(direction)];
    // The number of springs along each axis before they are split by parity.
    const int columns = grid.x - std::abs(row.offset.x);
    const int rows = grid.y - std::abs(row.offset.y);
    const auto half = [parity](int count) { return (count - parity + 1) / 2; };
    return {
        direction, parity, {row.parity_axis == 0 ? half(columns) : columns, row.parity_axis == 1 ? half(rows) : rows}};
}

std::vector<SpringPass> spring_passes(glsl::ivec2 grid) {
    std::vector<SpringPass> passes;
    for (int direction = 0; direction < static_cast<int>(spring_directions.size()); ++direction)
        for (int parity = 0; parity < 2; ++parity) passes.push_back(spring_pass(direction, parity, grid));
    return passes;
}

BendPass bend_pass(int axis, int colour, glsl::ivec2 grid) {
    const glsl::ivec2 offset = bend_axes[static_cast<std::size_t>(axis)].offset;
    // The middle particles of elements have the indices 1 to count - 2.
    const auto third = [colour](int count) { return count - 2 > colour ? (count - 2 - colour + 2) / 3 : 0; };
    return {axis, colour, {offset.x != 0 ? third(grid.x) : grid.x, offset.y != 0 ? third(grid.y) : grid.y}};
}

std::vector<BendPass> bend_passes(glsl::ivec2 grid) {
    std::vector<BendPass> passes;
    for (int axis = 0; axis < static_cast<int>(bend_axes.size()); ++axis)
        for (int colour = 0; colour < bend_colour_count; ++colour) passes.push_back(bend_pass(axis, colour, grid));
    return passes;
}

std::vector<TwistPass> twist_passes(glsl::ivec2 grid) {
    std::vector<TwistPass> passes;
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) passes.push_back({{x, y}, {(grid.x - x) / 2, (grid.y - y) / 2}});
    return passes;
}

}  // namespace drape
