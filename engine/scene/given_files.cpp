// Takes the shapes and maps that a scene names files for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/output_error.h"
#include "drape/scene_reader.h"
#include "input/map_file.h"
#include "input/positions_file.h"
#include "scene/scene_rules.h"
#include "world/start.h"

namespace drape {

namespace {

/// Edges that are on average so much longer or shorter than at rest are mostly another size, or another unit.
constexpr double usual_ratio = 1.5;

bool is_too_large(const Cloth& cloth) {
    return std::uint64_t{cloth.grid[0]} * cloth.grid[1] > scene_particle_limit;  // another error reports it
}

void warn_of_ratio(const SceneNode& node, const Cloth& cloth) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double mean = start_ratios(cloth, axis).mean;
        if (mean <= usual_ratio && mean >= 1 / usual_ratio) continue;
        node.warn(
            fmt::format("the shape's edges along the {} are on average {:.3g} times as long as at rest: expected "
                        "the cloth's size, and metres",
                        axis == 0 ? "rows" : "columns", mean));
    }
}

/// Returns a map's value in the middle of every cell, row by row.
std::vector<double> cell_values(const SceneNode& node, const std::string& name, const Cloth& cloth) {
    const GreyPicture map = input::read_map(node.file(name));
    const std::uint32_t columns = cloth.grid[0] - 1, rows = cloth.grid[1] - 1;
    std::vector<double> values;
    values.reserve(std::size_t{columns} * rows);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            values.push_back(input::sampled(map, (column + 0.5) / columns, (row + 0.5) / rows));
    return values;
}

/// Returns a map's value at every particle, row by row.
std::vector<double> particle_values(const SceneNode& node, const std::string& name, const Cloth& cloth) {
    const GreyPicture map = input::read_map(node.file(name));
    const auto [columns, rows] = cloth.grid;
    const bool fits = map.width == columns && map.height == rows;
    const auto place = [fits](std::uint32_t at, std::uint32_t count) {
        return fits ? (at + 0.5) / count : static_cast<double>(at) / (count - 1);
    };
    std::vector<double> values;
    values.reserve(std::size_t{columns} * rows);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            values.push_back(input::sampled(map, place(column, columns), place(row, rows)));
    return values;
}

/// Returns the factors of cells or particles over `whole`.
std::vector<float> factors(const std::vector<double>& values, const std::array<double, 2>& range, double whole) {
    std::vector<float> factors;
    for (const double value : values)
        factors.push_back(static_cast<float>((range[0] + (range[1] - range[0]) * value) / whole));
    return factors;
}

/// An outline may have given the cells factors already.
void scale_by(std::vector<float> factors, std::vector<float>& all) {
    for (std::size_t cell = 0; cell < all.size(); ++cell) factors[cell] *= all[cell];
    all = std::move(factors);
}

/// The stiffness and the density that the cloth has from then on are the largest and the least of the map.
void take_factors(const MapFiles& files, const std::vector<double>& stiffness, const std::vector<double>& density,
                  Cloth& cloth) {
    if (!stiffness.empty()) {
        const double largest = std::ranges::max(files.stiffness_range);
        scale_by(factors(stiffness, files.stiffness_range, largest), cloth.cell_stiffness);
        cloth.stiffness.stretch *= largest;
        cloth.stiffness.shear *= largest;
        cloth.stiffness.bend *= largest;
    }
    if (density.empty()) return;
    const double least = std::ranges::min(files.density_range);
    scale_by(factors(density, files.density_range, least), cloth.cell_density);
    cloth.areal_density *= least;
}

/// The thicknesses that the cloth has from then on, that between layers too, are the largest of the map.
void take_thickness(const MapFiles& files, const std::vector<double>& values, Cloth& cloth) {
    if (values.empty()) return;
    const double largest = std::ranges::max(files.thickness_range);
    cloth.particle_thickness = factors(values, files.thickness_range, largest);
    cloth.thickness *= largest;
    if (cloth.self_collision && cloth.self_collision->thickness) *cloth.self_collision->thickness *= largest;
}

}  // namespace

void add_holes(std::vector<bool> missing, Cloth& cloth) {
    const std::uint32_t columns = cloth.grid[0] - 1, rows = cloth.grid[1] - 1;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            std::uint32_t right = column, below = row;
            const auto is_missing = [&](std::uint32_t at) {
                for (std::uint32_t i = column; i < right; ++i)
                    if (!missing[std::size_t{at} * columns + i]) return false;
                return true;
            };
            while (right < columns && missing[std::size_t{row} * columns + right]) ++right;
            if (right == column) continue;
            for (; below < rows && is_missing(below); ++below)
                for (std::uint32_t i = column; i < right; ++i) missing[std::size_t{below} * columns + i] = false;
            cloth.holes.push_back({{column, row}, {right, below}});
            column = right - 1;
        }
}

