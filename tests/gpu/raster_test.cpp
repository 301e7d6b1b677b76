// The raster pass draws the right shapes at the right places, depths and colours, checked against closed forms.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "picture/camera.h"
#include "raster_picture.h"
#include "support/every_kind.h"
#include "support/meshes.h"
#include "world/collider_pose.h"

namespace drape {
namespace {

/// Returns which of red, green and blue a pixel has at all.
std::array<bool, 3> channels(const std::array<int, 3>& pixel_color) {
    return {pixel_color[0] > 0, pixel_color[1] > 0, pixel_color[2] > 0};
}
std::array<bool, 3> channels(const Vec3& color) { return {color[0] > 0, color[1] > 0, color[2] > 0}; }

TEST(CameraTest, ProjectsByTheDefinitionOfTheFieldOfView) {
    const Camera camera{{1, 2, 10}, {1, 2, 0}, 60};
    const PixelPosition middle = project(camera, 640, 480, camera.target);
    EXPECT_NEAR(middle.x, 320, 1e-9);
    EXPECT_NEAR(middle.y, 240, 1e-9);
    const double half = 10 * std::tan(30 * std::numbers::pi / 180);
    EXPECT_NEAR(project(camera, 640, 480, {1, 2 + half, 0}).y, 0, 1e-9);
    EXPECT_NEAR(project(camera, 640, 480, {1 + half * 640 / 480, 2, 0}).x, 640, 1e-9);
    EXPECT_NEAR(project(camera, 640, 480, {1, 2, 10 - 0.1}).depth, 0, 1e-9);  // near plane
    EXPECT_NEAR(project(camera, 640, 480, {1, 2, 10 - 1e4}).depth, 1, 1e-9);  // far plane
    EXPECT_LT(middle.depth, project(camera, 640, 480, {1, 2, -1}).depth);
    EXPECT_TRUE(std::isinf(project(camera, 640, 480, {1, 2, 11}).depth));
}

TEST(CameraTest, LooksStraightDown) {
    const Camera camera{{0, 5, 0}, {0, 0, 0}, 40};
    EXPECT_GT(project(camera, 100, 100, {1, 0, 0}).x, 51);
    EXPECT_LT(project(camera, 100, 100, {0, 0, -1}).y, 49);
}

TEST(ColliderPoseTest, PathTurnsTheRestPoseAboutTheCentre) {
    Collider plane{Plane{{0, 1, 0}, 2}};
    plane.rotate = {0, 0, 90};                                    // y -> -x
    plane.path.keys = {{0, {}, {}}, {1, {0, 0, 5}, {0, 90, 0}}};  // then -x -> z
    const ColliderPose rest = collider_pose(plane, 0), moved = collider_pose(plane, 1);
    EXPECT_EQ(rest.center, (Vec3{0, 2, 0}));
    EXPECT_EQ(moved.center, (Vec3{0, 2, 5}));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(rotate(rest.rotation, {0, 1, 0})[k], (Vec3{-1, 0, 0}[k]), 1e-15);
        EXPECT_NEAR(rotate(moved.rotation, {0, 1, 0})[k], (Vec3{0, 0, 1}[k]), 1e-15);
    }
}

TEST_F(Raster, ParticlesLandWhereProjectSays) {
    SceneDescription scene = dark_room();
    scene.camera = Camera{{1.2, 1.0, 2.6}, {0.1, 0.2, -0.1}, 50};
    const std::array<Vec3, 6> colors{red, green, blue, Vec3{1, 1, 0}, Vec3{0, 1, 1}, Vec3{1, 0, 1}};
    const std::array<Vec3, 6> places{Vec3{0, 0, 0},     {0.7, 0.4, 0.3}, {-0.6, 0.5, -0.4},
                                     {-0.3, -0.5, 0.8}, {0.4, -0.6, 0},  {0.2, 0.9, -1.5}};
    std::vector<DrawnCloth> cloths;
    for (std::size_t i = 0; i < colors.size(); ++i)
        cloths.push_back(flat_cloth(places[i], {0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 1}, colors[i], colors[i]));
    for (const std::uint32_t samples : {1u, 4u}) {
        const Picture picture = draw(scene, cloths, {.samples = samples});
        for (std::size_t i = 0; i < colors.size(); ++i) {
            double x = 0, y = 0, count = 0;
            for (std::uint32_t row = 0; row < height; ++row) {
                for (std::uint32_t column = 0; column < width; ++column) {
                    if (channels(picture.at(column, row)) != channels(colors[i])) continue;
                    x += column + 0.5;
                    y += row + 0.5;
                    ++count;
                }
            }
            const PixelPosition expected = pixel(scene, places[i]);
            ASSERT_GT(count, 5) << "cloth " << i;
            EXPECT_NEAR(x / count, expected.x, 0.5) << "cloth " << i << ", samples " << samples;
            EXPECT_NEAR(y / count, expected.y, 0.5) << "cloth " << i << ", samples " << samples;
        }
    }
}

TEST_F(Raster, FrontIsWhereTheNormalPoints) {
    SceneDescription scene = dark_room();
    const DrawnCloth facing = flat_cloth({-0.5, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 1}, red, blue);
    const DrawnCloth turned = flat_cloth({0.5, 0, 0}, {0.4, 0, 0}, {0, -0.4, 0}, {0, 0, -1}, red, blue);
    const Picture picture = draw(scene, {facing, turned});
    EXPECT_EQ(channels(picture.at(pixel(scene, {-0.5, 0, 0}))), channels(red));
    EXPECT_EQ(channels(picture.at(pixel(scene, {0.5, 0, 0}))), channels(blue));
    scene.camera->position = {0, 0, -3};
    const Picture behind = draw(scene, {facing, turned});
    EXPECT_EQ(channels(behind.at(pixel(scene, {-0.5, 0, 0}))), channels(blue));
    EXPECT_EQ(channels(behind.at(pixel(scene, {0.5, 0, 0}))), channels(red));
}

class RasterDepth : public Raster, public testing::WithParamInterface<ColliderShape> {};

TEST_P(RasterDepth, ClothHidesAndIsHidden) {
    SceneDescription scene = dark_room();
    scene.colliders = {painted(GetParam(), green)};
    const std::vector<DrawnCloth> cloths{square({-0.1, 0, 0.55}, 0.1, red, red),
                                         square({0.1, 0, -0.55}, 0.1, red, red)};
    for (const std::uint32_t samples : {1u, 4u}) {
        const Picture picture = draw(scene, cloths, {.samples = samples});
        EXPECT_EQ(channels(picture.at(pixel(scene, {-0.1, 0, 0.55}))), channels(red));
        EXPECT_EQ(channels(picture.at(pixel(scene, {0.1, 0, -0.55}))), channels(green));
    }
    scene.colliders = {};
    EXPECT_EQ(channels(draw(scene, cloths).at(pixel(scene, {0.1, 0, -0.55}))), channels(red));
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, RasterDepth,
    testing::ValuesIn(test::of_every_kind(Plane{{0, 0, 1}, 0.25}, Sphere{{0, 0, 0}, 0.5},
                                          Box{{0, 0, 0}, {0.4, 0.4, 0.5}}, Ellipsoid{{0, 0, 0}, {0.4, 0.3, 0.5}},
                                          Capsule{{-0.4, 0, 0}, {0.4, 0.1, 0}, {0.5, 0.4}},
                                          test::mesh_of(test::ball_mesh(0.5, 32), {0, 0, 0}),
                                          test::mesh_of(test::box_mesh({0.4, 0.4, 0.5}), {0, 0, 0}, 0.01))),
    [](const auto& test) {
        const auto* mesh = std::get_if<Mesh>(&test.param);
        return std::string(collider_lists[test.param.index()]) + (mesh && mesh->shell ? "_with_a_shell" : "");
    });

TEST_F(Raster, CollidersHaveTheirTrueSizeAndPose) {
    SceneDescription scene = dark_room();
    // Half way along its path the sphere is at (0.7, 0.3, 0).
    Collider sphere = painted(Sphere{{0.3, 0, 0}, 0.3}, green);
    sphere.path.keys = {{0, {0, 0.3, 0}, {}}, {1, {0.8, 0.3, 0}, {}}};
    scene.colliders.push_back(sphere);
    // Turned by 90 degrees about z, the half extents 0.5, 0.2 become 0.2, 0.5.
    Collider box = painted(Box{{-0.6, 0, 0}, {0.5, 0.2, 0.01}}, blue);
    box.rotate = {0, 0, 90};
    scene.colliders.push_back(box);
    scene.camera->fov = 60;
    const Picture picture = draw(scene, {}, {.time = 0.5});
    const auto has = [&](const Vec3& point) { return channels(picture.at(pixel(scene, point))); };
    // The silhouette of a sphere is the cone from the eye; its rim lies nearer than the centre.
    const Vec3 center{0.7, 0.3, 0};
    const Vec3 from_eye = center + -1.0 * scene.camera->position;
    const double squared = dot(from_eye, from_eye), cone = 0.3 * std::sqrt(1 - 0.09 / squared);
    const Vec3 rim_center = center + (-0.09 / squared) * from_eye;
    const Vec3 up = unit(Vec3{0, 1, 0} + (-from_eye[1] / squared) * from_eye);
    const double pixel_size = 0.02;
    for (const double side : {-1.0, 1.0}) {
        EXPECT_EQ(has(rim_center + (side * (cone - pixel_size)) * up), channels(green)) << side;
        EXPECT_EQ(has(rim_center + (side * (cone + pixel_size)) * up), channels(black)) << side;
        EXPECT_EQ(has({-0.6 + side * 0.18, 0, 0.01}), channels(blue)) << side;
        EXPECT_EQ(has({-0.6 + side * 0.22, 0, 0.01}), channels(black)) << side;
        EXPECT_EQ(has({-0.6, side * 0.48, 0.01}), channels(blue)) << side;
        EXPECT_EQ(has({-0.6, side * 0.52, 0.01}), channels(black)) << side;
    }
}

/// A ball swells from 0.2 to 0.6 m within a second.
TEST_F(Raster, MeshesAreDrawnInTheirForm) {
    SceneDescription scene = dark_room();
    scene.colliders.push_back(
        painted(test::deforming_mesh(test::ball_mesh(0.2, 48), {0, 0, 0}, 3, 2,
                                     [](const Vec3& at, std::size_t k) { return (1.0 + double(k)) * at; }),
                green));
    for (const auto& [time, radius] : {std::pair{0.0, 0.2}, {0.25, 0.3}, {1.0, 0.6}}) {
        const Picture picture = draw(scene, {}, {.time = time});
        const auto at = [&](double x) { return channels(picture.at(pixel(scene, {x, 0, 0}))); };
        EXPECT_EQ(at(0.93 * radius), channels(green)) << time;
        EXPECT_EQ(at(1.12 * radius), channels(black)) << time;
    }
}

TEST_F(Raster, ClothIsShadedByTheFormula) {
    SceneDescription scene = dark_room();
    scene.ambient = {0.2, 0.25, 0.3};
    scene.ambient_ground = {0.3, 0.1, 0.15};
    const Vec3 front{0.8, 0.3, 0.2}, back{0.3, 0.5, 0.7};
    const DirectionalLight key{{-0.4, -0.5, -1}, {1, 0.9, 0.8}, 0.6}, behind{{0.2, -0.3, 1}, {0.7, 0.8, 1}, 0.5};
    for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0.5, 0.3, 0.6}, Vec3{0.1, -0.9, 0.2}}) {
        const Vec3 normal = unit(direction);
        const DrawnCloth facing = flat_cloth({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, normal, front, back);
        const DrawnCloth turned = flat_cloth({0, 0, 0}, {1, 0, 0}, {0, -1, 0}, -1.0 * normal, front, back);
        for (const auto& lights : {std::vector{key}, std::vector{behind}, std::vector{key, behind}}) {
            scene.lights = lights;
            for (const std::uint32_t samples : {1u, 4u}) {
                // The middle of the picture is a corner of four pixels.
                const double half_pixel = 3 * std::tan(20 * std::numbers::pi / 180) / height;
                const Vec3 to_eye = unit({-half_pixel, half_pixel, 3});
                const std::string what = fmt::format("{} lights, {} samples", lights.size(), samples);
                const Shading front_shading{linear(front), normal, to_eye, scene.ambient, scene.ambient_ground};
                expect_color(draw(scene, {facing}, {.samples = samples}).at(160, 119),
                             front_shading.pixel_color(lights), "front, " + what);
                const Shading back_shading{linear(back), normal, to_eye, scene.ambient, scene.ambient_ground};
                expect_color(draw(scene, {turned}, {.samples = samples}).at(160, 119), back_shading.pixel_color(lights),
                             "back, " + what);
            }
        }
    }
}

