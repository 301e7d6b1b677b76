#pragma once

#include "cloth/grid.h"
#include "twin/kernels.h"

namespace drape {

/// Calls visit(cell, which) for the existing triangles around a particle, in the shaders' order.
template <class Visit>
void for_triangles_around(const Grid& grid, glsl::ivec2 particle, const Visit& visit) {
    for (int k = 0; k < glsl::triangles_around_particle; ++k) {
        const glsl::ivec4 around = glsl::triangle_around(k);
        const glsl::ivec2 cell{particle.x + around.x, particle.y + around.y};
        if (grid.cell(cell.x, cell.y) & static_cast<std::uint32_t>(around.z)) visit(cell, around.z);
    }
}

}  // namespace drape
