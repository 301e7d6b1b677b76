#include "world/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/vectors.h"
#include "drape/scene_reader.h"
#include "world/panel.h"
#include "world/random.h"

namespace drape {

namespace {

/// Returns the vector from the first particle of a row (or column) to its last.
Vec3 side(const Cloth& cloth, std::size_t axis) {
    const Vec3& way = axis == 0 ? cloth.placement.u : cloth.placement.v;
    const double length = cloth.placement.scale[axis] * cloth.size[axis];
    return {length * way[0], length * way[1], length * way[2]};
}

/// Returns four times the distance that single precision resolves where the cloth starts, m.
double resolution(const Cloth& cloth, const Vec3& u, const Vec3& v) {
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        farthest = std::max(farthest, std::abs(cloth.placement.origin[k]) + std::abs(u[k]) + std::abs(v[k]));
    for (const Vec3& at : cloth.start)
        for (const double x : at) farthest = std::max(farthest, std::abs(x));
    const double cell = least_spacing(cloth);
    return std::max(4 * farthest * std::numeric_limits<float>::epsilon(), 1e-6 * cell);
}

/// Returns where the particles start without jitter, row by row.
std::vector<Vec3> start_places(const Cloth& cloth) {
    if (!cloth.start.empty()) return cloth.start;
    std::vector<Vec3> places;
    for (std::uint32_t row = 0; row < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cloth.grid[0]; ++column)
            places.push_back(start_place(cloth, column, row));
    return places;
}

/// Calls `look` with the three particles of every triangle of a given shape.
template <class Look>
void for_triangles(const Cloth& cloth, const Look& look) {
    const std::vector<bool> missing = missing_cells(cloth);
    const std::size_t columns = cloth.grid[0], cells = columns - 1;
    for (std::size_t row = 0; row + 1 < cloth.grid[1]; ++row)
        for (std::size_t column = 0; column < cells; ++column) {
            if (missing[row * cells + column]) continue;
            const std::size_t first = row * columns + column, below = first + columns;
            look(cloth.start[first], cloth.start[first + 1], cloth.start[below]);
            look(cloth.start[first + 1], cloth.start[below + 1], cloth.start[below]);
        }
}

double highest_triangle(const Cloth& cloth) {
    double highest = 0;
    for_triangles(cloth, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const double longest = std::max({length(minus(b, a)), length(minus(c, a)), length(minus(c, b))});
        const double area = length(cross(minus(b, a), minus(c, a)));
        if (longest > 0) highest = std::max(highest, area / longest);
    });
    return highest;
}

/// Returns whether particles are on the rim and so far apart on the cloth that a seam may make them one.
bool may_be_sewn(const Cloth& cloth, std::size_t one, std::size_t other) {
    const std::size_t columns = cloth.grid[0], rows = cloth.grid[1];
    const auto on_rim = [&](std::size_t i) {
        const std::size_t column = i % columns, row = i / columns;
        return column == 0 || column + 1 == columns || row == 0 || row + 1 == rows;
    };
    const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
    return on_rim(one) && on_rim(other) &&
           std::max(apart(one % columns, other % columns), apart(one / columns, other / columns)) > 2;
}

Vec3 summed_normal(const Cloth& cloth) {
    Vec3 normal{};
    for_triangles(cloth, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        normal = plus(normal, cross(minus(b, a), minus(c, a)));
    });
    return normal;
}

/// Calls `look` with the first particle of every spring along u (axis 0) or v, and the ratio of its length at the start
/// to that on the full grid at rest.
template <class Look>
void for_springs(const Cloth& cloth, std::size_t axis, const Look& look) {
    const std::vector<bool> missing = missing_cells(cloth);
    const std::size_t columns = cloth.grid[0], rows = cloth.grid[1], step = axis == 0 ? 1 : columns;
    const double rest = grid_spacing(cloth)[axis];
    const std::vector<Vec3> places = start_places(cloth);
    const auto is_there = [&](std::size_t column, std::size_t row) {
        return column + 1 < columns && row + 1 < rows && !missing[row * (columns - 1) + column];
    };
    for (std::size_t row = 0; row + axis < rows; ++row)
        for (std::size_t column = 0; column + 1 - axis < columns; ++column) {
            const bool beside =
                axis == 0 ? row > 0 && is_there(column, row - 1) : column > 0 && is_there(column - 1, row);
            if (!beside && !is_there(column, row)) continue;
            const std::size_t first = row * columns + column;
            look(first, length(minus(places[first + step], places[first])) / rest);
        }
}