TEST_F(Raster, CollidersAreShadedByTheFormula) {
    SceneDescription scene = dark_room();
    scene.ambient = scene.ambient_ground = {0.2, 0.2, 0.2};
    scene.lights = {{{-0.1, -0.2, -1}, {1, 0.9, 0.8}, 0.6}};
    const Vec3 color{0.6, 0.5, 0.3};
    scene.colliders.push_back(painted(Box{{0, 0, -0.5}, {0.5, 0.5, 0.5}}, color));
    Shading shading{linear(color), {0, 0, 1}, {0, 0, 1}, scene.ambient, scene.ambient_ground, 0, 0.5, 0};
    expect_color(draw(scene, {}).at(160, 119), shading.pixel_color(scene.lights), "face of a box");
    scene.colliders = {};
    scene.colliders.push_back(painted(Sphere{{0, 0, -0.5}, 0.5}, color));
    // The middle of the picture is a corner of four pixels; this one shows what is half a pixel to the right and above.
    const double half_pixel = 3 * std::tan(20 * std::numbers::pi / 180) / height;
    shading.normal = unit({half_pixel, half_pixel, 0.5});
    shading.to_eye = unit({-half_pixel, -half_pixel, 3});
    expect_color(draw(scene, {}).at(160, 119), shading.pixel_color(scene.lights), "middle of a sphere");
}

