#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "drape/scene.h"
#include "graph/graph.h"

namespace drape {

/// A cloth as the raster pass sees it. Images have one texel per particle, rgba32f: position (xyz metres) and normal
/// (xyz unit, pointing to the front; zero where there is none). Indices are uint32, row * columns + column, corners of
/// a triangle counter-clockwise seen from the front.
struct RasterCloth {
    std::string name;
    std::uint32_t columns = 0, rows = 0;
    double size_u = 1, size_v = 1;  ///< m along columns, rows, undeformed
    double thickness = 0;  ///< m; a collider that its triangles cut into is drawn farther away by this distance
    Appearance appearance;
    graph::Handle position, normal, indices;
    std::uint32_t index_count = 0;
    graph::Handle cut_vertices = {};   ///< valid on a cut cloth: the vertices with indices from columns * rows on
    graph::Handle spring_shares = {};  ///< valid with holes or cuts: 0 where a spring does not exist
    std::array<double, 2> rest_lengths{0, 0};  ///< m, of springs along columns, rows; 0: no such springs
};

}  // namespace drape
