#include "cloth/air.h"

#include "shared/simulation_types.h"

namespace drape {

std::uint32_t air_of(const CutTopology& topology, int column, int row) {
    const Grid& uncut = topology.cloth().grid;
    const auto quarter = [&](int x, int y, std::uint32_t bit) { return uncut.cell(x, y) != 0 ? bit : 0u; };
    const auto held = [&](int x, int y, float glsl::vec4::*along, std::uint32_t bit) {
        if (x < 0 || y < 0) return 0u;
        const std::uint32_t first = uncut.particle(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        return topology.whole_spring_shares()[first].*along > 0 ? bit : 0u;
    };
    return quarter(column - 1, row - 1, glsl::air_up_left) | quarter(column, row - 1, glsl::air_up_right) |
           quarter(column - 1, row, glsl::air_down_left) | quarter(column, row, glsl::air_down_right) |
           held(column - 1, row, &glsl::vec4::x, glsl::air_left) | held(column, row, &glsl::vec4::x, glsl::air_right) |
           held(column, row - 1, &glsl::vec4::y, glsl::air_up) | held(column, row, &glsl::vec4::y, glsl::air_down);
}

std::vector<std::uint32_t> air_bits(const CutTopology& topology) {
    const glsl::ivec2 size = topology.grid().size();
    std::vector<std::uint32_t> bits;
    if (!topology.masked()) return bits;
    for (int row = 0; row < size.y; ++row)
        for (int column = 0; column < size.x; ++column) bits.push_back(air_of(topology, column, row));
    return bits;
}

}  // namespace drape
