// A scene without a camera is framed, and its pins hang on fixtures, in numbers and in pictures.
#include "picture/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "picture/collider_mesh.h"
#include "picture/collider_surface.h"
#include "picture/fixtures.h"
#include "raster_picture.h"
#include "world/collider_pose.h"
#include "world/up.h"

namespace drape {
namespace {

/// Share of the picture that a scene's start fills: its cloths and bounded bodies, by projected triangles.
double filled_share(const SceneDescription& scene, const Camera& camera, std::uint32_t columns, std::uint32_t rows) {
    constexpr int steps = 400;
    std::vector<bool> hit(std::size_t{columns} * rows);
    const auto mark = [&](const Vec3& point) {
        const PixelPosition at = project(camera, columns, rows, point);
        if (at.x < 0 || at.y < 0 || at.x >= columns || at.y >= rows) return ADD_FAILURE() << "not in the picture";
        hit[static_cast<std::size_t>(at.y) * columns + static_cast<std::size_t>(at.x)] = true;
    };
    for (const Cloth& cloth : scene.cloths)
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; j <= steps; ++j)
                mark(cloth.placement.origin + (cloth.size[0] * i / steps) * cloth.placement.u +
                     (cloth.size[1] * j / steps) * cloth.placement.v);
    for (const Collider& collider : scene.colliders) {
        const Sphere* sphere = std::get_if<Sphere>(&collider.shape);
        for (int i = 0; sphere && i <= steps; ++i)
            for (int j = 0; j <= steps; ++j) {
                const double polar = std::numbers::pi * i / steps, around = 2 * std::numbers::pi * j / steps;
                mark(sphere->center + sphere->radius * Vec3{std::sin(polar) * std::cos(around), std::cos(polar),
                                                            std::sin(polar) * std::sin(around)});
            }
    }
    return static_cast<double>(std::ranges::count(hit, true)) / static_cast<double>(hit.size());
}

SceneDescription one_cloth(const Placement& placement, const std::array<double, 2>& size) {
    SceneDescription scene;
    scene.cloths.resize(1);
    scene.cloths[0].grid = {9, 9};
    scene.cloths[0].size = size;
    scene.cloths[0].placement = placement;
    return scene;
}

Pin row_of(const Cloth& cloth) { return {.particles = {{0, 0}, {cloth.grid[0] - 1, 0}}}; }

TEST(FramingTest, AutomaticCameraFillsThePictureWithWhatIsThere) {
    SceneDescription flag = one_cloth({{-0.75, 2.1, 0}, {1, 0, 0}, {0, -1, 0}}, {1.5, 1});
    flag.cloths[0].pins = {{.particles = {{0, 0}, {0, 8}}}};
    flag.wind.velocity = {5, 0, 1};
    SceneDescription sheet = one_cloth({{5, 1.6, -3}, {1, 0, 0}, {0, -1, 0}}, {1, 1});
    sheet.cloths[0].pins = {row_of(sheet.cloths[0])};
    SceneDescription small = sheet;  // the same sheet in millimetres
    small.cloths[0].size = {1e-3, 1e-3};
    for (const SceneDescription& scene : {flag, sheet, small})
        for (const std::array<std::uint32_t, 2>& size : {std::array{640u, 360u}, {360u, 360u}, {360u, 640u}}) {
            const Camera camera = picture_camera(scene, size[0], size[1]);
            const double share = filled_share(scene, camera, size[0], size[1]);
            // A camera as near as a tenth to spare allows; the one that was here before let one side have less.
            EXPECT_GT(share, size[0] < size[1] ? 0.2 : 0.29) << size[0];
            EXPECT_LT(share, 0.6) << size[0];
        }
    // A cloth falls on a sphere: half of the picture is the way that it falls.
    SceneDescription fall = one_cloth({{-0.8, 1.4, -0.8}, {1, 0, 0}, {0, 0, 1}}, {1.6, 1.6});
    fall.colliders = {{Plane{}}, {Sphere{{0, 0.85, 0}, 0.4}}};
    const double share = filled_share(fall, picture_camera(fall, 640, 360), 640, 360);
    EXPECT_GT(share, 0.15);
    EXPECT_LT(share, 0.5);
}

/// A camera shows points without room to spare: on two opposite sides some are a tenth of the half from the edge.
void expect_tight(const Camera& camera, const std::vector<Vec3>& points) {
    double across = 0, along = 0;
    for (const Vec3& point : points) {
        const PixelPosition seen = project(camera, width, height, point);
        across = std::max(across, std::abs(2 * seen.x / width - 1));
        along = std::max(along, std::abs(2 * seen.y / height - 1));
    }
    EXPECT_NEAR(std::max(across, along), 0.9, 1e-6);
}

TEST(FramingTest, ShowsPointsWithNoMoreRoomThanATenth) {
    std::mt19937 random(72);
    std::uniform_real_distribution<double> place(-1, 1);
    for (int round = 0; round < 50; ++round) {
        SceneDescription scene;
        scene.up = round % 2 ? Up::z : Up::y;
        if (round % 3 == 0) scene.camera = Camera{{place(random), 5, place(random)}, {0, place(random), 0}, 60};
        if (round == 9) scene.camera = Camera{{0, 5, 0}, {0, 0, 0}, 60};
        // Not so deep that the eye would have to be among them.
        const Vec3 size{std::exp(place(random)), std::exp(place(random)), std::exp(place(random))};
        Framing framing(scene, static_cast<double>(width) / height);
        EXPECT_FALSE(framing.camera());
        std::vector<Vec3> points;
        for (int k = 0; k < 40; ++k) {
            points.push_back({10 + size[0] * place(random), size[1] * place(random), size[2] * place(random)});
            framing.add(points.back());
        }
        Camera camera = framing.camera().value();
        camera.up = in_world(scene.up, {0, 1, 0});
        expect_tight(camera, points);
    }
}

TEST(FramingTest, CollidersReachAsFarAsTheirPoints) {
    const std::vector<ColliderShape> shapes{Sphere{{1, 2, 3}, 0.7}, Box{{0, 1, 0}, {0.2, 0.5, 0.9}},
                                            Ellipsoid{{0, 0, 1}, {0.3, 0.6, 0.2}},
                                            Capsule{{0, 0, 0}, {0.5, 1, 0.3}, {0.1, 0.4}}};
    std::mt19937 random(3);
    std::normal_distribution<double> draw;
    for (const ColliderShape& shape : shapes)
        for (int round = 0; round < 20; ++round) {
            Collider collider{.shape = shape, .rotate = {20, -50, 100}};
            collider.path.keys = {{0, {0, 0, 0}, {}}, {1, {1, -2, 0.5}, {0, 90, 0}}};
            const double time = 0.05 * round;
            const Vec3 along{draw(random), draw(random), draw(random)};
            const ColliderPose pose = surface_pose(collider, time);
            double farthest = -1e300;
            for (const Vec3& vertex : collider_surface(collider, 256, {}).vertices)
                farthest = std::max(farthest, dot(pose.center + rotate(pose.rotation, vertex), along));
            EXPECT_NEAR(reach_along(collider, time, along).value(), farthest,
                        2e-4 * std::hypot(along[0], along[1], along[2]));
        }
    EXPECT_FALSE(reach_along({.shape = Plane{}}, 0, {0, 1, 0}));
}

TEST(FramingTest, TheScenesOwnCameraIsKept) {
    SceneDescription scene = one_cloth({}, {1, 1});
    scene.camera = Camera{{1, 2, 3}, {0, 1, 0}, 50};
    EXPECT_EQ(picture_camera(scene, 640, 360), *scene.camera);
}

TEST(FixtureTest, PinnedEdgesHangOnPolesAndRailsAndCornersOnPoles) {
    SceneDescription scene = one_cloth({{-0.5, 2, 0}, {1, 0, 0}, {0, -1, 0}}, {1, 1});
    scene.colliders = {{Plane{{0, 1, 0}, 0.5}}};
    scene.cloths[0].pins = {{.particles = {{0, 0}, {0, 8}}}};  // left edge: a pole from the floor, a knob on top
    std::vector<Fixture> found = fixtures(scene);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].from[1], 0.5, 1e-12);
    EXPECT_GT(found[0].to[1], 2);
    EXPECT_EQ(found[1].from, found[0].to);
    scene.cloths[0].pins = {row_of(scene.cloths[0])};  // top edge: a rail and two knobs
    found = fixtures(scene);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_LT(found[0].from[0], -0.5);
    EXPECT_GT(found[0].to[0], 0.5);
    EXPECT_EQ(found[0].from[1], 2);
    scene.cloths[0].pins = {{.particles = {{8, 0}, {8, 0}}}};  // a corner: a pole of its own
    found = fixtures(scene);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].from[1], 0.5, 1e-12);
    EXPECT_EQ(found[0].to, (Vec3{0.5, 2, 0}));
    // Fixtures stand where the cloth starts, not where it would lie unstretched.
    scene.cloths[0].placement.scale = {0.5, 1};
    EXPECT_EQ(fixtures(scene)[0].to, (Vec3{0, 2, 0}));
    scene.cloths[0].placement.scale = {1, 1};
    // Hooks in a line share a rail over all the way that they travel; each has a knob that moves with it.
    scene.cloths[0].pins.clear();
    for (const std::uint32_t column : {0u, 4u, 8u})
        scene.cloths[0].pins.push_back({.particles = {{column, 0}, {column, 0}}});
    scene.cloths[0].pins[2].path.keys = {{0, {0, 0, 0}, {}}, {1, {-0.25, 0, 0}, {}}};
    found = fixtures(scene);
    ASSERT_EQ(found.size(), 6u);
    const Collider hook = posed(found.back(), 1);
    EXPECT_NEAR(std::get<Sphere>(hook.shape).center[0], 0.25, 1e-12);
    scene.image.fixtures = false;
    EXPECT_TRUE(fixtures(scene).empty());
}

