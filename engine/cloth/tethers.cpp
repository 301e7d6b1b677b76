#include "cloth/tethers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "cloth/directions.h"
#include "cloth/texels.h"

namespace drape {

namespace {

struct Nearest {
    std::int32_t particle = -1;
    double distance = std::numeric_limits<double>::infinity();  ///< m
};

using Field = std::vector<Nearest>;

/// The box's particle nearest to a particle is found by clamping to the box's limits. If another pin has taken it over,
/// that pin holds it as well.
Field straight_distances(const Grid& grid, const std::array<double, 2>& spacing, const IndexBox& box) {
    Field field;
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const std::uint32_t x = std::clamp(column, box.first[0], box.last[0]),
                                y = std::clamp(row, box.first[1], box.last[1]);
            const auto steps = [](std::uint32_t a, std::uint32_t b) {
                return static_cast<double>(a) - static_cast<double>(b);
            };
            field.push_back({static_cast<std::int32_t>(grid.particle(x, y)),
                             std::hypot(steps(column, x) * spacing[0], steps(row, y) * spacing[1])});
        }
    return field;
}

/// Finds Dijkstra's shortest paths from all of the box's particles along the springs that exist.
Field path_distances(const Grid& grid, const std::array<double, 2>& spacing, const IndexBox& box,
                     const std::vector<glsl::vec4>& rest_scales) {
    Field field(grid.particle_count());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto reach = [&](std::uint32_t particle, std::int32_t anchor, double distance) {
        if (!(distance < field[particle].distance)) return;
        field[particle] = {anchor, distance};
        queue.emplace(distance, particle);
    };
    for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
        for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column)
            if (grid.relative_inverse_mass(column, row) > 0)
                reach(grid.particle(column, row), static_cast<std::int32_t>(grid.particle(column, row)), 0);
    const auto shares = [&](int x, int y) {
        const glsl::vec4 s = grid.spring_shares(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        return std::array<float, 4>{s.x, s.y, s.z, s.w};
    };
    const auto length_of = [&](std::uint32_t owner, std::size_t direction) {
        const glsl::ivec2 offset = spring_directions[direction].offset;
        const double flat = std::hypot(offset.x * spacing[0], offset.y * spacing[1]);
        return rest_scales.empty() ? flat : flat * static_cast<double>(component(rest_scales[owner], direction));
    };
    const glsl::ivec2 size = grid.size();
    while (!queue.empty()) {
        const auto [distance, particle] = queue.top();
        queue.pop();
        if (distance > field[particle].distance) continue;
        const int x = static_cast<int>(particle % grid.columns()), y = static_cast<int>(particle / grid.columns());
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
            for (const int sign : {1, -1}) {
                const glsl::ivec2 offset = spring_directions[direction].offset;
                const int to_x = x + sign * offset.x, to_y = y + sign * offset.y;
                if (to_x < 0 || to_y < 0 || to_x >= size.x || to_y >= size.y) continue;
                if (!(shares(sign > 0 ? x : to_x, sign > 0 ? y : to_y)[direction] > 0)) continue;
                const std::uint32_t to =
                    grid.particle(static_cast<std::uint32_t>(to_x), static_cast<std::uint32_t>(to_y));
                reach(to, field[particle].particle, distance + length_of(sign > 0 ? particle : to, direction));
            }
    }
    return field;
}

}  // namespace

std::vector<glsl::ParticleTethers> find_tethers(const Grid& grid, const std::array<double, 2>& spacing,
                                                const std::vector<Pin>& pins, double give,
                                                const std::vector<glsl::vec4>& rest_scales) {
    std::vector<std::array<Nearest, 2>> nearest(grid.particle_count());
    for (const Pin& pin : pins) {
        const Field field = grid.whole() && rest_scales.empty()
                                ? straight_distances(grid, spacing, pin.particles)
                                : path_distances(grid, spacing, pin.particles, rest_scales);
        for (std::size_t i = 0; i < field.size(); ++i) {
            auto& [first, second] = nearest[i];
            if (field[i].distance < first.distance) {
                second = first;
                first = field[i];
            } else if (field[i].distance < second.distance) {
                second = field[i];
            }
        }
    }
    std::vector<glsl::ParticleTethers> tethers;
    const auto length = [&](const Nearest& n) {
        return n.particle < 0 ? 0.0f : static_cast<float>(n.distance * (1 + give));
    };
    for (const auto& [first, second] : nearest)
        tethers.push_back({first.particle, second.particle, length(first), length(second)});
    return tethers;
}

double tether_give(const Cloth& cloth, const Vec3& gravity) {
    if (cloth.stiffness.rigid || cloth.stiffness.stretch.least() == 0) return 0;
    const double softest = cloth.cell_stiffness.empty() ? 1 : std::ranges::min(cloth.cell_stiffness);
    const double heaviest = cloth.cell_density.empty() ? 1 : std::ranges::max(cloth.cell_density);
    const double weight = heaviest * cloth.areal_density * std::hypot(gravity[0], gravity[1], gravity[2]);
    return weight * std::hypot(cloth.size[0], cloth.size[1]) / (softest * cloth.stiffness.stretch.least());
}

}  // namespace drape
