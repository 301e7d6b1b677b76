// A cloth's grid follows its outline, and its masses and springs the shapes of its cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cloth/grid.h"
#include "cloth/loads.h"
#include "drape/scene_reader.h"
#include "world/panel.h"
#include "world/start.h"

namespace drape {
namespace {

using ::testing::HasSubstr;

constexpr const char* disc = "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0Z";
constexpr const char* ring = "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0ZM-.2 0a.2.2 0 0 0 .4 0a.2.2 0 0 0-.4 0z";
constexpr const char* shirt = "M.2 0Q.5.16.8 0L1.1.25.98.38.8.3V1H.2V.3L.02.38-.1.25Z";

SceneResult read(const std::string& cloth) { return read_scene_text("{\"cloths\": [{" + cloth + "}]}", "scene"); }
std::string outlined(const std::string& path, double spacing, const std::string& more = "") {
    return "\"outline\": {\"path\": \"" + path + "\", \"spacing\": " + std::to_string(spacing) + "}" + more;
}
Cloth cloth_of(const std::string& path, double spacing, const std::string& more = "") {
    const SceneResult result = read(outlined(path, spacing, more));
    EXPECT_TRUE(result.errors.empty()) << result.errors.front().text();
    return result.scene.value().cloths.at(0);
}
std::string error_of(const std::string& cloth) {
    const SceneResult result = read(cloth);
    return result.errors.empty() ? "none" : result.errors.front().text();
}

/// Returns the area of a cloth's cells, m^2.
double area(const Cloth& cloth) {
    const std::vector<double> areas = cell_areas(cloth);
    const std::vector<bool> missing = missing_cells(cloth);
    const auto [dx, dy] = grid_spacing(cloth);
    double sum = 0;
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
        if (!missing[cell]) sum += areas[cell] * dx * dy;
    return sum;
}

TEST(OutlineTest, AreaAndMassAreThoseOfTheOutline) {
    const struct {
        const char* path;
        double area;
    } cases[] = {{disc, std::numbers::pi / 4}, {ring, std::numbers::pi * (0.25 - 0.04)}, {"M0 0H2V1H0Z", 2}};
    for (const auto& [path, wanted] : cases)
        for (const double spacing : {0.06, 0.03, 0.01}) {
            const Cloth cloth = cloth_of(path, spacing, ", \"areal_density\": 0.3");
            EXPECT_NEAR(area(cloth) / wanted, 1, 3.0 * spacing * spacing) << path << " " << spacing;
            const Grid grid(cloth);
            const auto [dx, dy] = grid_spacing(cloth);
            double mass = 0;
            for (std::uint32_t row = 0; row < grid.rows(); ++row)
                for (std::uint32_t column = 0; column < grid.columns(); ++column)
                    mass += 0.25 * grid.cell_masses(column, row) * cloth.areal_density * dx * dy;
            EXPECT_NEAR(mass, 0.3 * area(cloth), 1e-6 * mass) << path << " " << spacing;
        }
}

TEST(OutlineTest, TheRimLiesOnTheOutline) {
    for (const double spacing : {0.1, 0.05, 0.02}) {
        const Cloth cloth = cloth_of(disc, spacing);
        const std::vector<bool> missing = missing_cells(cloth);
        const std::size_t columns = cloth.grid[0], cells = columns - 1;
        std::vector<int> cells_of(columns * cloth.grid[1]);
        for (std::size_t cell = 0; cell < missing.size(); ++cell)
            for (const std::size_t corner : {std::size_t{0}, std::size_t{1}, columns, columns + 1})
                cells_of[cell / cells * columns + cell % cells + corner] += !missing[cell];
        std::size_t on_rim = 0;
        for (std::size_t i = 0; i < cells_of.size(); ++i) {
            const double radius = std::hypot(cloth.panel[i][0] - 0.5, cloth.panel[i][1] - 0.5);
            if (cells_of[i] == 0) continue;
            if (cells_of[i] == 4) {
                EXPECT_LT(radius, 0.5 - 0.2 * spacing);
                continue;
            }
            EXPECT_NEAR(radius, 0.5, 2e-3 * spacing);
            ++on_rim;
        }
        EXPECT_GT(on_rim, std::numbers::pi / spacing) << "the rim of a disc of this spacing is as long";
    }
}

TEST(OutlineTest, SpringsAreAsLongAsPromised) {
    for (const char* path : {disc, ring, shirt})
        for (const double spacing : {0.04, 0.02, 0.01}) {
            const Cloth cloth = cloth_of(path, spacing);
            double least = 1, most = 1;
            for (const std::array<double, 4>& ratios : rest_ratios(cloth))
                for (const double ratio : ratios) least = std::min(least, ratio), most = std::max(most, ratio);
            std::printf("[ measured ] %zu particles: springs of %.2f to %.2f of a cell's\n", cloth.panel.size(), least,
                        most);
            EXPECT_GT(least, 0.4) << path << " " << spacing;
            EXPECT_LT(most, 1.9) << path << " " << spacing;
        }
}

TEST(OutlineTest, CornersHaveParticles) {
    const Cloth cloth = cloth_of(shirt, 0.03);
    const std::vector<bool> has_cell = particles_of_cells(cloth);
    for (const auto& [x, y] : {std::array{1.1, 0.25}, {0.98, 0.38}, {0.8, 1.0}, {0.2, 1.0}, {0.2, 0.3}, {-0.1, 0.25}}) {
        double nearest = 1;
        for (std::size_t i = 0; i < has_cell.size(); ++i)
            if (has_cell[i])
                nearest = std::min(nearest, std::hypot(cloth.panel[i][0] - 0.1 - x, cloth.panel[i][1] - y));
        EXPECT_LT(nearest, 1e-9) << x << " " << y;
    }
}

TEST(OutlineTest, NoSpringIsStifferAndNoCellLighterThanTheClothSays) {
    for (const char* path : {disc, ring, shirt}) {
        const Cloth cloth = cloth_of(path, 0.03, ", \"stiffness\": {\"stretch\": 400, \"shear\": 100}");
        const Grid grid(cloth);
        float stiffest = 0;
        for (std::uint32_t row = 0; row < grid.rows(); ++row)
            for (std::uint32_t column = 0; column < grid.columns(); ++column) {
                const glsl::vec4 shares = grid.spring_shares(column, row);
                stiffest = std::max({stiffest, shares.x, shares.y, shares.z, shares.w});
            }
        EXPECT_LE(stiffest, 1 + 1e-6f);
        EXPECT_GT(stiffest, 0.6f);
        // Inside, where cells are those of the full grid, the cloth is as stiff as it was written.
        const glsl::vec4 inside = grid.spring_shares(grid.columns() / 4, grid.rows() / 2);
        EXPECT_NEAR(inside.x * cloth.stiffness.stretch.warp, 400, 400 * 0.02) << path;
        EXPECT_NEAR(grid.cell_density(static_cast<int>(grid.columns() / 4), static_cast<int>(grid.rows() / 2)) *
                        cloth.areal_density,
                    0.2, 0.2 * 0.02)
            << path;
    }
}

TEST(OutlineTest, TheOriginIsThePathsOwn) {
    const Cloth cloth =
        cloth_of(disc, 0.05, ", \"placement\": {\"origin\": [1, 2, 3], \"u\": [0, 0, 1], \"v\": [0, -1, 0]}");
    const std::uint32_t middle = cloth.grid[0] / 2;
    const Vec3 at = start_place(cloth, middle, middle);
    EXPECT_NEAR(at[0], 1, 1e-12);
    EXPECT_NEAR(at[1], 2, 0.03);
    EXPECT_NEAR(at[2], 3, 0.03);
}

TEST(OutlineTest, APinTakesTheNearestParticle) {
    const Cloth cloth = cloth_of(disc, 0.05, R"(, "pins": [{"point": [0.5, 0]}, {"point": [-0.35, 0.36]}])");
    const auto place = [&](const Pin& pin) {
        EXPECT_EQ(pin.particles.first, pin.particles.last);
        return cloth.panel[pin.particles.first[1] * cloth.grid[0] + pin.particles.first[0]];
    };
    EXPECT_NEAR(place(cloth.pins[0])[0] - 0.5, 0.5, 1e-3);
    EXPECT_NEAR(place(cloth.pins[0])[1] - 0.5, 0, 0.03);
    const PanelPoint on_rim = place(cloth.pins[1]);
    EXPECT_NEAR(std::hypot(on_rim[0] - 0.5, on_rim[1] - 0.5), 0.5, 1e-3);
    EXPECT_LT(std::hypot(on_rim[0] - 0.5 + 0.35, on_rim[1] - 0.5 - 0.36), 0.05);
}

TEST(OutlineTest, WhatDoesNotFitIsSaid) {
    EXPECT_THAT(error_of(outlined(disc, 0.05, ", \"grid\": [9, 9]")), HasSubstr("expected grid or outline, got both"));
    EXPECT_THAT(error_of(outlined(disc, 0.05, ", \"size\": [1, 1]")), HasSubstr("expected size or outline, got both"));
    EXPECT_THAT(error_of(outlined(disc, 0.05, ", \"rest\": \"start\"")), HasSubstr("rest or outline"));
    EXPECT_THAT(error_of(outlined("M0 0L1", 0.05)), HasSubstr("expected a number at character 7 of the path"));
    EXPECT_THAT(error_of(outlined("M0 0", 0.05)), HasSubstr("a path that goes around something"));
    EXPECT_THAT(error_of(outlined("M0 0H1Z", 0.05)), HasSubstr("a path that goes around something"));
    EXPECT_THAT(error_of(outlined("M0 0L1 1 2 2Z", 0.05)), HasSubstr("half of a cell"));
    EXPECT_THAT(error_of(outlined(disc, 1e-5)), HasSubstr("at most 16000000 particles"));
    EXPECT_THAT(error_of(outlined("M0 0H1V1H0ZM.4.4h.01v.01h-.01z", 0.1)), HasSubstr("none"))
        << "a hole below half a cell is none";
    EXPECT_THAT(error_of(outlined("M0 0H1V.02H.5V1H0Z", 0.1)), HasSubstr("a smaller spacing may help"));
    EXPECT_THAT(error_of("\"grid\": [9, 9], \"pins\": [{\"point\": [0, 0]}]"), HasSubstr("a cloth with an outline"));
    EXPECT_THAT(error_of("\"outline\": {\"spacing\": 0.1}"), HasSubstr("exactly one of path and file"));
    EXPECT_THAT(error_of("\"outline\": {\"path\": \"M0 0H1V1Z\", \"file\": \"a.svg\"}"),
                HasSubstr("exactly one of path"));
    EXPECT_THAT(error_of("\"outline\": {\"path\": \"M0 0H1V1Z\", \"element\": \"a\"}"), HasSubstr("whose element"));
    EXPECT_THAT(error_of("\"outline\": {\"file\": \"nowhere.svg\"}"), HasSubstr("/cloths/0/outline/file: "));
    EXPECT_THAT(error_of(outlined(disc, 0.05, ", \"pins\": [{\"point\": [0, 0], \"at\": [1, 1]}]")),
                HasSubstr("exactly one of edge, corner, at, box and point"));
}

/// A force on all of a cloth moves it as a whole: each particle has as much of it as of the mass.
TEST(OutlineTest, AForceIsSharedByArea) {
    Cloth cloth = cloth_of(ring, 0.03);
    const auto [dx, dy] = grid_spacing(cloth);
    const Grid grid(cloth);
    const std::vector<double> shares =
        force_shares(grid, {.particles = {{0, 0}, {grid.columns() - 1, grid.rows() - 1}}});
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const double mass = 0.25 * grid.cell_masses(column, row) * cloth.areal_density * dx * dy;
            EXPECT_NEAR(shares[grid.particle(column, row)], mass / (0.2 * area(cloth)), 1e-6);
        }
}

TEST(OutlineTest, MapsScaleItsCells) {
    const std::string map = std::string(DRAPE_SOURCE_DIR) + "/tests/scene/given/cells.png";
    const Cloth plain = cloth_of(disc, 0.05),
                mapped = cloth_of(disc, 0.05, ", \"maps\": {\"density\": \"" + map + "\", \"density_range\": [1, 3]}");
    ASSERT_EQ(mapped.cell_density.size(), plain.cell_density.size());
    float least = 10, most = 0;
    for (std::size_t cell = 0; cell < plain.cell_density.size(); ++cell) {
        const auto factor = static_cast<float>(mapped.cell_density[cell] * mapped.areal_density /
                                               (plain.cell_density[cell] * plain.areal_density));
        least = std::min(least, factor), most = std::max(most, factor);
    }
    EXPECT_GE(least, 1 - 1e-5f);
    EXPECT_LE(most, 3 + 1e-5f);
    EXPECT_GT(most, 2);
}

}  // namespace
}  // namespace drape