TEST(Fixtures, ARowThatAGivenShapeBendsHangsOnNoBar) {
    SceneDescription scene;
    scene.cloths.resize(1);
    Cloth& cloth = scene.cloths[0];
    cloth.grid = {9, 9};
    cloth.pins = {{.particles = {{0, 0}, {8, 0}}}};
    const auto shape = [&](double bend) {
        cloth.start.clear();
        for (int row = 0; row < 9; ++row)
            for (int column = 0; column < 9; ++column)
                cloth.start.push_back({0.125 * column, 2 - 0.125 * row, bend * std::sin(0.3927 * column)});
    };
    shape(0);
    EXPECT_EQ(fixtures(scene).size(), 3u) << "a rail with two ends";
    shape(0.2);
    EXPECT_TRUE(fixtures(scene).empty());
}

TEST(Framing, HoldsAGivenShape) {
    SceneDescription scene;
    scene.cloths.resize(1);
    Cloth& cloth = scene.cloths[0];
    cloth.grid = {33, 33};
    for (int row = 0; row < 33; ++row)
        for (int column = 0; column < 33; ++column)  // a tube, whose corners are near each other
            cloth.start.push_back({7 + 3 * std::cos(0.19 * column), 0.2 * row, 3 * std::sin(0.19 * column)});
    const Camera camera = picture_camera(scene, width, height);
    for (const Vec3& at : cloth.start) {
        const PixelPosition seen = project(camera, width, height, at);
        EXPECT_TRUE(seen.x >= 0 && seen.x < width && seen.y >= 0 && seen.y < height) << seen.x << " " << seen.y;
    }
    for (const Vec3& at : cloth.start) {
        const Vec3 away = at + -1 * scene_extent(scene).center;
        EXPECT_LE(std::hypot(away[0], away[1], away[2]), scene_extent(scene).radius);
    }
}

