// Surfaces that are not quite closed become bodies: what was mended is told, and distances and sides are those of the
// triangles, one by one, in double precision.
#include "mesh/mesh_mending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/vectors.h"
#include "mesh/mesh_error.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_shape.h"
#include "support/meshes.h"

namespace drape {
namespace {

using test::Triangles;
using testing::HasSubstr;

MeshShape body_of(const Triangles& mesh, Solid solid = Solid::mended) {
    return MeshShape(mesh.vertices, mesh.triangles, std::nullopt, nullptr, solid);
}

std::string why_no_body(const Triangles& mesh, Solid solid = Solid::mended) {
    try {
        body_of(mesh, solid);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "taken";
}

double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = minus(b, a);
    const double square = dot(ab, ab), share = square > 0 ? std::clamp(dot(minus(p, a), ab) / square, 0.0, 1.0) : 0;
    return distance(p, plus(a, times(share, ab)));
}

/// The distance to a triangle by its plane, where the point lies over it, and by its edges.
double triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double edges = std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
    const Vec3 normal = cross(minus(b, a), minus(c, a));
    if (!(length(normal) > 0)) return edges;
    const auto over = [&](const Vec3& from, const Vec3& to) {
        return dot(cross(minus(to, from), minus(p, from)), normal) >= 0;
    };
    const bool is_over = over(a, b) && over(b, c) && over(c, a);
    return is_over ? std::min(edges, std::abs(dot(minus(p, a), normal)) / length(normal)) : edges;
}

Triangles triangles_of(const MeshShape& shape) { return {shape.vertices(), shape.triangles()}; }

template <class See>
void at_some_points(double half, const See& see) {
    std::mt19937 random(70);
    std::uniform_real_distribution<double> place(-half, half);
    for (int k = 0; k < 1000; ++k) see(Vec3{place(random), place(random), place(random)});
}

/// Holds distances and sides of a shape against those of its triangles.
void expect_brute_force(const MeshShape& shape, double half) {
    const Triangles mesh = triangles_of(shape);
    at_some_points(half, [&](const Vec3& at) {
        double nearest = 1e300;
        for (const auto& [a, b, c] : mesh.triangles)
            nearest = std::min(nearest, triangle_distance(at, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
        const double turns = winding(mesh, at);
        EXPECT_NEAR(shape.winding(at, 0, 1)[0], turns, 1e-9);
        EXPECT_NEAR(shape.distance(at), std::abs(turns) > 0.5 ? -nearest : nearest, 1e-12);
    });
}

/// Takes the triangles away that have a vertex.
Triangles holed(Triangles mesh, std::uint32_t vertex) {
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return std::ranges::find(t, vertex) != t.end(); });
    return mesh;
}

TEST(MeshMending, AHoleOfSixEdgesIsClosed) {
    const Triangles whole = test::ball_mesh(0.5, 32), mesh = holed(whole, 32 * 8 + 5);
    ASSERT_EQ(mesh.triangles.size() + 6, whole.triangles.size());
    EXPECT_THAT(why_no_body(mesh, Solid::strict), HasSubstr("got one with 6 edges of one triangle alone"));
    const MeshShape shape = body_of(mesh);
    ASSERT_EQ(shape.mending().closed.size(), 1u);
    EXPECT_EQ(shape.mending().closed[0].ring.size(), 6u);
    EXPECT_EQ(shape.triangles().size() + 2, body_of(whole).triangles().size());
    // Six triangles of a sphere cut by 32 meridians and 16 circles of latitude, on its equator.
    const double edge = 0.5 * 2 * std::numbers::pi / 32;
    EXPECT_NEAR(shape.mending().closed[0].area, 3 * edge * edge, 0.02 * 3 * edge * edge);
    EXPECT_THAT(shape.mending().text(), testing::MatchesRegex("1 hole closed \\(6 edges, 0.0[0-9]* m.2\\)"));
    expect_brute_force(shape, 0.8);
    const MeshShape right = body_of(whole);
    at_some_points(0.8, [&](const Vec3& at) { EXPECT_NEAR(shape.distance(at), right.distance(at), edge * edge); });
}

TEST(MeshMending, RingsThatTouchAreHolesOfTheirOwn) {
    // Two fans whose rings have one vertex in common.
    Triangles mesh = holed(holed(test::ball_mesh(0.5, 32), 32 * 8 + 5), 32 * 8 + 7);
    const MeshShape shape = body_of(mesh);
    ASSERT_EQ(shape.mending().closed.size(), 2u);
    for (const Hole& hole : shape.mending().closed) EXPECT_EQ(hole.ring.size(), 6u);
    expect_brute_force(shape, 0.8);
}

TEST(MeshMending, AHoleThatIsNotConvexIsClosedWithin) {
    // A level star in a sheet that a box's upper face is: its corners lie on two circles by turns.
    constexpr std::uint32_t points = 24;
    Triangles mesh = test::box_mesh({0.5, 0.5, 0.5});
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](std::uint32_t k) { return mesh.vertices[k][1] > 0; });
    });
    for (std::uint32_t k = 0; k < points; ++k) {
        const double angle = 2 * std::numbers::pi * k / points, radius = k % 2 == 0 ? 0.1 : 0.04;
        mesh.vertices.push_back({radius * std::cos(angle), 0.5, radius * std::sin(angle)});
    }
    // The face around the star: its corners turn from the star's points to the box's, seen from above.
    const auto star = [](std::uint32_t k) { return 8 + k % points; };
    const std::uint32_t corners[] = {7, 3, 2, 6};  // at angles of 45, -45 + 360 k degrees, and so on
    const auto corner_at = [&](std::uint32_t k) { return corners[(4 - (k / (points / 4)) % 4) % 4]; };
    for (std::uint32_t k = 0; k < points; ++k) {
        mesh.triangles.push_back({star(k), corner_at(k), star(k + 1)});
        if (corner_at(k) != corner_at(k + 1)) mesh.triangles.push_back({star(k + 1), corner_at(k), corner_at(k + 1)});
    }
    const MeshShape shape = body_of(mesh);
    ASSERT_EQ(shape.mending().closed.size(), 1u);
    const double area = 0.5 * points * 0.1 * 0.04 * std::sin(2 * std::numbers::pi / points);
    EXPECT_NEAR(shape.mending().closed[0].area, area, 1e-12);
    EXPECT_NEAR(shape.volume(), 1, 1e-12);
    expect_brute_force(shape, 0.8);
}

