#include "mesh/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"

namespace drape {
namespace {

std::shared_ptr<const MeshShape> field_shape(const test::Triangles& mesh) {
    return std::make_shared<const MeshShape>(mesh.vertices, mesh.triangles, std::nullopt);
}

TEST(DistanceFieldTest, SamplesNearTheSurfaceAreItsDistances) {
    const auto shape = field_shape(test::torus_mesh(0.3, 0.1, 64));
    const double margin = 0.03;
    const auto field = distance_field(shape, 0.02, margin);
    EXPECT_EQ(field->samples.size(), field_points(*shape, 0.02, margin));
    ASSERT_EQ(field->samples.size(), std::size_t{field->size[0]} * field->size[1] * field->size[2]);
    std::size_t near = 0;
    for (std::uint32_t z = 0, k = 0; z < field->size[2]; ++z)
        for (std::uint32_t y = 0; y < field->size[1]; ++y)
            for (std::uint32_t x = 0; x < field->size[0]; ++x, ++k) {
                const double exact =
                    shape->distance({field->lower[0] + x * field->spacing, field->lower[1] + y * field->spacing,
                                     field->lower[2] + z * field->spacing});
                const bool is_near = std::abs(exact) <= margin;
                near += is_near;
                EXPECT_NEAR(field->samples[k], exact, is_near ? 1e-7 : 0.021 * std::abs(exact));
            }
    EXPECT_GT(near, field->samples.size() / 8);
}

TEST(DistanceFieldTest, GoesBeyondTheBodyByItsMargin) {
    const auto shape = field_shape(test::box_mesh({0.3, 0.1, 0.2}));
    const auto field = distance_field(shape, 0.01, 0.05);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(field->lower[axis], -shape->half_extents()[axis] - 0.05 - 0.01);
        EXPECT_NEAR(field->lower[axis] + field->spacing * (field->size[axis] - 1), -field->lower[axis], 1e-12);
    }
}

TEST(DistanceFieldTest, SpacingKeepsItSmall) {
    const auto shape = field_shape(test::box_mesh({0.3, 0.1, 0.2}));
    EXPECT_EQ(field_spacing(*shape, 0.02, 0.01, 1'000'000), 0.02);
    const double wide = field_spacing(*shape, 1e-4, 0.01, 100'000);
    EXPECT_LE(field_points(*shape, wide, 0.01), 100'000u);
    EXPECT_GT(field_points(*shape, wide / 1.05, 0.01), 100'000u);
}

TEST(DistanceFieldTest, SameOneIsMadeOnce) {
    const auto shape = field_shape(test::box_mesh({0.3, 0.1, 0.2}));
    const auto field = distance_field(shape, 0.02, 0.01);
    EXPECT_EQ(distance_field(shape, 0.02, 0.01), field);
    EXPECT_NE(distance_field(shape, 0.03, 0.01), field);
}

}  // namespace
}  // namespace drape