TEST(RoundMesh, HasNoMoreSegmentsThanItsOutlineShows) {
    const auto cuts = [](double radius, std::uint32_t columns) {
        return radius * (1 - std::cos(std::numbers::pi / columns));
    };
    for (double radius = 0.01; radius < 1e4; radius *= 1.3) {
        const std::uint32_t columns = round_columns(radius);
        ASSERT_TRUE(columns % 4 == 0 && columns >= 12 && columns <= 96) << columns;
        EXPECT_TRUE(columns == 96 || cuts(radius, columns) <= 0.1 + 1e-9) << radius;
        EXPECT_TRUE(columns == 12 || cuts(radius, columns - 4) > 0.1) << radius;
    }
    EXPECT_EQ(round_columns(std::numeric_limits<double>::infinity()), 96u);
}

TEST(RoundMesh, RadiusInPixelsBoundsWhatThePictureShows) {
    const Camera camera{{0, 0, 5}, {0, 0, 0}, 40};
    const auto seen = [&](double radius, double z) {
        return 0.5 * height - project(camera, width, height, {0, radius, z}).y;
    };
    Collider ball{.shape = Sphere{{0, 0, 0}, 0.4}};
    EXPECT_GE(radius_in_pixels(ball, 0, camera, height), seen(0.4, 0));
    EXPECT_LE(radius_in_pixels(ball, 0, camera, height), 1.2 * seen(0.4, 0));
    ball.path.keys = {{0, {0, 0, 0}, {}}, {1, {0, 0, 4}, {}}};
    EXPECT_GE(radius_in_pixels(ball, 1, camera, height), seen(0.4, 4));
    ball.path.keys[1].translate = {0, 0, 4.7};  // the eye is inside
    EXPECT_EQ(radius_in_pixels(ball, 1, camera, height), std::numeric_limits<double>::infinity());
    EXPECT_EQ(radius_in_pixels({.shape = Box{{0, 0, 0}, {1, 1, 1}}}, 0, camera, height), 0);
}

using FixturePicture = Raster;

TEST_F(FixturePicture, RailIsDrawnWhereThePinsAreUnlessSwitchedOff) {
    SceneDescription scene = dark_room();
    const DrawnCloth cloth = square({0, 0, 0}, 1, red, red);
    scene.cloths.resize(1);
    scene.cloths[0].pins = {{.particles = {{0, 0}, {1, 0}}}};
    // The first row is the lower one of the square in this room.
    const PixelPosition beside = project(*scene.camera, width, height, {0.53, -0.5, 0});
    EXPECT_GT(draw(scene, {cloth}).at(beside)[1], 20);
    scene.image.fixtures = false;
    EXPECT_EQ(draw(scene, {cloth}).at(beside)[1], 0);
}

}  // namespace
}  // namespace drape