TEST(MeshMending, ATwentiethOfTheTrianglesTurnedOver) {
    const Triangles right = test::torus_mesh(0.4, 0.15, 48);
    Triangles mesh = right;
    std::mt19937 random(5);
    std::size_t turned = 0;
    for (Triangle& triangle : mesh.triangles)
        if (random() % 20 == 0) {
            std::swap(triangle[0], triangle[1]);
            ++turned;
        }
    mesh.triangles.erase(mesh.triangles.begin() + 100);
    const MeshShape shape = body_of(mesh);
    EXPECT_NEAR(static_cast<double>(shape.mending().turned), static_cast<double>(turned), 1);
    EXPECT_EQ(shape.mending().turned_parts, 0u);
    EXPECT_THAT(shape.mending().text(), HasSubstr("turned as the others of the part"));
    EXPECT_GT(shape.volume(), 0);
    const MeshShape whole = body_of(right);
    at_some_points(0.8, [&](const Vec3& at) { EXPECT_NEAR(shape.distance(at), whole.distance(at), 1e-12); });
}

TEST(MeshMending, VerticesBesideEachOtherAreWelded) {
    const Triangles right = test::ball_mesh(0.5, 24);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-1e-7, 1e-7);
    Triangles soup;
    for (const Triangle& triangle : right.triangles)
        for (const std::uint32_t corner : triangle) {
            const Vec3& at = right.vertices[corner];
            soup.triangles.resize((soup.vertices.size() + 3) / 3);
            soup.triangles.back()[soup.vertices.size() % 3] = static_cast<std::uint32_t>(soup.vertices.size());
            soup.vertices.push_back({at[0] + off(random), at[1] + off(random), at[2] + off(random)});
        }
    EXPECT_THAT(why_no_body(soup, Solid::strict), HasSubstr("edges of one triangle alone"));
    std::vector<std::uint32_t> places;
    const MeshShape shape(soup.vertices, soup.triangles, std::nullopt, &places);
    EXPECT_EQ(shape.mending().welded, soup.vertices.size() - (right.vertices.size() - 46));
    EXPECT_TRUE(shape.mending().closed.empty() && shape.mending().rim.empty());
    ASSERT_EQ(places.size(), soup.vertices.size());
    for (std::size_t k = 0; k < places.size(); ++k)
        EXPECT_LT(distance(plus(shape.middle(), shape.vertices().at(places[k])), soup.vertices[k]), 4e-7);
    const MeshShape whole = body_of(right);
    at_some_points(0.8, [&](const Vec3& at) { EXPECT_NEAR(shape.distance(at), whole.distance(at), 1e-6); });
}

TEST(MeshMending, AKilometreFromTheOrigin) {
    const Triangles near = test::ball_mesh(0.05, 64);
    const MeshShape right = body_of(near);
    Triangles mesh = holed(near, 64 * 16 + 5);
    test::shift(mesh, {1000, 250, -700});
    const std::string path = test::obj_file(mesh, "far_ball.obj", 17);
    const auto shape = read_mesh(path, 1, std::nullopt);
    EXPECT_EQ(shape->mending().closed.size(), 1u);
    for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(shape->half_extents()[axis], right.half_extents()[axis], 1e-12);
    expect_brute_force(*shape, 0.08);
    at_some_points(0.08, [&](const Vec3& at) { EXPECT_NEAR(shape->distance(at), right.distance(at), 3e-5); });
}

