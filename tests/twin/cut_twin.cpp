#include "twin/cut_twin.h"

#include "cloth/texels.h"
#include "twin/kernels.h"

namespace drape {

using namespace glsl;

namespace {

float first_crossing(float found, vec3 p, vec3 q, const CutterTriangle& cutter) {
    return found >= 0.0f ? found : crossing_fraction(p, q, xyz(cutter.a), xyz(cutter.b), xyz(cutter.c));
}

bool intersects(vec3 p, vec3 q, vec3 r, const CutterTriangle& cutter) {
    return triangles_intersect(p, q, r, xyz(cutter.a), xyz(cutter.b), xyz(cutter.c));
}

}  // namespace

CutFindings find_cuts(const CutTopology& topology, const std::vector<vec4>& position,
                      const std::vector<CutterTriangle>& cutters) {
    const Grid& grid = topology.grid();
    const std::uint32_t columns = grid.columns(), rows = grid.rows();
    CutFindings found{std::vector<std::uint32_t>(grid.cells().size() * 2),
                      std::vector<vec4>(grid.particle_count(), {not_crossed, not_crossed, not_crossed, not_crossed})};
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t particle = grid.particle(column, row);
            const bool has_right = column + 1 < columns, has_below = row + 1 < rows, has_left = column > 0;
            const vec3 here = xyz(position[particle]);
            vec4& fraction = found.fractions[particle];
            bool upper = false, lower = false;
            for (const CutterTriangle& cutter : cutters) {
                if (cutter.a.w == 0.0f) break;
                if (has_right) fraction.x = first_crossing(fraction.x, here, xyz(position[particle + 1]), cutter);
                if (!has_below) continue;
                const vec3 below = xyz(position[particle + columns]);
                fraction.y = first_crossing(fraction.y, here, below, cutter);
                if (has_left)
                    fraction.w = first_crossing(fraction.w, here, xyz(position[particle + columns - 1]), cutter);
                if (!has_right) continue;
                const vec3 right = xyz(position[particle + 1]), across = xyz(position[particle + columns + 1]);
                fraction.z = first_crossing(fraction.z, here, across, cutter);
                upper = upper || intersects(here, right, below, cutter);
                lower = lower || intersects(right, across, below, cutter);
            }
            if (topology.masked()) {
                const vec4& share = topology.spring_shares()[particle];
                if (share.x == 0.0f) fraction.x = not_crossed;
                if (share.y == 0.0f) fraction.y = not_crossed;
                if (share.z == 0.0f) fraction.z = not_crossed;
                if (share.w == 0.0f) fraction.w = not_crossed;
            }
            if (!has_right || !has_below) continue;
            const std::size_t cell = std::size_t{row} * (columns - 1) + column;
            const std::uint32_t present = grid.cells()[cell];
            found.triangle_flags[2 * cell] = upper && (present & upper_triangle);
            found.triangle_flags[2 * cell + 1] = lower && (present & lower_triangle);
        }
    return found;
}

}  // namespace drape
