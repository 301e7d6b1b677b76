// The shade that things cast on the floor from all around, against closed forms of configuration factors (Howell's
// catalog: B-4 of a rectangle, B-15 of a sphere, from a differential element parallel to it).
#include "picture/ground_shade.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <numbers>

#include "raster_picture.h"

namespace drape {
namespace {

constexpr double albedo = 0.35, sent_back = 0.25;  // the second as shaders/ground_shade.comp has it

/// A floor under a sky alone.
SceneDescription open_floor() {
    SceneDescription scene = floor_scene();
    scene.camera = Camera{{0, 4, 5}, {0, 0, 0}, 50};
    scene.lights.clear();
    scene.ambient = white;
    scene.ambient_ground = black;
    const double shown = 1.055 * std::pow(albedo, 1 / 2.4) - 0.055;
    scene.colliders[0].color = {shown, shown, shown};
    return scene;
}

class GroundShadeTest : public Raster {
  protected:
    /// Returns the share of the sky that a place on the floor does not see, by the picture.
    static double hidden(const SceneDescription& scene, const Picture& picture, double x, double z) {
        const double radiance = linear(picture.at(pixel(scene, {x, 0, z}))[1] / 255.0);
        return (1 - radiance / albedo) / (1 - sent_back);
    }
    const Shot shot_{.options = {.shadow = false, .ground_shade = true}};
};

/// Returns what a square of this half side above the middle hides of a place: the sum of four rectangles with a corner
/// above the place, those beyond it negative.
double hidden_by_square(double half, double height, double x, double z) {
    const auto corner = [height](double a, double b) {
        const double sign = a * b < 0 ? -1 : 1, p = std::abs(a) / height, q = std::abs(b) / height;
        return sign / (2 * std::numbers::pi) *
               (p / std::hypot(1, p) * std::atan(q / std::hypot(1, p)) +
                q / std::hypot(1, q) * std::atan(p / std::hypot(1, q)));
    };
    return corner(half - x, half - z) + corner(half + x, half - z) + corner(half - x, half + z) +
           corner(half + x, half + z);
}

TEST_F(GroundShadeTest, ASquareHidesItsShareOfTheSky) {
    for (const double height : {0.3, 0.6}) {
        const SceneDescription scene = open_floor();
        const DrawnCloth cloth = flat_cloth({0, height, 0}, {0.8, 0, 0}, {0, 0, -0.8}, {0, 1, 0}, red, blue, 17);
        const Picture picture = draw(scene, {cloth}, shot_);
        double worst = 0;
        for (const double x : {-0.9, -0.61, 0.11, 0.43, 0.61, 0.9})
            for (const double z : {0.61, 0.83}) {  // beneath the square the cloth itself is in the picture
                const double expected = hidden_by_square(0.4, height, x, z);
                const double seen = hidden(scene, picture, x, z);
                worst = std::max(worst, std::abs(seen - expected));
                EXPECT_NEAR(seen, expected, 0.05) << height << ": " << x << ", " << z;
            }
        std::printf("[ measured ] a square at %.1f m: off by %.3f of the sky\n", height, worst);
    }
}

TEST_F(GroundShadeTest, ASphereHidesItsShareOfTheSky) {
    const double radius = 0.3;
    for (const double lifted : {0.0, 0.2}) {
        SceneDescription scene = open_floor();
        const double height = radius + lifted;
        scene.colliders.push_back(painted(Sphere{{0, height, 0}, radius}, red));
        const Picture picture = draw(scene, {}, shot_);
        double worst = 0;
        for (const double x : {-0.5, -0.43, 0.37, 0.55})
            for (const double z : {0.17, 0.33}) {
                const double distance = std::sqrt(x * x + z * z + height * height);
                const double expected = radius * radius * height / std::pow(distance, 3);
                const double seen = hidden(scene, picture, x, z);
                worst = std::max(worst, std::abs(seen - expected));
                EXPECT_NEAR(seen, expected, 0.05) << lifted << ": " << x << ", " << z;
            }
        std::printf("[ measured ] a sphere %.1f m above the floor: off by %.3f of the sky\n", lifted, worst);
    }
}

/// At the foot of a wall half of the sky is left.
TEST_F(GroundShadeTest, AWallHidesHalfOfTheSky) {
    SceneDescription scene = open_floor();
    scene.colliders.push_back(painted(Box{{0, 0.5, -0.5}, {1.5, 0.5, 0.1}}, red));
    const Picture picture = draw(scene, {}, shot_);
    const double at_foot = hidden(scene, picture, 0.11, -0.27), farther = hidden(scene, picture, 0.11, 0.63);
    EXPECT_NEAR(at_foot, 0.5, 0.12);
    EXPECT_LT(farther, at_foot - 0.2);
    EXPECT_NEAR(hidden(scene, picture, 0.11, 2.9), 0, 0.02) << "beyond the map";
}

/// The floor may be tilted and z may be up: the shade depends on what is above the floor alone.
TEST_F(GroundShadeTest, GoesWithTheFloor) {
    SceneDescription scene = open_floor();
    scene.colliders.push_back(painted(Sphere{{0, 0.4, 0}, 0.3}, red));
    const GroundMap map = ground_map(scene.colliders[0], {{0, 0.4, 0}, 1});
    Collider tilted = scene.colliders[0];
    tilted.shape = Plane{unit({0.3, 1, -0.2}), 0.7};
    const GroundMap other = ground_map(tilted, {0.7 * unit({0.3, 1, -0.2}) + 0.4 * unit({0.3, 1, -0.2}), 1});
    const Vec3 above = 0.7 * unit({0.3, 1, -0.2}) + 0.25 * unit({0.3, 1, -0.2});
    EXPECT_NEAR(other.place(above)[2] * other.column_side, 0.25, 1e-12);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(other.place(above)[k], map.place({0, 0.25, 0})[k], 1e-9);
}

/// Bodies that move, deform or have a mass are entered where they are; planes are in no column.
TEST_F(GroundShadeTest, BodiesAreWhereTheyAre) {
    Pipelines pipelines(test::gpu().device);
    const GroundMap map = ground_map({Plane{}}, {{0, 0, 0}, 1});
    Collider ball{Sphere{{0, 0.5, 0}, 0.2}};
    ball.path.keys = {{0, {}, {}}, {1, {0.5, 0.1, 0}, {}}};
    const std::vector<Collider> bodies{ball, {Plane{{1, 0, 0}, -3}}};
    const GroundShade shade(pipelines, map, bodies, false);
    const auto heights = [&](double x, double z, double time) {
        const Vec3 place = map.place({x, 0, z});
        const std::vector<glsl::uint> columns = shade.columns(bodies, time);
        const auto column = static_cast<std::size_t>(glsl::ground_side * static_cast<int>(place[1]) + int(place[0]));
        return std::array{std::bit_cast<float>(columns[2 * column]) * map.column_side,
                          std::bit_cast<float>(columns[2 * column + 1]) * map.column_side};
    };
    EXPECT_THAT(heights(0.01, 0.01, 0),
                testing::ElementsAre(testing::DoubleNear(0.3, 0.01), testing::DoubleNear(0.7, 0.01)));
    EXPECT_THAT(heights(0.51, 0.01, 1),
                testing::ElementsAre(testing::DoubleNear(0.4, 0.01), testing::DoubleNear(0.8, 0.01)));
    EXPECT_EQ(heights(0.01, 0.01, 1)[1], 0) << "nothing is left there";
}

TEST_F(GroundShadeTest, SaysWhyThereIsNone) {
    std::vector<graph::Remark> skipped;
    const auto reason = [&]() -> std::string {
        for (const graph::Remark& entry : skipped)
            if (entry.what == "ground shade") return entry.reason;
        return "drawn";
    };
    Shot shot = shot_;
    shot.skipped = &skipped;
    SceneDescription scene = open_floor();
    draw(scene, {}, shot);
    EXPECT_EQ(reason(), "nothing stands above the floor");
    scene.colliders.push_back(painted(Sphere{{0, 0.4, 0}, 0.3}, red));
    draw(scene, {}, shot);
    EXPECT_EQ(reason(), "drawn");
    shot.options.ground_shade = false;
    draw(scene, {}, shot);
    EXPECT_EQ(reason(), "switched off");
    shot.options.ground_shade = true;
    scene.image.alpha = true;
    draw(scene, {}, shot);
    EXPECT_EQ(reason(), "no floor is drawn");
}

}  // namespace
}  // namespace drape