/// A cup: a can of so many sides without a lid.
Triangles cup(std::uint32_t sides) {
    Triangles mesh;
    mesh.vertices = {{0, -0.3, 0}};
    for (const double y : {-0.3, 0.3})
        for (std::uint32_t k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            mesh.vertices.push_back({0.2 * std::sin(angle), y, 0.2 * std::cos(angle)});
        }
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t a = 1 + k, b = 1 + (k + 1) % sides;
        mesh.triangles.push_back({0, b, a});
        mesh.triangles.push_back({a, b, sides + b});
        mesh.triangles.push_back({a, sides + b, sides + a});
    }
    return mesh;
}

TEST(MeshMending, AnOpenCupIsAShellOrFilled) {
    const Triangles mesh = cup(40);
    EXPECT_THAT(why_no_body(mesh),
                testing::AllOf(HasSubstr("40 edges of one triangle alone, one at ("), HasSubstr("0.3, "),
                               HasSubstr("\"shell\""), HasSubstr("\"solid\": \"filled\"")));
    const MeshShape shell(mesh.vertices, mesh.triangles, 0.01);
    EXPECT_NEAR(shell.distance({0, 0, 0}), 0.2 * std::cos(std::numbers::pi / 40) - 0.005, 1e-12);
    const MeshShape body = body_of(mesh, Solid::filled);
    EXPECT_NEAR(body.distance({0, 0, 0}), -0.2 * std::cos(std::numbers::pi / 40), 1e-12);
    EXPECT_NEAR(body.distance({0.05, 0.4, 0}), 0.1, 1e-12);
    EXPECT_NEAR(body.distance({0.05, 0.25, 0}), -0.05, 1e-12);
    EXPECT_NEAR(body.mending().closed.at(0).area, 20 * 0.04 * std::sin(2 * std::numbers::pi / 40), 1e-12);
    expect_brute_force(body, 0.5);
}

