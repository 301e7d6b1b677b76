// A tear is a line: it begins where most is borne, goes on where it is, and takes no spring that bears its load. Loads
// are forces over widths.
#include "cloth/tear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "cloth/simulation_model.h"
#include "reference/spring_network.h"
#include "support/cut_checks.h"
#include "support/sheets.h"
#include "twin/tear_twin.h"

namespace drape {
namespace {

constexpr std::uint32_t columns = 9, rows = 12;

SceneDescription sheet_with(const std::vector<IndexBox>& holes) {
    SceneDescription scene = test::sheet(columns, rows, 0.8, 1.1, 4);
    scene.cloths[0].holes = holes;
    scene.cloths[0].tear = Tear{.strain = 0.5, .tension = {}};
    return scene;
}

/// Loads are set by hand.
struct Loaded {
    explicit Loaded(const std::vector<IndexBox>& holes = {}) : scene(sheet_with(holes)) {}
    SceneDescription scene;
    SimulationModel model{scene};
    CutTopology topology{model.cloths[0]};
    std::vector<glsl::vec4> loads = std::vector<glsl::vec4>(columns * rows);

    float& along_column(std::uint32_t column, std::uint32_t row) { return loads[row * columns + column].y; }
    void pull_columns(float load) {
        for (glsl::vec4& each : loads) each.y = load;
    }
    CutCounts tear() {
        const CutFindings found = torn_springs(topology, loads);
        for (std::size_t k = 0; k < loads.size(); ++k) {
            EXPECT_TRUE(found.fractions[k].x < 0 || loads[k].x > 1) << k;
            EXPECT_TRUE(found.fractions[k].y < 0 || loads[k].y > 1) << k;
        }
        const CutCounts counts = topology.apply(found);
        test::expect_consistent(topology);
        for (std::size_t k = 0; k < loads.size(); ++k) {
            if (topology.cut_fraction(k, 0) >= 0) loads[k].x = 0;
            if (topology.cut_fraction(k, 1) >= 0) loads[k].y = 0;
        }
        return counts;
    }
    bool is_torn(std::uint32_t column, std::uint32_t row, std::size_t axis = 1) const {
        return topology.cut_fraction(row * columns + column, axis) >= 0;
    }
    std::size_t torn_count(std::size_t axis = 1) const {
        std::size_t count = 0;
        for (std::size_t k = 0; k < columns * rows; ++k) count += topology.cut_fraction(k, axis) >= 0;
        return count;
    }
};

TEST(TearTest, WhatIsPulledAlikeEverywherePartsInOneLine) {
    Loaded sheet;
    sheet.pull_columns(1.5f);
    const double area = sheet.topology.rest_area();
    const CutCounts counts = sheet.tear();
    EXPECT_EQ(counts.springs, 9u + 2u * 8u) << "one column spring per column, both diagonals per cell";
    EXPECT_EQ(counts.triangles, 16u);
    EXPECT_EQ(counts.pieces, 2u);
    EXPECT_EQ(counts.crumbs, 0u);
    EXPECT_EQ(sheet.torn_count(), columns);
    EXPECT_EQ(sheet.torn_count(0), 0u);
    EXPECT_NEAR(sheet.topology.rest_area(), area, 1e-6 * area);
}

TEST(TearTest, NothingTearsThatBearsItsLoad) {
    Loaded sheet;
    sheet.pull_columns(1.0f);  // the limit itself is borne
    for (glsl::vec4& each : sheet.loads) each.x = NAN;
    EXPECT_FALSE(sheet.tear().any());
}

TEST(TearTest, ItBeginsWhereMostIsBorneAndEndsWhereItIsBorne) {
    Loaded sheet;
    sheet.pull_columns(1.1f);
    for (std::uint32_t row = 0; row < rows; ++row) sheet.along_column(2, row) = sheet.along_column(6, row) = 0.9f;
    sheet.along_column(4, 7) = 1.2f;
    EXPECT_EQ(sheet.tear().triangles, 4u) << "cells at the ends keep their triangles whole";
    EXPECT_EQ(sheet.torn_count(), 3u);
    for (const std::uint32_t column : {3u, 4u, 5u}) EXPECT_TRUE(sheet.is_torn(column, 7));
    EXPECT_EQ(test::piece_count(sheet.topology), 1u);
}

TEST(TearTest, ATearGoesOnBeforeAnotherBegins) {
    Loaded sheet;
    sheet.along_column(4, 7) = 1.2f;
    sheet.tear();
    ASSERT_EQ(sheet.torn_count(), 1u);
    // All bear too much now, and elsewhere most.
    sheet.pull_columns(1.1f);
    sheet.along_column(4, 7) = 0;
    for (std::uint32_t row = 0; row < rows; ++row) sheet.along_column(1, row) = row == 7 ? 0.5f : 3;
    sheet.tear();
    EXPECT_EQ(sheet.torn_count(), 7u);
    for (std::uint32_t column = 2; column < columns; ++column) EXPECT_TRUE(sheet.is_torn(column, 7)) << column;
    // The two sides part once the springs at the end of the tear bear too much.
    sheet.along_column(1, 7) = 1.01f;
    sheet.along_column(0, 7) = 1.01f;
    const CutCounts counts = sheet.tear();
    EXPECT_EQ(counts.pieces, 2u);
    EXPECT_EQ(sheet.torn_count(), columns);
}

TEST(TearTest, OfTheSidesOfACellOneTearsInAFrame) {
    Loaded sheet;
    sheet.along_column(4, 7) = 1.2f;
    sheet.tear();
    sheet.along_column(5, 7) = 1.2f;
    sheet.loads[7 * columns + 4].x = 1.1f;  // a side of the cell that the tear goes on from
    sheet.tear();
    EXPECT_TRUE(sheet.is_torn(5, 7));
    EXPECT_FALSE(sheet.is_torn(4, 7, 0));
    sheet.tear();
    EXPECT_TRUE(sheet.is_torn(4, 7, 0)) << "it still bears too much";
}

TEST(TearTest, OnceATearMayHavePartedThePieceNothingElseOfItTears) {
    Loaded sheet;
    for (const std::uint32_t row : {2u, 8u}) {
        sheet.along_column(4, row) = 1.2f;
        sheet.tear();
    }
    ASSERT_EQ(sheet.torn_count(), 2u);
    sheet.pull_columns(1.1f);
    for (const std::uint32_t row : {2u, 8u}) sheet.along_column(4, row) = 0;
    sheet.along_column(5, 8) = 1.2f;
    sheet.tear();
    EXPECT_EQ(sheet.torn_count(), 2u + 4u) << "one end goes on to the border, the other ends wait";
    // A tear that comes to no border leaves the other its turn.
    sheet.pull_columns(0);
    sheet.along_column(3, 8) = sheet.along_column(3, 2) = 1.1f;
    sheet.tear();
    EXPECT_EQ(sheet.torn_count(), 2u + 4u + 2u);
}

TEST(TearTest, EveryPieceTearsOfItsOwn) {
    Loaded sheet;
    sheet.pull_columns(1.5f);
    sheet.along_column(3, 5) = 1.6f;
    sheet.tear();
    EXPECT_EQ(sheet.tear().pieces, 4u);
    EXPECT_EQ(sheet.torn_count(), 3 * columns);
}

TEST(TearTest, ATearTurnsWhereTheSideBearsMore) {
    Loaded sheet;
    sheet.along_column(0, 5) = sheet.along_column(1, 5) = sheet.along_column(2, 5) = 1.5f;
    sheet.along_column(3, 5) = 1.2f;
    for (std::uint32_t row = 6; row < rows; ++row) sheet.loads[row * columns + 2].x = 1.4f;  // of row springs below
    const CutCounts counts = sheet.tear();
    EXPECT_EQ(counts.pieces, 2u) << "a corner comes off";
    EXPECT_FALSE(sheet.is_torn(3, 5));
    EXPECT_EQ(sheet.torn_count(0), rows - 6);
}

TEST(TearTest, ATearComesToHoles) {
    const std::vector<IndexBox> hole{{{4, 4}, {6, 8}}};
    Loaded sheet(hole);
    sheet.pull_columns(1.1f);
    for (std::uint32_t row = 0; row < rows; ++row) sheet.along_column(5, row) = 0;  // none inside the hole
    sheet.along_column(1, 6) = 1.2f;
    sheet.tear();
    EXPECT_EQ(sheet.torn_count(), 5u) << "from the left border to the hole";
    EXPECT_EQ(test::piece_count(sheet.topology) - 3u, 1u) << "particles inside the hole are pieces of their own";
    sheet.along_column(8, 6) = 1.15f;
    EXPECT_EQ(sheet.tear().pieces, 2u);
}

/// Whatever the loads, both sides stay consistent, no area is lost, and a spring that bears its load holds.
TEST(TearTest, RandomLoadsKeepEveryInvariant) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> load(0, 1.4f);
    std::uniform_int_distribution<std::uint32_t> place(0, 7);
    std::uint32_t most_pieces = 0;
    for (int round = 0; round < 60; ++round) {
        const std::uint32_t column = place(random), row = place(random);
        const std::vector<IndexBox> hole{{{column, row}, {column + round % 3, row + round % 4}}};
        Loaded sheet(hole);
        const double area = sheet.topology.rest_area();
        for (int frame = 0; frame < 12; ++frame) {
            for (std::size_t k = 0; k < sheet.loads.size(); ++k) {
                const auto at = static_cast<std::uint32_t>(k);
                const glsl::vec4 share = sheet.topology.masked()
                                             ? sheet.topology.spring_shares()[k]
                                             : sheet.model.cloths[0].grid.spring_shares(at % columns, at / columns);
                sheet.loads[k] = {at % columns + 1 < columns && share.x > 0 ? load(random) : 0,
                                  at / columns + 1 < rows && share.y > 0 ? load(random) : 0, 0, 0};
            }
            const CutFindings once = torn_springs(sheet.topology, sheet.loads);
            const CutFindings again = torn_springs(sheet.topology, sheet.loads);
            EXPECT_EQ(std::memcmp(once.fractions.data(), again.fractions.data(), columns * rows * sizeof(glsl::vec4)),
                      0);
            const CutCounts counts = sheet.tear();
            most_pieces = std::max(most_pieces, counts.pieces);
            EXPECT_NEAR(sheet.topology.rest_area(), area, 1e-6 * area);
        }
    }
    EXPECT_GT(most_pieces, 8u);
}

/// Returns where the particles of an evenly stretched sheet are.
std::vector<glsl::vec4> stretched(const ClothModel& cloth, double along_row, double along_column) {
    std::vector<glsl::vec4> position = cloth.position;
    for (glsl::vec4& at : position) {
        at.x = static_cast<float>(double(at.x) * along_row);
        at.y = static_cast<float>(double(at.y) * along_column);
    }
    return position;
}

/// The tension is the change of the network's energy with the length, over the width.
TEST(TearTest, LoadsAreForcesPerWidthWhateverTheGrid) {
    for (const auto& [grid, compression] : {std::pair{std::array{9u, 12u}, 1.0}, {{17u, 5u}, 1.0}, {{6u, 31u}, 0.2}}) {
        SceneDescription scene = test::sheet(grid[0], grid[1], 0.6, 0.9, 4);
        Cloth& sheet = scene.cloths[0];
        sheet.stiffness = {false, 900, 250, 0, compression};
        sheet.tear = Tear{.strain = {}, .tension = 70};
        const SimulationModel model(scene);
        const ClothModel& cloth = model.cloths[0];
        const SpringNetwork network(scene, 0);
        const double across = 0.997, along = 1.008, step = 1e-5;  // what is of second order in them is left out
        const auto energy = [&](double x, double y) {
            std::vector<Vec3> position = network.rest_position;
            for (Vec3& at : position) at = {at[0] * x, at[1] * y, at[2]};
            return network.spring_energy(position);
        };
        const double along_column = (energy(across, along + step) - energy(across, along - step)) / (2 * step) / 0.54;
        const double along_row = (energy(across + step, along) - energy(across - step, along)) / (2 * step) / 0.54;
        const std::vector<glsl::vec4> loads = tear_loads(CutTopology(cloth), stretched(cloth, across, along));
        for (std::uint32_t row = 0; row < grid[1]; ++row)
            for (std::uint32_t column = 0; column < grid[0]; ++column) {
                const glsl::vec4& load = loads[row * grid[0] + column];
                if (row + 1 < grid[1]) {
                    EXPECT_NEAR(70 * double(load.y), along_column, 3e-3 * along_column) << column << ' ' << row;
                }
                if (column + 1 < grid[0]) {
                    EXPECT_NEAR(70 * double(load.x), along_row, 3e-3 * along_column) << column << ' ' << row;
                }
            }
    }
}

TEST(TearTest, TheWeakerCellDecidesAndStifferCellsBearAtLessStrain) {
    SceneDescription scene = test::sheet(3, 3, 0.2, 0.2, 4);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.stretch = 1000;
    cloth.cell_tear = {1, 0.5f, 2, 2};
    cloth.tear = Tear{.strain = 0.2, .tension = {}};
    const auto limits = [&] { return ClothGeometry(scene, cloth, false).tear_limits; };
    EXPECT_FLOAT_EQ(limits()[0].x, 0.2f) << "the row's spring of the first cell";
    EXPECT_FLOAT_EQ(limits()[1].y, 0.1f) << "the column's spring between the first two cells";
    EXPECT_FLOAT_EQ(limits()[4].y, 0.4f);
    EXPECT_EQ(limits()[4].w, 0);
    cloth.tear = Tear{.strain = {}, .tension = 100};
    cloth.cell_stiffness = {1, 1, 0.5f, 0.25f};
    EXPECT_FLOAT_EQ(limits()[0].x, 0.1f);
    EXPECT_FLOAT_EQ(limits()[1].y, 0.05f);
    EXPECT_FLOAT_EQ(limits()[4].y, 200 / 375.0f);
}

TEST(TearLimits, TensionIsThatOfTheThreadsDirection) {
    SceneDescription scene = sheet_with({});
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, {1000, 250}, 50, {}};
    cloth.tear = Tear{.strain = {}, .tension = 100};
    const glsl::vec4 limit = tear_limits(cloth, Grid(cloth))[2 * columns + 3];
    EXPECT_FLOAT_EQ(limit.x, 0.1f);
    EXPECT_FLOAT_EQ(limit.y, 0.4f);
    EXPECT_FLOAT_EQ(limit.z, 50.0f / 2 / 1000) << "the cells are square: 2 a^2 / (2 a^2 n)";
    EXPECT_FLOAT_EQ(limit.w, 50.0f / 2 / 250);
}

}  // namespace
}  // namespace drape