TEST_F(Raster, WithoutANormalTheTriangleGivesIt) {
    SceneDescription scene = dark_room();
    scene.ambient = scene.ambient_ground = {0.2, 0.2, 0.2};
    scene.lights = {{{-0.3, -0.2, -1}, white, 0.6}};
    const Vec3 edge = unit({1, 0, -0.5}), normal = unit({0.5, 0, 1});
    const DrawnCloth given = flat_cloth({0, 0, 0}, edge, {0, 1, 0}, normal, red, blue);
    const DrawnCloth missing = flat_cloth({0, 0, 0}, edge, {0, 1, 0}, {0, 0, 0}, red, blue);
    const Picture expected = draw(scene, {given}), seen = draw(scene, {missing});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(seen.at(160, 120)[k], expected.at(160, 120)[k], 1);
}

/// Checks which of a cloth's colours squares of a tenth of a metre have, in columns of eight.
class RasterPattern : public Raster {
  protected:
    void expect_second(Pattern pattern, bool (*second)(int column, int row)) {
        SceneDescription scene = dark_room();
        for (const bool front : {true, false}) {
            DrawnCloth cloth = flat_cloth({0, 0, 0}, {1.6, 0, 0}, {0, 0.8, 0}, {0, 0, 1}, red, blue, 5);
            cloth.appearance.pattern = pattern;
            cloth.appearance.second = {0.2, 0.9, 0.4};
            if (!front) scene.camera->position = {0, 0, -3};
            const Picture picture = draw(scene, {cloth});
            for (int row = 0; row < 8; ++row)
                for (int column = 0; column < 16; ++column) {
                    const Vec3 color = second(column, row) ? cloth.appearance.second : front ? red : blue;
                    const Vec3 at{-0.75 + 0.1 * column, -0.35 + 0.1 * row, 0};
                    const Vec3 to_eye = unit(scene.camera->position + -1.0 * at);
                    const Shading shading{linear(color), {0, 0, front ? 1.0 : -1.0}, to_eye, white, white};
                    expect_color(picture.at(pixel(scene, at)), shading.pixel_color({}),
                                 fmt::format("{}, {}, {}", column, row, front ? "front" : "back"));
                }
        }
    }
};

