#include "twin/tear_twin.h"

#include "cloth/tear.h"
#include "cloth/texels.h"
#include "twin/kernels.h"

namespace drape {

using namespace glsl;

std::vector<vec4> tear_loads(const CutTopology& topology, const std::vector<vec4>& position) {
    const ClothGeometry& cloth = topology.cloth();
    const TearPush push = tear_push(cloth);
    const auto place = [&](int x, int y) { return at(cloth.grid, {x, y}); };
    const auto particle = [&](int x, int y) { return xyz(position[place(x, y)]); };
    const auto shares = [&](int x, int y) {
        return topology.masked() ? topology.spring_shares()[place(x, y)] : vec4{1, 1, 1, 1};
    };
    const auto rest = [&](float flat, int x, int y, std::size_t direction) {
        return cloth.rest_length(flat, place(x, y), direction);
    };
    const auto diagonals = [&](int x, int y) {
        if (x < 0 || y < 0 || x + 1 >= push.grid.x || y + 1 >= push.grid.y) return 0.0f;
        return diagonal_strains(particle(x, y), particle(x + 1, y), particle(x, y + 1), particle(x + 1, y + 1),
                                shares(x, y).z, shares(x + 1, y).w,
                                {rest(push.rest_diagonal, x, y, 2), rest(push.rest_diagonal, x + 1, y, 3)},
                                push.compression);
    };
    std::vector<vec4> loads(position.size(), {0, 0, 0, 0});
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const vec4 limits = cloth.tear_limits[place(x, y)], share = shares(x, y);
            const bool shears = limits.z != 0.0f || limits.w != 0.0f;
            const auto around = [&](int left, int up) {
                return shears ? diagonals(x - left, y - up) + diagonals(x, y) : 0.0f;
            };
            if (x + 1 < push.grid.x && share.x != 0.0f)
                loads[place(x, y)].x = tear_load(balancing_strain(particle(x, y), particle(x + 1, y),
                                                                  rest(push.rest_row, x, y, 0), push.compression),
                                                 around(0, 1), limits.z, limits.x);
            if (y + 1 < push.grid.y && share.y != 0.0f)
                loads[place(x, y)].y = tear_load(balancing_strain(particle(x, y), particle(x, y + 1),
                                                                  rest(push.rest_column, x, y, 1), push.compression),
                                                 around(1, 0), limits.w, limits.y);
        }
    return loads;
}

}  // namespace drape