std::vector<Vec3> jittered_positions(const Cloth& cloth) {
    const double jitter = start_jitter(cloth);
    const std::vector<bool> is_held = held_at_start(cloth);
    std::vector<Vec3> positions;
    positions.reserve(is_held.size());
    for (std::uint32_t row = 0; row < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cloth.grid[0]; ++column) {
            const auto particle = static_cast<std::uint32_t>(positions.size());
            Vec3 at = start_place(cloth, column, row);
            if (jitter > 0 && !is_held[particle]) at = plus(at, start_offset(cloth.placement, jitter, particle));
            positions.push_back(at);
        }
    return positions;
}

Vec3 in_single(const Vec3& at) {
    return {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
}

/// Moves the particles of triangles that cross halfway to their places without jitter, until no triangles cross. Flat
/// cloth does not cross itself, so this ends; where rounding has it cross, it ends with all of these at their places.
/// The test uses single precision, in which the cloth starts.
void untie(const Cloth& cloth, std::vector<Vec3>& positions) {
    constexpr int most_rounds = 64;  // after so many halvings nothing is left of any jitter
    bool moved = true;
    for (int round = 0; round < most_rounds && moved; ++round) {
        std::vector<Vec3> rounded(positions.size());
        std::ranges::transform(positions, rounded.begin(), in_single);
        const std::vector<bool> crossed = TriangleCrossings({start_mesh(cloth, std::move(rounded))}).crossed_points();
        moved = false;
        for (std::uint32_t particle = 0; particle < positions.size(); ++particle) {
            if (!crossed[particle]) continue;
            const Vec3 place = start_place(cloth, particle % cloth.grid[0], particle / cloth.grid[0]);
            moved = moved || in_single(positions[particle]) != in_single(place);
            positions[particle] = times(0.5, plus(positions[particle], place));
        }
    }
}

/// Returns whether a cloth with self-contact may start through itself. If jitter turns no triangle over, as seen along
/// the normal, no triangles can cross. Gathered cloth is refused.
bool may_be_tied(const Cloth& cloth) {
    if (!cloth.start.empty()) return false;
    const double height = start_height(cloth), jitter = start_jitter(cloth);
    return cloth.self_collision && height > resolution(cloth, side(cloth, 0), side(cloth, 1)) && height <= 4 * jitter;
}

}  // namespace

TriangleCrossings::Mesh start_mesh(const Cloth& cloth, std::vector<Vec3> at) {
    TriangleCrossings::Mesh mesh{std::move(at), {}};
    const std::vector<std::uint32_t> triangles = cell_triangles(cloth);
    const std::uint32_t columns = cloth.grid[0], cells = columns - 1;
    for (std::uint32_t row = 0; row + 1 < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t bits = triangles[std::size_t{row} * cells + column];
            const std::uint32_t first = row * columns + column, below = first + columns;
            if (bits & upper_triangle) mesh.indices.insert(mesh.indices.end(), {first, first + 1, below});
            if (bits & lower_triangle) mesh.indices.insert(mesh.indices.end(), {first + 1, below + 1, below});
        }
    return mesh;
}

StartBox start_box(const Cloth& cloth) {
    std::vector<Vec3> points = cloth.start;
    const Vec3 u = side(cloth, 0), v = side(cloth, 1);
    for (std::size_t corner = 0; cloth.start.empty() && corner < 4; ++corner)
        points.push_back(
            plus(plus(cloth.placement.origin, times(corner % 2 == 1 ? 1 : 0, u)), times(corner / 2 == 1 ? 1 : 0, v)));
    StartBox box{points.front(), points.front()};
    for (const Vec3& at : points)
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], at[k]);
            box.high[k] = std::max(box.high[k], at[k]);
        }
    return box;
}

