// What springs hold together, of a cloth that was cut.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "cloth/cut_topology.h"
#include "cloth/directions.h"

namespace drape::verify {

/// For each particle the number of one particle of its piece, the same for all of them.
inline std::vector<std::size_t> pieces(const CutTopology& topology) {
    const Grid& grid = topology.cloth().grid;
    std::vector<std::size_t> parent(grid.particle_count());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const std::size_t here = grid.particle(column, row);
            const glsl::vec4 share =
                topology.masked() ? topology.spring_shares()[here] : grid.spring_shares(column, row);
            const float shares[4] = {share.x, share.y, share.z, share.w};
            for (std::size_t k = 0; k < 4; ++k) {
                const glsl::ivec2 offset = spring_directions[k].offset;
                const int x = static_cast<int>(column) + offset.x, y = static_cast<int>(row) + offset.y;
                if (shares[k] == 0 || x < 0 || x >= grid.size().x || y >= grid.size().y) continue;
                parent[root(here)] = root(static_cast<std::size_t>(y * grid.size().x + x));
            }
        }
    for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = root(k);
    return parent;
}

}  // namespace drape::verify
