// Fabrics, threads, hems, textures, moving cameras and alpha look as their formulas say.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "picture/fixtures.h"
#include "picture/textures.h"
#include "raster_picture.h"

namespace drape {
namespace {

/// A square of 1 m that faces the camera, without sheen: in a dark room it shows its colour times the shade.
DrawnCloth grey_square(double side = 1) {
    DrawnCloth cloth = square({0, 0, 0}, side, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
    cloth.appearance.sheen = 0;
    return cloth;
}

TEST_F(Raster, RoughnessMakesTheHighlightAndSheenTheRim) {
    SceneDescription scene = dark_room();
    scene.ambient = scene.ambient_ground = {0.1, 0.12, 0.15};
    scene.lights = {{{-0.4, -0.5, -1}, {1, 0.9, 0.8}, 0.6}};
    const Vec3 color{0.4, 0.2, 0.3};
    const Vec3 to_eye = unit(
        {-3 * std::tan(20 * std::numbers::pi / 180) / height, 3 * std::tan(20 * std::numbers::pi / 180) / height, 3});
    // The first normal is half way between light and eye.
    for (const Vec3& direction : {Vec3{0.19, 0.24, 1}, Vec3{-0.1, 0.3, 1}, Vec3{0.9, 0.1, 0.3}})
        for (const auto& [roughness, sheen] : {std::pair{0.3, 0.0}, {0.5, 0.3}, {0.9, 1.0}}) {
            const Vec3 normal = unit(direction);
            DrawnCloth cloth = flat_cloth({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, normal, color, color);
            cloth.appearance.roughness = roughness;
            cloth.appearance.sheen = sheen;
            const Shading shading{linear(color),        normal, to_eye,    scene.ambient,
                                  scene.ambient_ground, 0.2,    roughness, sheen};
            expect_color(draw(scene, {cloth}).at(160, 119), shading.pixel_color(scene.lights),
                         "roughness " + std::to_string(roughness));
        }
}

TEST_F(Raster, TheBackFollowsTheFront) {
    SceneDescription scene = dark_room();
    DrawnCloth cloth = grey_square();
    cloth.appearance.front = {0.6, 0.4, 0.2};
    cloth.appearance.back.reset();
    scene.camera->position = {0, 0, -3};
    const Vec3 expected = linear(back_share * cloth.appearance.front);
    expect_color(draw(scene, {cloth}).at(160, 120),
                 {srgb_byte(expected[0]), srgb_byte(expected[1]), srgb_byte(expected[2])}, "back");
}

/// In a room of even light the relief's slope changes nothing, and the shade is seen alone: 1 + 0.45 (1/3 - s^2) at the
/// share s of half a thread from its middle.
TEST_F(Raster, ThreadsAreShadedAcrossAndKeepTheMeanBrightness) {
    const SceneDescription scene = dark_room();
    DrawnCloth cloth = grey_square();
    const double plain = linear(0.5), threads = 8;
    cloth.appearance.weave = 1 / threads;
    const Picture picture = draw(scene, {cloth});
    double sum = 0, count = 0;
    for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 64; ++column) {
            const double u = (column + 0.5) / 64, v = (row + 0.5) / 64;
            const PixelPosition at = pixel(scene, {u - 0.5, v - 0.5, 0});
            // The place of the pixel's middle, which a thread's parabola is seen at.
            const double pixels = 3 * std::tan(20 * std::numbers::pi / 180) * 2 / height;
            const double x = threads * ((std::floor(at.x) + 0.5 - 160) * pixels + 0.5);
            const double y = threads * ((120 - std::floor(at.y) - 0.5) * pixels + 0.5);
            const bool warp = static_cast<int>(std::floor(x) + std::floor(y)) % 2 == 0;
            const double across = 2 * (warp ? y - std::floor(y) : x - std::floor(x)) - 1;
            EXPECT_NEAR(picture.at(at)[0], srgb_byte(plain * (1 + 0.45 * (1.0 / 3 - across * across))), 4)
                << column << ' ' << row;
            sum += linear(picture.at(at)[0] / 255.0);
            ++count;
        }
    EXPECT_NEAR(sum / count, plain, 0.01 * plain);
}

TEST_F(Raster, ThreadsFinerThanPixelsAreNotSeen) {
    const SceneDescription scene = dark_room();
    DrawnCloth cloth = grey_square(), plain = cloth;
    cloth.appearance.weave = 0.015;  // two pixels are 0.018 m
    EXPECT_EQ(draw(scene, {cloth}).bytes, draw(scene, {plain}).bytes);
}

TEST_F(Raster, HemsRunAlongTheRim) {
    const SceneDescription scene = dark_room();
    DrawnCloth cloth = grey_square();
    cloth.appearance.hem = 0.15;
    const Picture picture = draw(scene, {cloth});
    const double plain = linear(0.5);
    for (int side = 0; side < 4; ++side) {
        const auto level = [&](double from_rim) {
            const double away = 0.5 - from_rim;
            return picture.at(pixel(scene, side == 0   ? Vec3{away, 0.03, 0}
                                           : side == 1 ? Vec3{-away, 0.03, 0}
                                           : side == 2 ? Vec3{0.03, away, 0}
                                                       : Vec3{0.03, -away, 0}))[0];
        };
        EXPECT_NEAR(level(0.3), srgb_byte(plain), 1) << side;
        EXPECT_NEAR(level(0.06), srgb_byte(0.93 * plain), 1) << side;
        EXPECT_LT(level(0.15), srgb_byte(0.8 * plain)) << side;
    }
}

std::shared_ptr<TextureImage> checker_image(std::uint32_t columns, std::uint32_t rows) {
    auto image = std::make_shared<TextureImage>(TextureImage{columns, rows, {}});
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const auto level = static_cast<std::uint8_t>(40 + 50 * column + 15 * row);
            image->rgb.insert(image->rgb.end(), {level, static_cast<std::uint8_t>(255 - level), 80});
        }
    return image;
}

/// A sheet, and one whose rim was moved to an outline within it, show the same where both are.
TEST_F(Raster, PatternsOfAnOutlineLieWhereItsParticlesDo) {
    const SceneDescription scene = dark_room();
    constexpr std::uint32_t particles = 5;
    DrawnCloth whole = flat_cloth({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, red, red, particles);
    whole.appearance.pattern = Pattern::stripes;
    whole.appearance.second = blue;
    whole.appearance.sheen = 0;
    DrawnCloth outlined = whole;
    for (std::uint32_t row = 0; row < particles; ++row)
        for (std::uint32_t column = 0; column < particles; ++column) {
            const bool rim = column == 0 || column + 1 == particles;
            glsl::vec4& at = outlined.positions[row * particles + column];
            if (rim) at.x *= row % 2 == 0 ? 0.8f : 0.9f;
            outlined.panel.push_back({static_cast<double>(at.x) + 0.5, static_cast<double>(at.y) + 0.5});
        }
    DrawnCloth by_grid = outlined;
    by_grid.panel.clear();
    const Picture expected = draw(scene, {whole}), found = draw(scene, {outlined}), other = draw(scene, {by_grid});
    std::size_t compared = 0, unlike = 0;
    for (double x = -0.39; x < 0.39; x += 0.004)
        for (double y = -0.45; y < 0.45; y += 0.01) {
            const PixelPosition at = pixel(scene, {x, y, 0});
            const std::array<int, 3> a = expected.at(at), b = found.at(at), c = other.at(at);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 6) << x << ' ' << y;
            ++compared;
            unlike += std::abs(a[0] - c[0]) > 100 ? 1 : 0;
        }
    EXPECT_GT(unlike, compared / 100) << "the rim's move shows nothing";
}

TEST_F(Raster, TexturesSpanTheClothFromItsFirstRow) {
    SceneDescription scene = dark_room();
    DrawnCloth cloth = grey_square();
    const auto image = checker_image(4, 2);
    cloth.appearance.image = image;
    cloth.appearance.back.reset();
    for (const bool front : {true, false}) {
        scene.camera->position = {0, 0, front ? 3.0 : -3.0};
        const Picture picture = draw(scene, {cloth});
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column < 4; ++column) {
                // flat_cloth has row 0 at the lowest v.
                const Vec3 at{(column + 0.5) / 4 - 0.5, (row + 0.5) / 2 - 0.5, 0};
                Vec3 expected;
                for (std::size_t k = 0; k < 3; ++k)
                    expected[k] =
                        srgb_byte((front ? 1 : 0.7) *
                                  linear(image->rgb[3 * static_cast<std::size_t>(4 * row + column) + k] / 255.0));
                expect_color(picture.at(pixel(scene, at)), expected,
                             std::to_string(column) + (front ? " front" : " back"));
            }
    }
    cloth.appearance.back = blue;
    expect_color(draw(scene, {cloth}).at(160, 120), {0, 0, srgb_byte(1)}, "a back of its own");
}

TEST_F(Raster, SmallTexturesShowTheirMean) {
    SceneDescription scene = dark_room();
    scene.camera->position = {0, 0, 40};
    scene.camera->target = {0, 0, 0};
    DrawnCloth cloth = grey_square(4);
    const auto image = std::make_shared<TextureImage>(TextureImage{256, 256, {}});
    for (std::size_t i = 0; i < std::size_t{256} * 256; ++i)
        image->rgb.insert(image->rgb.end(), 3, (i + i / 256) % 2 == 0 ? 255 : 0);
    cloth.appearance.image = image;
    const double mean = srgb_byte(0.5);
    expect_color(draw(scene, {cloth}).at(160, 120), {mean, mean, mean}, "far away");
}

TEST(TexturesTest, AreResampledToPowersOfTwoAndHalved) {
    Cloth cloth;
    cloth.appearance.image = checker_image(3, 2);
    const Textures textures({cloth, cloth});
    EXPECT_EQ(textures.halves().size(), 2 * (8u + 2u));  // 4 x 2, 2 x 1: shared by both
    EXPECT_EQ(half_float(0), 0x0000);
    EXPECT_EQ(half_float(1), 0x3c00);
    EXPECT_EQ(half_float(0.5), 0x3800);
    EXPECT_EQ(half_float(0.1), 0x2e66);
    EXPECT_EQ(half_float(std::ldexp(1, -24)), 0x0001);
    EXPECT_EQ(half_float(0.99999), 0x3c00);
    EXPECT_EQ(half_float(65504), 0x7bff);
}

TEST_F(Raster, ACameraWithKeysIsWhereTheyLead) {
    SceneDescription scene = floor_scene();
    scene.colliders.push_back(painted(Box{{0.2, 0.3, 0}, {0.3, 0.3, 0.2}}, {0.4, 0.5, 0.6}));
    scene.camera->position = {0, 1, 3};
    scene.camera->target = {0, 0.2, 0};
    SceneDescription moving = scene;
    moving.camera->keys = {{0, {2, 1, 3}, {0, 0.2, 0}}, {1, {-1, 2, 2}, {0.2, 0.1, 0}}};
    for (const double time : {-1.0, 0.5, 2.0}) {
        // Between two keys a component goes as 3 s^2 - 2 s^3.
        const double s = std::clamp(time, 0.0, 1.0), share = s * s * (3 - 2 * s);
        const std::vector<CameraKey>& keys = moving.camera->keys;
        scene.camera->position = keys[0].position + share * (keys[1].position + -1.0 * keys[0].position);
        scene.camera->target = keys[0].target + share * (keys[1].target + -1.0 * keys[0].target);
        const Shot shot{.samples = 4, .time = time, .options = {.shadow = true}};
        const Picture still = draw(scene, {}, shot), moved = draw(moving, {}, shot);
        std::size_t other = 0;
        for (std::size_t i = 0; i < still.bytes.size(); ++i) other += still.bytes[i] != moved.bytes[i];
        EXPECT_LT(other, still.bytes.size() / 1000) << time;  // both round the camera's place
    }
}

TEST_F(Raster, AlphaIsTheShareThatIsCovered) {
    SceneDescription scene = floor_scene();
    scene.camera = Camera{{0, 1, 3}, {0, 0.5, 0}, 40};
    scene.image.alpha = true;
    const DrawnCloth tilted = flat_cloth({0, 0.5, 0}, {0.8, 0.2, 0}, {-0.2, 0.8, 0}, {0, 0, 1}, white, white);
    for (const std::uint32_t samples : {1u, 4u}) {
        const Picture picture = draw(scene, {tilted}, {.samples = samples});
        EXPECT_EQ(picture.alpha(pixel(scene, {0, 0.5, 0})), 255);
        EXPECT_EQ(picture.alpha(pixel(scene, {0, 1.2, 0})), 0) << "backdrop";
        EXPECT_EQ(picture.alpha(pixel(scene, {0.8, 0, 0.5})), 0) << "floor";
        int partly = 0;
        const std::array<int, 3> inside = picture.at(pixel(scene, {0, 0.5, 0}));
        for (std::size_t i = 0; i < picture.bytes.size(); i += 4) {
            const int alpha = picture.bytes[i + 3];
            if (alpha == 0 || alpha == 255) continue;
            ++partly;
            EXPECT_NEAR(picture.bytes[i], inside[0], 3) << "straight alpha: colours are not mixed with black";
        }
        EXPECT_TRUE(samples == 1 ? partly == 0 : partly > 50) << partly;
    }
}

TEST(BladeTest, HasARimWhileItIsActive) {
    SceneDescription scene;
    Cutter cutter{{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}, 0.5, 1, {}};
    cutter.path.keys = {{0, {0, 0, 0}, {}}, {1, {0, 0, 2}, {0, 0, 180}}};
    scene.cutters = {cutter};
    const std::vector<Fixture> rim = fixtures(scene);
    ASSERT_EQ(rim.size(), 3u);
    // At the end it is turned about its middle, (1, 1, 0), by half a turn.
    const Capsule first = std::get<Capsule>(posed(rim[0], 1).shape);
    EXPECT_NEAR(first.from[0], 2, 1e-12);
    EXPECT_NEAR(first.to[0], -1, 1e-12);
    EXPECT_NEAR(first.to[2], 2, 1e-12);
    EXPECT_GT(first.radii[0], 0);
    for (const double time : {0.49, 1.01}) EXPECT_EQ(std::get<Capsule>(posed(rim[0], time).shape).radii[0], 0);
    scene.image.blades = false;
    EXPECT_TRUE(fixtures(scene).empty());
}

}  // namespace
}  // namespace drape