double start_height(const Cloth& cloth) {
    if (!cloth.start.empty()) return highest_triangle(cloth);
    double side[2];
    for (std::size_t axis = 0; axis < 2; ++axis)
        side[axis] = std::abs(cloth.placement.scale[axis]) * cloth.size[axis] / (cloth.grid[axis] - 1);
    const double longest = std::hypot(side[0], side[1]);
    return longest > 0 ? side[0] * side[1] / longest : 0;
}

double start_jitter(const Cloth& cloth) {
    if (!cloth.start.empty()) return 0;
    const Vec3 u = side(cloth, 0), v = side(cloth, 1);
    const double resolved = resolution(cloth, u, v), longer = std::max(length(u), length(v));
    const Vec3 area{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const bool parted = length(area) > resolved * longer;
    return parted ? cloth.placement.jitter : std::max(cloth.placement.jitter, resolved);
}

std::vector<bool> held_at_start(const Cloth& cloth) {
    std::vector<bool> held(std::size_t{cloth.grid[0]} * cloth.grid[1]);
    for (const Pin& pin : cloth.pins)
        for (std::uint32_t row = pin.particles.first[1]; row <= pin.particles.last[1]; ++row)
            for (std::uint32_t column = pin.particles.first[0]; column <= pin.particles.last[0]; ++column)
                held[std::size_t{row} * cloth.grid[0] + column] = true;
    return held;
}

std::vector<bool> missing_cells(const Cloth& cloth) {
    const std::size_t columns = cloth.grid[0] - 1, rows = cloth.grid[1] - 1;
    std::vector<bool> missing(columns * rows);
    for (const IndexBox& hole : cloth.holes)
        for (std::size_t row = hole.first[1]; row < hole.last[1]; ++row)
            for (std::size_t column = hole.first[0]; column < hole.last[0]; ++column)
                missing[row * columns + column] = true;
    return missing;
}

std::vector<bool> particles_of_cells(const Cloth& cloth) {
    const std::vector<bool> missing = missing_cells(cloth);
    const std::size_t columns = cloth.grid[0], cells = columns - 1;
    std::vector<bool> has_cell(columns * cloth.grid[1]);
    for (std::size_t cell = 0; cell < missing.size(); ++cell)
        for (const std::size_t corner : {std::size_t{0}, std::size_t{1}, columns, columns + 1})
            if (!missing[cell]) has_cell[cell / cells * columns + cell % cells + corner] = true;
    return has_cell;
}

bool is_loaded(const Cloth& cloth, const Load& load) {
    const std::vector<bool> has_cell = particles_of_cells(cloth);
    const auto& [first, last] = load.particles;
    for (std::uint32_t row = first[1]; row <= last[1]; ++row)
        for (std::uint32_t column = first[0]; column <= last[0]; ++column) {
            const std::size_t particle = std::size_t{row} * cloth.grid[0] + column;
            if (has_cell[particle] && (load.factors.empty() || load.factors[particle] > 0)) return true;
        }
    return false;
}

bool leaves_a_cell(const Cloth& cloth) {
    const std::size_t columns = cloth.grid[0] - 1, rows = cloth.grid[1] - 1;
    if (std::uint64_t{cloth.grid[0]} * cloth.grid[1] > scene_particle_limit) return true;  // another error reports it
    std::uint64_t covered = 0;
    for (const IndexBox& hole : cloth.holes)
        covered += std::uint64_t{hole.last[0] - hole.first[0]} * (hole.last[1] - hole.first[1]);
    if (covered < columns * rows) return true;
    // Each entry of this array of differences, summed from the left and from above, is the number of holes that contain
    // a cell.
    std::vector<std::int32_t> holes((columns + 1) * (rows + 1));
    for (const IndexBox& hole : cloth.holes)
        for (const auto& [column, row, sign] : {std::tuple{hole.first[0], hole.first[1], 1},
                                                {hole.last[0], hole.first[1], -1},
                                                {hole.first[0], hole.last[1], -1},
                                                {hole.last[0], hole.last[1], 1}})
            holes[row * (columns + 1) + column] += sign;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            std::int32_t& here = holes[row * (columns + 1) + column];
            if (column > 0) here += holes[row * (columns + 1) + column - 1];
            if (row > 0) here += holes[(row - 1) * (columns + 1) + column];
            if (column > 0 && row > 0) here -= holes[(row - 1) * (columns + 1) + column - 1];
            if (here == 0) return true;
        }
    return false;
}

