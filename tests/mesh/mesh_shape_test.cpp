// Distances to meshes are held against those of the shapes that they are triangles of, and every kind of surface is
// taken, mended or refused.
#include "mesh/mesh_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/vectors.h"
#include "mesh/mesh_error.h"
#include "support/meshes.h"

namespace drape {
namespace {

using test::Triangles;
using testing::HasSubstr;

MeshShape shape_of(const Triangles& mesh, std::optional<double> shell = {}) {
    return MeshShape(mesh.vertices, mesh.triangles, shell);
}

double box_distance(const Vec3& half, const Vec3& at) {
    Vec3 out{};
    double inside = -1e300;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        out[axis] = std::max(std::abs(at[axis]) - half[axis], 0.0);
        inside = std::max(inside, std::abs(at[axis]) - half[axis]);
    }
    return inside > 0 ? length(out) : inside;
}

/// Calls `see(point)` for points in a box around the origin.
template <class See>
void at_points(double half, const See& see) {
    std::mt19937 random(2604);
    std::uniform_real_distribution<double> place(-half, half);
    for (int k = 0; k < 3000; ++k) see(Vec3{place(random), place(random), place(random)});
}

/// Says why a strict body is refused.
std::string refusal(const Triangles& mesh) {
    try {
        MeshShape(mesh.vertices, mesh.triangles, std::nullopt, nullptr, Solid::strict);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "taken";
}

TEST(MeshShapeTest, BoxIsExact) {
    const Vec3 half{0.3, 0.2, 0.5};
    const MeshShape shape = shape_of(test::box_mesh(half));
    at_points(0.8, [&](const Vec3& at) { EXPECT_NEAR(shape.distance(at), box_distance(half, at), 1e-12); });
    // Lines along faces, edges and corners have no side of their own.
    for (const double y : {-0.2, 0.0, 0.2})
        for (const double z : {-0.5, 0.0, 0.5})
            for (const double x : {-0.31, -0.1, 0.0, 0.29, 0.31})
                EXPECT_NEAR(shape.distance({x, y, z}), box_distance(half, {x, y, z}), 1e-12) << x << y << z;
    EXPECT_NEAR(shape.inner_radius(), 0.2, 0.01);
}

TEST(MeshShapeTest, RoundOnesAreWithinTheirFacets) {
    const double ring = 0.4, tube = 0.15, half = 0.3, radius = 0.2;
    const MeshShape ball = shape_of(test::ball_mesh(0.5, 128)), torus = shape_of(test::torus_mesh(ring, tube, 256)),
                    capsule = shape_of(test::capsule_mesh(half, radius, 128));
    at_points(0.8, [&](const Vec3& at) {
        EXPECT_NEAR(ball.distance(at), length(at) - 0.5, 6e-4);
        EXPECT_NEAR(torus.distance(at), std::hypot(std::hypot(at[0], at[2]) - ring, at[1]) - tube, 3e-4);
        const Vec3 from_axis{at[0], std::max(0.0, std::abs(at[1]) - half), at[2]};
        EXPECT_NEAR(capsule.distance(at), length(from_axis) - radius, 3e-4);
    });
    EXPECT_NEAR(torus.inner_radius(), tube, 0.02);
}

TEST(MeshShapeTest, FrameIsTheMiddleOfTheBoundingBox) {
    Triangles mesh = test::box_mesh({0.3, 0.2, 0.5});
    test::shift(mesh, {7, -3, 2});
    const MeshShape shape = shape_of(mesh);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(shape.middle()[axis], (Vec3{7, -3, 2})[axis], 1e-12);
        EXPECT_NEAR(shape.half_extents()[axis], (Vec3{0.3, 0.2, 0.5})[axis], 1e-12);
    }
    EXPECT_NEAR(shape.distance({0, 0, 0}), -0.2, 1e-12);
}

TEST(MeshShapeTest, PartsThatOverlapAreOneBody) {
    Triangles mesh = test::box_mesh({0.3, 0.1, 0.1}), other = test::box_mesh({0.1, 0.3, 0.1});
    test::add(mesh, other);
    const MeshShape shape = shape_of(mesh);
    at_points(0.6, [&](const Vec3& at) {
        const double one = box_distance({0.3, 0.1, 0.1}, at), two = box_distance({0.1, 0.3, 0.1}, at);
        EXPECT_EQ(shape.distance(at) < 0, std::min(one, two) < 0);
        if (std::min(one, two) > 0) {
            EXPECT_NEAR(shape.distance(at), std::min(one, two), 1e-12);
        }
    });
}

TEST(MeshShapeTest, HollowOnesHaveAnInside) {
    Triangles mesh = test::box_mesh({0.4, 0.4, 0.4}), hole = test::box_mesh({0.2, 0.2, 0.2});
    for (Triangle& triangle : hole.triangles) std::swap(triangle[1], triangle[2]);
    test::add(mesh, hole);
    const MeshShape shape = shape_of(mesh);
    EXPECT_NEAR(shape.distance({0, 0, 0}), 0.2, 1e-12);
    EXPECT_NEAR(shape.distance({0.3, 0, 0}), -0.1, 1e-12);
}

TEST(MeshShapeTest, TrianglesAreTurnedOneWay) {
    Triangles mesh = test::ball_mesh(0.5, 16);
    const MeshShape right = shape_of(mesh);
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) std::swap(mesh.triangles[k][0], mesh.triangles[k][1]);
    const MeshShape mended = shape_of(mesh);
    for (Triangle& triangle : mesh.triangles = right.triangles()) std::swap(triangle[0], triangle[1]);
    mesh.vertices = right.vertices();
    const MeshShape turned_over = shape_of(mesh);
    at_points(0.8, [&](const Vec3& at) {
        EXPECT_NEAR(mended.distance(at), right.distance(at), 1e-12);
        EXPECT_NEAR(turned_over.distance(at), right.distance(at), 1e-12);
    });
}