bool take_start(const Members& members, Cloth& cloth) {
    const SceneNode node = members["start"], rest = members["rest"];
    if (!node && cloth.rest == Rest::start) return rest.fail("expected a file start beside rest \"start\", got none");
    if (!node) return true;
    if (const SceneNode placement = members["placement"])
        return placement.fail("expected placement or start, got both");
    std::string name;
    if (!node.read(name) || is_too_large(cloth)) return true;
    try {
        cloth.start = input::read_positions(node.file(name), cloth.grid[0], cloth.grid[1], particles_of_cells(cloth));
    } catch (const OutputError& error) {
        return node.fail(error.what());
    }
    for (Vec3& at : cloth.start)
        for (double& x : at)
            if (std::abs(x) <= std::numeric_limits<float>::max()) x = static_cast<float>(x);  // as the cloth starts
    if (const std::string fault = start_fault(cloth); !fault.empty()) {
        cloth.start.clear();
        return node.fail(fmt::format("expected {} in '{}'", fault, name));
    }
    if (const std::string fault = rest_fault(cloth); !fault.empty())
        return node.fail(fmt::format("expected {} in '{}'", fault, name));
    if (cloth.rest == Rest::flat) warn_of_ratio(node, cloth);
    return true;
}

bool take_velocities(const Members& members, Cloth& cloth) {
    const SceneNode node = members["velocities"];
    if (!node) return true;
    if (const SceneNode velocity = members["velocity"])
        return velocity.fail("expected velocity or velocities, got both");
    std::string name;
    if (!node.read(name) || is_too_large(cloth)) return true;
    try {
        cloth.velocities = input::read_velocities(node.file(name), cloth.grid[0], cloth.grid[1]);
    } catch (const OutputError& error) {
        return node.fail(error.what());
    }
    const std::string fault = velocities_fault(cloth);
    if (fault.empty()) return true;
    cloth.velocities.clear();
    return node.fail(fmt::format("expected {} in '{}'", fault, name));
}

bool take_load_map(const SceneNode& load, const Cloth& cloth, Load& to) {
    const SceneNode node = load.member("map");
    std::string name;
    if (!node || !node.read(name) || is_too_large(cloth)) return true;
    try {
        to.factors = factors(particle_values(node, name, cloth), {0, 1}, 1);
    } catch (const OutputError& error) {
        return node.fail(error.what());
    }
    return true;
}

bool take_maps(const Members& members, Cloth& cloth) {
    const SceneNode node = members["maps"];
    if (!node || is_too_large(cloth)) return true;
    bool fits = true;
    const auto values_of = [&](const char* key, decltype(&cell_values) read = cell_values) -> std::vector<double> {
        std::string name;
        const SceneNode file = node.member(key);
        if (!file || !file.read(name)) return {};
        try {
            return read(file, name, cloth);
        } catch (const OutputError& error) {
            fits = file.fail(error.what());
            return {};
        }
    };
    const std::vector<double> holes = values_of("holes"), stiffness = values_of("stiffness"),
                              density = values_of("density"), tear = values_of("tear"),
                              friction = values_of("friction", particle_values),
                              thickness = values_of("thickness", particle_values);
    if (!stiffness.empty() && cloth.stiffness.rigid)
        fits = node.member("stiffness").fail("expected springs with a stiffness, got stiffness \"rigid\"");
    if (!tear.empty() && !members["tear"])
        fits = node.member("tear").fail("expected a cloth with tear, whose limit the map scales, got one without");
    for (const std::string map : {"stiffness", "density", "tear", "friction", "thickness"})
        if (const SceneNode range = node.member(map + "_range"); range && !node.member(map))
            fits = range.fail(fmt::format("expected a map of {}, whose values it is about, got none", map));
    if (!fits) return false;
    MapFiles files;
    (void)node.member("stiffness_range").read(std::span<double>(files.stiffness_range), "", map_factor);
    (void)node.member("density_range").read(std::span<double>(files.density_range), "", map_factor);
    (void)node.member("tear_range").read(std::span<double>(files.tear_range), "", map_factor);
    (void)node.member("friction_range").read(std::span<double>(files.friction_range), "", map_friction_factor);
    (void)node.member("thickness_range").read(std::span<double>(files.thickness_range), "", map_factor);
    if (!holes.empty()) {
        std::vector<bool> missing;
        for (const double value : holes) missing.push_back(value < 0.5);
        add_holes(std::move(missing), cloth);
    }
    if (!tear.empty()) cloth.cell_tear = factors(tear, files.tear_range, 1);
    if (!friction.empty()) cloth.particle_friction = factors(friction, files.friction_range, 1);
    take_factors(files, stiffness, density, cloth);
    take_thickness(files, thickness, cloth);
    return true;
}

}  // namespace drape