Vec3 start_place(const Cloth& cloth, std::uint32_t column, std::uint32_t row) {
    if (!cloth.start.empty()) return cloth.start[std::size_t{row} * cloth.grid[0] + column];
    const Placement& placement = cloth.placement;
    const auto [dx, dy] = grid_spacing(cloth);
    const std::array<double, 2> flat = cloth.panel.empty() ? std::array<double, 2>{column * dx, row * dy}
                                                           : cloth.panel[std::size_t{row} * cloth.grid[0] + column];
    Vec3 at = placement.origin;
    for (std::size_t k = 0; k < 3; ++k)
        at[k] += flat[0] * placement.scale[0] * placement.u[k] + flat[1] * placement.scale[1] * placement.v[k];
    return at;
}

Vec3 start_offset(const Placement& placement, double jitter, std::uint32_t particle) {
    Vec3 offset;
    for (std::uint64_t k = 0; k < 3; ++k)
        offset[k] = jitter * (2 * unit_interval_of(splitmix64(splitmix64(placement.seed) + 3ull * particle + k)) - 1);
    return offset;
}

std::vector<Vec3> start_positions(const Cloth& cloth) {
    std::vector<Vec3> positions = jittered_positions(cloth);
    if (may_be_tied(cloth)) untie(cloth, positions);
    return positions;
}

Vec3 start_velocity(const Cloth& cloth, std::size_t particle) {
    return cloth.velocities.empty() ? cloth.velocity : cloth.velocities[particle];
}

double start_speed(const Cloth& cloth) {
    if (cloth.velocities.empty()) return length(cloth.velocity);
    double largest = 0;
    for (const Vec3& velocity : cloth.velocities) largest = std::max(largest, length(velocity));
    return largest;
}

double start_untied(const Cloth& cloth, const std::vector<Vec3>& untied) {
    if (!may_be_tied(cloth)) return 0;
    const std::vector<Vec3> tied = jittered_positions(cloth);
    double farthest = 0;
    for (std::size_t i = 0; i < tied.size(); ++i) farthest = std::max(farthest, length(minus(tied[i], untied[i])));
    return farthest;
}

Vec3 start_normal(const Cloth& cloth) {
    const Vec3 normal = cloth.start.empty() ? cross(side(cloth, 0), side(cloth, 1)) : summed_normal(cloth);
    const double size = length(normal);
    return size > 0 ? Vec3{normal[0] / size, normal[1] / size, normal[2] / size} : Vec3{};
}

double start_strain(const Cloth& cloth) {
    double strain = 0;
    if (cloth.rest == Rest::start) return strain;
    if (!cloth.start.empty()) {
        const std::vector<std::array<double, 4>> rest = rest_ratios(cloth);
        for (std::size_t axis = 0; axis < 2; ++axis)
            for_springs(cloth, axis, [&](std::size_t first, double ratio) {
                strain = std::max(strain, std::abs(ratio / rest[first][axis] - 1));
            });
        return strain;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double cell = grid_spacing(cloth)[axis];
        const double far = 2 * std::sqrt(3.0) * cloth.placement.jitter / cell;
        strain = std::max(strain, std::abs(std::abs(cloth.placement.scale[axis]) - 1) + far);
    }
    return strain;
}

StartRatios start_ratios(const Cloth& cloth, std::size_t axis) {
    StartRatios ratios{0, 0};
    double count = 0;
    for_springs(cloth, axis, [&](std::size_t, double ratio) {
        ratios = {ratios.mean + ratio, std::max(ratios.largest, ratio)};
        ++count;
    });
    return count > 0 ? StartRatios{ratios.mean / count, ratios.largest} : StartRatios{};
}