TEST_F(RasterPattern, PlainHasOneColour) {
    expect_second(Pattern::plain, [](int, int) { return false; });
}
TEST_F(RasterPattern, CheckerSquaresAreMeasuredOnTheMaterial) {
    expect_second(Pattern::checker, [](int column, int row) { return (column + row) % 2 == 1; });
}
TEST_F(RasterPattern, StripesRunAlongColumns) {
    expect_second(Pattern::stripes, [](int column, int) { return column % 2 == 1; });
}

TEST_F(Raster, FoldsDarkenTheirInside) {
    SceneDescription scene = dark_room();
    // A valley runs along the picture's height, its flanks at 45 degrees: towards its middle row and column the four
    // horizons are at 45, 45, 0 and 0 degrees, so that (sin 45 + sin 45) / 4 of the surroundings are hidden.
    DrawnCloth valley = flat_cloth({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, 3);
    for (glsl::vec4& x : valley.positions) x.z = std::abs(x.x);
    const Shading open{linear({0.5, 0.5, 0.5}), {0, 0, 1}, {0, 0, 1}, white, white};
    Shading hidden = open;
    hidden.sky = hidden.ground = (1 - std::sqrt(0.5) / 2) * white;
    expect_color(draw(scene, {valley}).at(160, 120), hidden.pixel_color({}), "inside");
    scene.camera->position = {0, 0, -3};
    expect_color(draw(scene, {valley}).at(160, 120), open.pixel_color({}), "outside");
}

TEST_F(Raster, ClothIsDrawnBeforeWhatItCutsByLessThanItsThickness) {
    SceneDescription scene = dark_room();
    scene.colliders = {painted(Box{{0, 0, 0}, {0.5, 0.5, 0.5}}, green)};
    DrawnCloth cloth = square({0, 0, 0.49}, 0.4, red, red);
    for (const double thickness : {0.0, 0.009, 0.011}) {
        cloth.thickness = thickness;
        EXPECT_EQ(channels(draw(scene, {cloth}).at(160, 120)), channels(thickness > 0.01 ? red : green)) << thickness;
    }
}

TEST_F(Raster, FourSamplesSmoothEdges) {
    const SceneDescription scene = dark_room();
    const DrawnCloth tilted = flat_cloth({0, 0, 0}, {1, 0.3, 0}, {-0.3, 1, 0}, {0, 1, 0}, white, white);
    const double white_level = srgb_byte(1);
    for (const std::uint32_t samples : {1u, 4u}) {
        const Picture picture = draw(scene, {tilted}, {.samples = samples});
        int between = 0, full = 0;
        for (std::uint32_t row = 0; row < height; ++row) {
            for (std::uint32_t column = 0; column < width; ++column) {
                const int value = picture.at(column, row)[0];
                full += value > white_level - 3;
                between += value > 20 && value < white_level - 15;
            }
        }
        EXPECT_GT(full, 1000);
        EXPECT_TRUE(samples == 1 ? between == 0 : between > 50) << between;
    }
}

TEST_F(Raster, MissingCellsAreNotDrawn) {
    const SceneDescription scene = dark_room();
    DrawnCloth cloth = flat_cloth({0, 0, 0}, {0.9, 0, 0}, {0, 0.9, 0}, {0, 0, 1}, red, red, 4);
    EXPECT_EQ(channels(draw(scene, {cloth}).at(160, 120)), channels(red));
    cloth.indices.erase(cloth.indices.begin() + 4 * 6,
                        cloth.indices.begin() + 5 * 6);  // the middle one of nine
    const Picture picture = draw(scene, {cloth});
    EXPECT_EQ(channels(picture.at(160, 120)), channels(black));
    for (const Vec3& kept : {Vec3{0.3, 0, 0}, Vec3{-0.3, 0, 0}, Vec3{0, 0.3, 0}, Vec3{0.3, -0.3, 0}})
        EXPECT_EQ(channels(picture.at(pixel(scene, kept))), channels(red));
}

TEST_F(Raster, FirstLightCastsShadows) {
    SceneDescription scene = floor_scene();
    const DrawnCloth cloth = flat_cloth({0, 1, 0}, {0.6, 0, 0}, {0, 0, -0.6}, {0, 1, 0}, red, blue);
    const Vec3 floor_color = linear(Vec3{0.6, 0.6, 0.6});
    const Shading shading{floor_color, {0, 1, 0}, {0, 1, 0}, scene.ambient, scene.ambient_ground, 0, 1, 0};
    const Vec3 lit = shading.pixel_color(scene.lights), dark = shading.pixel_color({});
    for (const std::uint32_t samples : {1u, 4u}) {
        const Picture picture =
            draw(scene, {cloth}, {.samples = samples, .options = {.shadow = true, .ground_shade = false}});
        for (const double x : {-0.25, -0.07, 0.13, 0.25}) {
            expect_color(picture.at(pixel(scene, {x, 0, 0.13})), dark, "under the cloth");
            expect_color(picture.at(pixel(scene, {x, 0, 0.37})), lit, "before the cloth");
        }
        const Picture plain = draw(scene, {cloth}, {.samples = samples});
        expect_color(plain.at(pixel(scene, {0.13, 0, 0.13})), lit, "without shadows");
        // The cloth itself is lit from above: a surface must not shade itself.
        EXPECT_EQ(picture.at(pixel(scene, {0.1, 1, 0.1})), plain.at(pixel(scene, {0.1, 1, 0.1})));
    }
}

TEST_F(Raster, CollidersCastShadowsWithoutACloth) {
    SceneDescription scene = floor_scene();
    scene.colliders.push_back(painted(Sphere{{0, 1, 0}, 0.3}, red));
    const Picture picture = draw(scene, {}, {.options = {.shadow = true}});
    EXPECT_LT(picture.at(pixel(scene, {0.07, 0, 0.07}))[0] + 30, picture.at(pixel(scene, {0.43, 0, 0.07}))[0]);
    // The lit half of the sphere has no specks of its own shadow.
    const Picture plain = draw(scene, {});
    for (int step = -5; step <= 5; ++step) {
        const double angle = 0.2 * step;
        const PixelPosition at = pixel(scene, {0.3 * std::sin(angle), 1 + 0.3 * std::cos(angle), 0});
        EXPECT_EQ(picture.at(at.x, at.y + 4), plain.at(at.x, at.y + 4)) << angle;
    }
}

/// PSNR of a picture against encoded values 0..255, three per pixel, dB.
double psnr(const Picture& picture, const std::vector<double>& expected) {
    double squares = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        squares += std::pow(picture.bytes[4 * (i / 3) + i % 3] - expected[i], 2);
    return 10 * std::log10(255 * 255 * static_cast<double>(expected.size()) / squares);
}

TEST_F(Raster, TheFloorIsThePlaneAsTriangles) {
    SceneDescription scene = floor_scene();
    scene.camera = Camera{{0.7, 1.1, 3}, {0, 0.2, 0}, 50};
    scene.image.background = {0.5, 0.6, 0.7};
    scene.lights = {{{-0.5, -1, -0.2}, white, 0.6}, {{1, -0.3, 0}, red, 0.3}};
    scene.ambient_ground = {0.1, 0.05, 0.2};
    scene.colliders[0].rotate = {4, 30, -7};
    for (const Collider& body :
         {painted(Sphere{{-0.3, 0.1, 0.2}, 0.4}, {0.4, 0.5, 0.6}),  // partly under the floor
          painted(Box{{0.8, 0, -0.4}, {0.2, 0.5, 0.3}}, green), painted(Plane{{0, 0, 1}, -2}, blue)})
        scene.colliders.push_back(body);
    const DrawnCloth cloth = flat_cloth({0.3, 0.2, 0.5}, {0.9, 0.1, 0}, {0, -0.7, -0.3}, {0, 0, 1}, red, blue);
    SceneDescription moving = scene;  // moves to where it is: only a plane without a path is a floor
    moving.colliders[0].path.keys = {{0, {}, {}}, {1, {}, {}}};
    for (const bool shadow : {false, true}) {
        const Shot shot{.samples = 4, .options = {.shadow = shadow, .ground_shade = false, .shift = {0.3, -0.2}}};
        const Picture floor = draw(scene, {cloth}, shot), triangles = draw(moving, {cloth}, shot);
        std::vector<double> expected;
        int unequal = 0;
        for (std::size_t i = 0; i < std::size_t{3} * width * height; ++i) {
            expected.push_back(triangles.bytes[4 * (i / 3) + i % 3]);
            unequal += std::abs(floor.bytes[4 * (i / 3) + i % 3] - expected.back()) > 1;
        }
        std::printf("[ measured ] floor against triangles: PSNR %.1f dB, %d values differ by more than 1\n",
                    psnr(floor, expected), unequal);
        EXPECT_GT(psnr(floor, expected), 50);
        EXPECT_LT(unequal, width * height * 3 / 1000);
        EXPECT_NE(floor.bytes, draw(scene, {}, shot).bytes);
    }
}

TEST_F(Raster, FourSamplesComeCloseToSixtyFour) {
    SceneDescription scene = floor_scene();
    scene.colliders.push_back(painted(Sphere{{0.2, 0.3, 0}, 0.3}, {0.4, 0.5, 0.6}));
    DrawnCloth cloth = flat_cloth({0, 0.8, 0}, {1, 0.2, 0}, {0, 0.1, -1}, {0, 1, 0}, red, blue, 9);
    cloth.appearance.pattern = Pattern::checker;
    cloth.appearance.second = {1, 0.537, 0.537};  // a quarter of white's light added: the filter's error grows with it
    Shot shot{.options = {.shadow = true}};
    // Sixty-four pictures of one sample each, moved by their share of a pixel, are averaged as light.
    std::vector<double> sum(std::size_t{width} * height * 3);
    for (int sample = 0; sample < 64; ++sample) {
        const int column = sample % 8, row = sample / 8;
        shot.options.shift = {(column - 3.5) / 8, (row - 3.5) / 8};
        const Picture picture = draw(scene, {cloth}, shot);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += radiance_of(linear(picture.bytes[4 * (i / 3) + i % 3] / 255.0));
    }
    for (double& value : sum) value = srgb_byte(value / 64);
    shot.options.shift = {0, 0};
    const double one = psnr(draw(scene, {cloth}, shot), sum);
    shot.samples = 4;
    const double four = psnr(draw(scene, {cloth}, shot), sum);
    std::printf("[ measured ] PSNR against 64 samples: %.2f dB with 1, %.2f dB with 4\n", one, four);
    EXPECT_GT(four, one + 1);
    EXPECT_GT(four, 42.5);
}

TEST_F(Raster, SaysWhyThereIsNoShadow) {
    std::vector<graph::Remark> skipped;
    const auto shadow_reason = [&]() -> std::string {
        for (const graph::Remark& entry : skipped)
            if (entry.what == "shadow") return entry.reason;
        return "drawn";
    };
    SceneDescription scene = dark_room();
    const std::vector<DrawnCloth> cloths{square({0, 0, 0}, 0.5, red, red)};
    draw(scene, cloths, {.options = {.shadow = true}, .skipped = &skipped});
    EXPECT_EQ(shadow_reason(), "the scene has no light");
    scene.lights.push_back({});
    draw(scene, cloths, {.options = {.shadow = false}, .skipped = &skipped});
    EXPECT_EQ(shadow_reason(), "switched off");
    draw(scene, {}, {.options = {.shadow = true}, .skipped = &skipped});
    EXPECT_EQ(shadow_reason(), "the scene has nothing that casts one");
    draw(scene, cloths, {.options = {.shadow = true}, .skipped = &skipped});
    EXPECT_EQ(shadow_reason(), "drawn");
}

TEST_F(Raster, RepeatsByteForByte) {
    SceneDescription scene = floor_scene();
    scene.colliders.push_back(painted(Sphere{{0.2, 0.3, 0}, 0.3}, {0.4, 0.5, 0.6}));
    DrawnCloth cloth = flat_cloth({0, 1, 0}, {1, 0.2, 0}, {0, 0, -1}, {0, 1, 0}, red, blue, 9);
    cloth.appearance.pattern = Pattern::checker;
    for (const std::uint32_t samples : {1u, 4u}) {
        const Shot shot{.samples = samples, .options = {.shadow = true}};
        const auto [first, other_slot] = draw_twice(scene, {cloth}, shot);
        EXPECT_EQ(first.bytes, other_slot.bytes);
        EXPECT_EQ(first.bytes, draw(scene, {cloth}, shot).bytes);
    }
}

TEST_F(Raster, RefusesOtherSampleCounts) {
    EXPECT_THROW(RasterPass(test::gpu().device, dark_room(), width, height, 2), vulkan::VulkanError);
}

}  // namespace
}  // namespace drape