TEST(MeshMending, AHoleOfVeryManyEdgesStaysOpen) {
    EXPECT_THAT(why_no_body(cup(10'001), Solid::filled),
                testing::AllOf(HasSubstr("10001 edges of one triangle alone"), HasSubstr("or 10000 edges")));
}

/// The faces of a box, each made smaller about its middle. Each one's hole would be as large as it is.
Triangles sheets(double share) {
    Triangles mesh, box = test::box_mesh({0.3, 0.2, 0.5});
    for (std::size_t face = 0; face < 6; ++face) {
        const auto before = static_cast<std::uint32_t>(mesh.vertices.size());
        Vec3 middle{};
        for (std::size_t k = 2 * face; k < 2 * face + 2; ++k)
            for (const std::uint32_t corner : box.triangles[k])
                middle = plus(middle, times(1.0 / 6, box.vertices[corner]));
        for (const Vec3& vertex : box.vertices)
            mesh.vertices.push_back(plus(middle, times(share, minus(vertex, middle))));
        for (std::size_t k = 2 * face; k < 2 * face + 2; ++k) {
            const auto& [a, b, c] = box.triangles[k];
            mesh.triangles.push_back({before + a, before + b, before + c});
        }
    }
    return mesh;
}

TEST(MeshMending, SheetsThatDoNotMeetBoundABodyByTheirWindingNumber) {
    const Triangles mesh = sheets(0.998);
    EXPECT_THAT(why_no_body(sheets(0.9)), HasSubstr("got one with 24 edges of one triangle alone, one at ("));
    EXPECT_THAT(why_no_body(mesh, Solid::strict), HasSubstr("got one with 24 edges of one triangle alone"));
    const MeshShape shape = body_of(mesh);
    EXPECT_EQ(shape.mending().rim.size(), 24u);
    EXPECT_THAT(shape.mending().text(), HasSubstr("24 edges stay open"));
    expect_brute_force(shape, 0.7);
    EXPECT_NEAR(shape.inner_radius(), 0.2, 0.01);
}

TEST(MeshMending, EachPartTurnsOutwards) {
    Triangles mesh = test::box_mesh({0.1, 0.1, 0.1}), other = mesh;
    for (Triangle& triangle : other.triangles) std::swap(triangle[1], triangle[2]);
    test::shift(other, {0.5, 0, 0});
    test::add(mesh, other);
    EXPECT_THAT(why_no_body(mesh, Solid::strict), HasSubstr("bounds nothing"));
    const MeshShape shape = body_of(mesh);
    EXPECT_EQ(shape.mending().text(), "1 of 2 parts turned over");
    EXPECT_NEAR(shape.volume(), 2 * 0.008, 1e-12);
    expect_brute_force(shape, 0.6);
    // A cavity stays one, also where all is inside out, and what is in it is a body again.
    Triangles hollow = test::box_mesh({0.4, 0.4, 0.4});
    for (const double half : {0.3, 0.2}) {
        Triangles inner = test::box_mesh({half, half, half});
        if (half > 0.25)
            for (Triangle& triangle : inner.triangles) std::swap(triangle[1], triangle[2]);
        test::add(hollow, inner);
    }
    const double volume = 0.512 - 0.216 + 0.064;
    EXPECT_NEAR(body_of(hollow).volume(), volume, 1e-12);
    EXPECT_EQ(body_of(hollow).mending().text(), "");
    for (Triangle& triangle : hollow.triangles) std::swap(triangle[1], triangle[2]);
    EXPECT_NEAR(body_of(hollow).volume(), volume, 1e-12);
    EXPECT_EQ(body_of(hollow).mending().text(), "3 of 3 parts turned over");
}

TEST(MeshMending, DoubledShellsAndFinsAndCracks) {
    // Every triangle twice, the other way too.
    Triangles doubled = test::ball_mesh(0.5, 16);
    const std::size_t count = doubled.triangles.size(), single_count = body_of(doubled).triangles().size();
    for (std::size_t k = 0; k < count; ++k) {
        Triangle back = doubled.triangles[k];
        std::swap(back[0], back[1]);
        doubled.triangles.push_back(back);
    }
    EXPECT_THAT(why_no_body(doubled, Solid::strict), HasSubstr("bounds nothing"));
    const MeshShape single = body_of(doubled);
    EXPECT_EQ(single.mending().doubled, single_count);
    expect_brute_force(single, 0.8);
    // A small fin at an edge of a box, where three triangles meet.
    Triangles fin = test::box_mesh({0.3, 0.2, 0.5});
    fin.vertices.push_back({-0.35, -0.2, 0});
    fin.triangles.push_back({0, 4, 8});
    const MeshShape with_fin = body_of(fin);
    EXPECT_EQ(with_fin.mending().closed.size(), 1u);
    EXPECT_NEAR(with_fin.volume(), 0.24, 1e-12);
    expect_brute_force(with_fin, 0.7);
    // A vertex of one triangle in the middle of an edge of another.
    Triangles crack = test::box_mesh({0.3, 0.2, 0.5});
    const auto [a, b, c] = crack.triangles[0];
    crack.triangles[0] = {a, b, 8};
    crack.triangles.push_back({a, 8, c});
    crack.vertices.push_back(times(0.5, plus(crack.vertices[b], crack.vertices[c])));
    const MeshShape closed = body_of(crack);
    ASSERT_EQ(closed.mending().closed.size(), 1u);
    EXPECT_EQ(closed.mending().closed[0].area, 0);
    expect_brute_force(closed, 0.7);
}

TEST(MeshMending, WhatCannotBeMendedIsToldWithItsPlace) {
    // A Moebius strip of 30 quads, at x = 5.
    Triangles strip;
    for (std::uint32_t k = 0; k < 30; ++k) {
        const double angle = 2 * std::numbers::pi * k / 30;
        for (const double side : {-0.1, 0.1}) {
            const double out = 0.5 + side * std::cos(angle / 2);
            strip.vertices.push_back({5 + out * std::cos(angle), side * std::sin(angle / 2), out * std::sin(angle)});
        }
        const std::uint32_t a = 2 * k, b = a + 1, c = k < 29 ? a + 2 : 1, d = k < 29 ? a + 3 : 0;
        strip.triangles.push_back({a, b, c});
        strip.triangles.push_back({b, d, c});
    }
    EXPECT_THAT(why_no_body(strip), testing::AllOf(HasSubstr("one at ("), HasSubstr(") m: the surface has one side"),
                                                   HasSubstr("turn one way")));
    // Two boxes with a face in common, of one of which all other faces are inside out.
    Triangles boxes = test::box_mesh({0.1, 0.1, 0.1}), other = boxes;
    for (std::size_t k = 0; k < other.triangles.size(); ++k)
        if (k / 2 != 0) std::swap(other.triangles[k][1], other.triangles[k][2]);
    test::shift(other, {0.2, 0, 0});
    test::add(boxes, other);
    EXPECT_THAT(why_no_body(boxes, Solid::strict), testing::AllOf(HasSubstr("got 4 that cannot at an edge at (0.1, "),
                                                                  HasSubstr("more than two triangles")));
    const MeshShape both = body_of(boxes);
    EXPECT_NEAR(both.volume(), 0.016, 1e-12);
    expect_brute_force(both, 0.5);
}

}  // namespace
}  // namespace drape