std::string velocities_fault(const Cloth& cloth) {
    const std::size_t columns = cloth.grid[0], count = columns * cloth.grid[1];
    if (cloth.velocities.size() != count)
        return fmt::format("a velocity for each of the {} particles, got {}", count, cloth.velocities.size());
    for (std::size_t i = 0; i < count; ++i)
        for (const double x : cloth.velocities[i])
            if (!(std::abs(x) <= std::numeric_limits<float>::max()))
                return fmt::format("finite velocities, got {:g} for particle [{}, {}]", x, i % columns, i / columns);
    return {};
}

std::string start_fault(const Cloth& cloth) {
    const std::size_t columns = cloth.grid[0], count = columns * cloth.grid[1];
    const auto particle = [columns](std::size_t index) {
        return fmt::format("particle [{}, {}]", index % columns, index / columns);
    };
    if (cloth.start.size() != count)
        return fmt::format("a place for each of the {} particles, got {}", count, cloth.start.size());
    for (std::size_t i = 0; i < count; ++i)
        for (const double x : cloth.start[i])
            if (!(std::abs(x) <= std::numeric_limits<float>::max()))
                return fmt::format("finite places, got {:g} for {}", x, particle(i));
    const std::vector<bool> has_cell = particles_of_cells(cloth);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < count; ++i)
        if (has_cell[i]) order.push_back(i);
    std::ranges::sort(
        order, [&](std::size_t a, std::size_t b) { return std::tie(cloth.start[a], a) < std::tie(cloth.start[b], b); });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (cloth.start[order[i]] == cloth.start[order[i - 1]] && !may_be_sewn(cloth, order[i - 1], order[i]))
            return fmt::format("a place of its own for each particle, got one place for {} and {}",
                               particle(order[i - 1]), particle(order[i]));
    if (!(highest_triangle(cloth) > resolution(cloth, {}, {})))
        return "a shape with room between its particles, got triangles that are all thinner than single precision "
               "tells";
    return {};
}

std::vector<std::array<double, 4>> rest_ratios(const Cloth& cloth) {
    const std::size_t columns = cloth.grid[0], rows = cloth.grid[1], cells = columns - 1;
    std::vector<std::array<double, 4>> ratios(columns * rows, {1, 1, 1, 1});
    if (cloth.rest == Rest::flat && cloth.panel.empty()) return ratios;
    const auto [dx, dy] = grid_spacing(cloth);
    const auto place = [&](std::size_t particle) {
        return cloth.panel.empty() ? cloth.start[particle]
                                   : Vec3{cloth.panel[particle][0], cloth.panel[particle][1], 0};
    };
    const auto set = [&](std::size_t owner, std::size_t other, std::size_t direction, double flat) {
        ratios[owner][direction] = length(minus(place(other), place(owner))) / flat;
    };
    const std::vector<bool> missing = missing_cells(cloth);
    for (std::size_t cell = 0; cell < missing.size(); ++cell) {
        if (missing[cell]) continue;
        const std::size_t first = cell / cells * columns + cell % cells, below = first + columns;
        set(first, first + 1, 0, dx);
        set(below, below + 1, 0, dx);
        set(first, below, 1, dy);
        set(first + 1, below + 1, 1, dy);
        set(first, below + 1, 2, std::hypot(dx, dy));
        set(first + 1, below, 3, std::hypot(dx, dy));
    }
    return ratios;
}

std::string rest_fault(const Cloth& cloth) {
    constexpr double most = 4;
    const std::vector<std::array<double, 4>> ratios = rest_ratios(cloth);
    for (std::size_t i = 0; i < ratios.size(); ++i)
        for (const double ratio : ratios[i])
            if (!(ratio >= 1 / most && ratio <= most))
                return fmt::format(
                    "springs between {:g} and {:g} times as long as on flat cloth (/rest is \"start\"), got {:.4g} "
                    "times at particle [{}, {}]",
                    1 / most, most, ratio, i % cloth.grid[0], i / cloth.grid[0]);
    return {};
}

}  // namespace drape
