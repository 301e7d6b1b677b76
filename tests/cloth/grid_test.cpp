// Whole grids and grids with holes have the right masses, stiffness shares and triangles.
#include "cloth/grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "twin/kernels.h"

namespace drape {
namespace {

double total_mass(const Grid& grid) {
    double mass = 0;
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const double w = static_cast<double>(grid.relative_inverse_mass(column, row));
            if (w > 0) mass += 1 / w;
        }
    return mass;
}

TEST(GridTest, BordersCarryHalfAndCornersAQuarterOfTheMass) {
    const Grid grid(5, 4);
    EXPECT_EQ(grid.relative_inverse_mass(2, 2), 1.0f);
    EXPECT_EQ(grid.relative_inverse_mass(0, 2), 2.0f);
    EXPECT_EQ(grid.relative_inverse_mass(3, 0), 2.0f);
    EXPECT_EQ(grid.relative_inverse_mass(4, 3), 4.0f);
    EXPECT_DOUBLE_EQ(total_mass(grid), 4 * 3);  // one inner mass per cell
}

TEST(GridTest, SpringsAlongABorderHaveHalfTheStiffnessAndDiagonalsNever) {
    const Grid grid(5, 4);
    for (std::uint32_t row = 0; row < 4; ++row)
        for (std::uint32_t column = 0; column < 5; ++column) {
            const glsl::vec4 share = grid.spring_shares(column, row);
            const glsl::ivec2 at{static_cast<int>(column), static_cast<int>(row)};
            // The mask of a whole grid agrees with the shader's rule without a mask.
            if (column < 4) {
                EXPECT_EQ(share.x, glsl::border_share(at, {1, 0}, {5, 4}));
            }
            if (row < 3) {
                EXPECT_EQ(share.y, glsl::border_share(at, {0, 1}, {5, 4}));
            }
            if (column < 4 && row < 3) {
                EXPECT_EQ(share.z, 1.0f);
            }
            if (column > 0 && row < 3) {
                EXPECT_EQ(share.w, 1.0f);
            }
        }
    EXPECT_EQ(grid.spring_shares(1, 0).x, 0.5f);
    EXPECT_EQ(grid.spring_shares(1, 1).x, 1.0f);
}

TEST(GridTest, CellsThatDifferGiveTheirOwnSharesAndMasses) {
    Cloth cloth;
    cloth.grid = {3, 3};
    cloth.cell_stiffness = {0.5f, 1, 0.25f, 0.75f};
    cloth.cell_density = {1, 2, 3, 4};
    const Grid grid(cloth);
    EXPECT_FALSE(grid.whole());
    EXPECT_EQ(grid.spring_shares(0, 1).x, 0.375f) << "half of the cells above and below";
    EXPECT_EQ(grid.spring_shares(1, 0).y, 0.75f);
    EXPECT_EQ(grid.spring_shares(0, 0).x, 0.25f) << "along the border";
    EXPECT_EQ(grid.spring_shares(1, 1).z, 0.75f);
    EXPECT_EQ(grid.spring_shares(1, 1).w, 0.25f);
    EXPECT_EQ(grid.relative_inverse_mass(1, 1), 0.4f);
    EXPECT_EQ(grid.relative_inverse_mass(0, 0), 4.0f);
    EXPECT_EQ(grid.relative_inverse_mass(2, 1), 4.0f / 6.0f);
}

TEST(GridTest, AHoleTakesItsCellsSpringsMassAndTriangles) {
    const IndexBox hole{{1, 1}, {4, 3}};  // 3 x 2 cells
    const Grid grid(6, 5, {&hole, 1});
    EXPECT_FALSE(grid.whole());
    EXPECT_EQ(grid.cell(1, 1), 0u);
    EXPECT_EQ(grid.cell(0, 1), upper_triangle | lower_triangle);
    EXPECT_EQ(grid.relative_inverse_mass(2, 2), 0.0f) << "a particle without a cell is fixed";
    EXPECT_EQ(grid.relative_inverse_mass(1, 1), 4.0f / 3.0f) << "hole corner: three cells";
    EXPECT_EQ(grid.relative_inverse_mass(2, 1), 2.0f) << "hole border: two cells";
    EXPECT_NEAR(total_mass(grid), 5 * 4 - 6, 1e-6);
    EXPECT_EQ(grid.spring_shares(1, 1).x, 0.5f) << "spring along the hole's border";
    EXPECT_EQ(grid.spring_shares(2, 2).x, 0.0f) << "spring inside the hole";
    EXPECT_EQ(grid.spring_shares(1, 1).z, 0.0f);
    EXPECT_EQ(grid.spring_shares(2, 1).w, 0.0f) << "the diagonal of cell (1, 1) owned by its right particle";
    EXPECT_EQ(grid.triangle_indices().size(), (20u - 6u) * 6u);
}

TEST(GridTest, TrianglesCoverEachCellOnceWithOneOrientation) {
    const Grid grid(4, 3);
    const std::vector<std::uint32_t> indices = grid.triangle_indices();
    ASSERT_EQ(indices.size(), 3u * 2u * 6u);
    int doubled_area = 0;
    for (std::size_t k = 0; k < indices.size(); k += 3) {
        const auto x = [&](std::size_t i) { return static_cast<int>(indices[k + i] % 4); };
        const auto y = [&](std::size_t i) { return static_cast<int>(indices[k + i] / 4); };
        const int area = (x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0));
        EXPECT_EQ(area, 1);
        doubled_area += area;
    }
    EXPECT_EQ(doubled_area, 2 * 3 * 2);
}

}  // namespace
}  // namespace drape