TEST(MeshShapeTest, CornersInOnePlaceAreOne) {
    Triangles mesh = test::box_mesh({0.3, 0.2, 0.5}), soup;
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) soup.vertices.push_back(mesh.vertices[corner]);
    for (std::uint32_t k = 0; k < soup.vertices.size(); k += 3) soup.triangles.push_back({k, k + 1, k + 2});
    soup.triangles.push_back({0, 0, 1});
    const MeshShape shape = shape_of(soup);
    EXPECT_EQ(shape.vertices().size(), 8u);
    EXPECT_EQ(shape.triangles().size(), 12u);
}

TEST(MeshShapeTest, ShellIsThickOnBothSides) {
    Triangles sheet;
    sheet.vertices = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_THAT(refusal(sheet), HasSubstr("got one with 4 edges of one triangle alone: give \"shell\""));
    const MeshShape shape = shape_of(sheet, 0.02);
    for (const double side : {-1.0, 1.0}) EXPECT_NEAR(shape.distance({0.2, side * 0.05, 0.3}), 0.04, 1e-12);
    EXPECT_NEAR(shape.distance({0.2, 0, 0.3}), -0.01, 1e-12);
    EXPECT_NEAR(shape.half_extents()[1], 0.01, 1e-12);
}

TEST(MeshShapeTest, WhatIsNoBodyIsRefused) {
    EXPECT_THAT(refusal({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}), HasSubstr("expected triangles with an area"));
    // Two triangles, back to back.
    EXPECT_THAT(refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}), HasSubstr("bounds nothing"));
    // Three sheets meet at an edge of each.
    Triangles fins = test::box_mesh({0.3, 0.2, 0.5});
    fins.vertices.push_back({0, 0, 2});
    fins.triangles.push_back({0, 4, 8});
    EXPECT_THAT(refusal(fins), HasSubstr("edges of one triangle alone"));
    // A Klein bottle: a torus whose tube comes back mirrored.
    Triangles bottle = test::torus_mesh(1, 0.3, 16);
    for (Triangle& triangle : bottle.triangles)
        for (std::uint32_t& corner : triangle)
            if (corner % 16 == 0 && std::ranges::any_of(triangle, [](std::uint32_t c) { return c % 16 == 15; }))
                corner = ((8 - corner / 16) % 8) * 16;
    EXPECT_THAT(refusal(bottle), HasSubstr("turn one way"));
}

}  // namespace
}  // namespace drape
