// The meshes that files have of colliders are closed, turned outwards, and lie on the true surfaces.
#include "picture/collider_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/vectors.h"
#include "mesh/mesh_shape.h"
#include "run/written_colliders.h"
#include "support/meshes.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

constexpr double pi = std::numbers::pi;

/// Returns six times the volume that the triangles enclose.
double six_volumes(const ColliderSurface& surface) {
    double six = 0;
    for (const auto& [a, b, c] : surface.triangles)
        six += dot(surface.vertices[a], cross(surface.vertices[b], surface.vertices[c]));
    return six;
}

/// Every edge has one triangle on each side, which goes along it the other way.
void expect_closed(const ColliderSurface& surface) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& triangle : surface.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

/// A box that becomes twice as large within a second.
TEST(WrittenColliders, HaveTheFormOfTheTime) {
    const auto larger = [](const Vec3& vertex, std::size_t pose) { return times(1.0 + double(pose), vertex); };
    SceneDescription scene;
    scene.colliders = {{Sphere{}}, {test::deforming_mesh(test::box_mesh({0.1, 0.2, 0.3}), {0, 0, 0}, 2, 1, larger)}};
    const std::vector<WrittenCollider> written = written_colliders(scene);
    ASSERT_EQ(written.size(), 2u);
    EXPECT_FALSE(written[0].moves || written[0].form);
    EXPECT_TRUE(written[1].moves);
    const std::vector<float> begin = placed_vertices(written[1], 0), half = placed_vertices(written[1], 0.5),
                             end = placed_vertices(written[1], 1);
    ASSERT_EQ(begin.size(), 24u);
    const auto height = [](const std::vector<float>& at) {
        float least = at[1], most = at[1];
        for (std::size_t i = 1; i < at.size(); i += 3) least = std::min(least, at[i]), most = std::max(most, at[i]);
        return most - least;
    };
    EXPECT_NEAR(height(begin), 0.4, 1e-6);
    EXPECT_NEAR(height(half), 0.6, 1e-6);
    EXPECT_NEAR(height(end), 0.8, 1e-6);
}

struct Body {
    const char* name;
    ColliderShape shape;
    double volume;  ///< m^3
    std::size_t vertices, triangles;
};

class Bodies : public testing::TestWithParam<Body> {};

TEST_P(Bodies, SurfaceIsClosedAndOnTheTrueOne) {
    const auto& [name, shape, volume, vertices, triangles] = GetParam();
    const Collider collider{shape};
    const ColliderSurface surface = collider_surface(collider, 48, {});
    EXPECT_EQ(surface.vertices.size(), vertices);
    EXPECT_EQ(surface.triangles.size(), triangles);
    expect_closed(surface);
    for (const Vec3& at : surface.vertices)
        EXPECT_NEAR(std::visit([&](const auto& known) { return exact::shape_distance(known, at); }, shape), 0, 1e-6);
    const double enclosed = six_volumes(surface) / 6;
    EXPECT_LE(enclosed, volume * (1 + 1e-5));
    EXPECT_GE(enclosed, volume * 0.99);
}

/// Half of a cube.
Mesh wedge() {
    Mesh mesh;
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    mesh.shape = std::make_shared<MeshShape>(
        corners,
        std::vector<Triangle>{{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}},
        std::nullopt);
    return mesh;
}

// The capsule is two balls of 0.2 and 0.1 m, 0.6 m apart: the cone touches both where its sine is 1/6.
const double capsule_volume = [] {
    const double sine = 0.1 / 0.6, cosine = std::sqrt(1 - sine * sine);
    const double low = 0.2 * cosine, high = 0.1 * cosine, height = 0.6 - 0.1 * sine;
    const auto cap = [](double radius, double depth) { return pi * depth * depth * (radius - depth / 3); };
    return pi * height * (low * low + low * high + high * high) / 3 + cap(0.2, 0.2 * (1 + sine)) +
           cap(0.1, 0.1 * (1 - sine));
}();

INSTANTIATE_TEST_SUITE_P(
    Of, Bodies,
    testing::Values(Body{"Sphere", Sphere{{1, 2, 3}, 0.5}, pi / 6, 1106, 2208},
                    Body{"Box", Box{{1, 2, 3}, {0.1, 0.2, 0.3}}, 0.048, 8, 12},
                    Body{"Ellipsoid", Ellipsoid{{1, 2, 3}, {0.1, 0.2, 0.3}}, 4 * pi / 3 * 0.006, 1106, 2208},
                    Body{"Capsule", Capsule{{0, 0, 0}, {0, 0.6, 0}, {0.2, 0.1}}, capsule_volume, 1106, 2208},
                    Body{"Mesh", wedge(), 0.5, 6, 8}),
    [](const auto& test) { return std::string(test.param.name); });

// One ball contains the other and takes half of the rows; the numbers stay, so that arrays of many runs have one shape.
TEST(ColliderSurface, NumbersFollowFromTheKind) {
    const ColliderSurface surface = collider_surface({.shape = Capsule{{0, 0, 0}, {0, 0.1, 0}, {0.1, 0.5}}}, 48, {});
    EXPECT_EQ(surface.vertices.size(), 1106u);
    EXPECT_EQ(surface.triangles.size(), 2208u);
    EXPECT_NEAR(six_volumes(surface) / 6, 4 * pi / 3 * 0.125, 0.02 * 4 * pi / 3 * 0.125);
}

// The square is around the foot of the centre, and its triangles face the way of the normal.
TEST(ColliderSurface, PlaneIsASquareBelowTheCentre) {
    const Vec3 normal{0.6, 0.8, 0};
    Collider plane{.shape = Plane{normal, 0.5}};
    plane.rotate = {0, 90, 0};
    const ColliderSurface surface = collider_surface(plane, 48, {{3, 4, 5}, 2});
    const ColliderPose pose = surface_pose(plane, 0);
    std::vector<Vec3> corners;
    Vec3 middle{};
    for (const Vec3& local : surface.vertices) {
        corners.push_back(plus(pose.center, rotate(pose.rotation, local)));
        middle = plus(middle, times(0.25, corners.back()));
    }
    ASSERT_EQ(corners.size(), 4u);
    ASSERT_EQ(surface.triangles.size(), 2u);
    const Vec3 up{0, 0.8, -0.6}, foot{0.3, 0.4, 0};
    for (const Vec3& corner : corners) {
        EXPECT_NEAR(dot(up, minus(corner, foot)), 0, 1e-6);
        EXPECT_NEAR(length(minus(corner, middle)), 2 * std::sqrt(2.0), 1e-6);
    }
    const Vec3 below = minus(Vec3{3, 4, 5}, times(dot(up, minus(Vec3{3, 4, 5}, foot)), up));
    EXPECT_NEAR(length(minus(middle, below)), 0, 1e-6);
    for (const auto& [a, b, c] : surface.triangles)
        EXPECT_NEAR(dot(up, cross(minus(corners[b], corners[a]), minus(corners[c], corners[a]))), 16, 1e-5);
}

}  // namespace
}  // namespace drape
