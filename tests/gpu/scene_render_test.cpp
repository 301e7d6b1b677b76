// Every shipped scene goes through the whole chain, simulation and picture, under core and synchronization validation
// (gpu_test.h fails a test during which the layer spoke).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

#include "gpu_test.h"
#include "scene_files.h"
#include "simulation/frame_server.h"

namespace drape {
namespace {

constexpr std::uint32_t width = 320, height = 180;

FrameOptions picture_options(std::uint32_t samples) {
    FrameOptions options;
    options.positions = true;
    options.width = width;
    options.height = height;
    options.samples = samples;
    return options;
}

struct Frames {
    std::vector<std::uint32_t> numbers;
    std::vector<std::vector<std::uint8_t>> pictures;
    std::vector<std::vector<float>> positions;  ///< all cloths one after another
};

/// Runs frames 0 .. last, of which every `step`-th is handed out.
Frames run(const SceneDescription& scene, std::uint32_t last, std::uint32_t step, std::uint32_t samples) {
    const SimulationModel model(scene);
    FrameServer server(test::gpu().device, model, picture_options(samples));
    Frames frames;
    const bool complete = server.run(
        last, [&](std::uint32_t frame) { return frame % step == 0; },
        [&](const FinishedFrame& frame) {
            frames.numbers.push_back(frame.frame);
            frames.pictures.emplace_back(frame.rgba.begin(), frame.rgba.end());
            auto& all = frames.positions.emplace_back();
            for (const auto& cloth : frame.positions) all.insert(all.end(), cloth.begin(), cloth.end());
        });
    EXPECT_TRUE(complete);
    return frames;
}

std::array<double, 3> without_grey(const std::array<double, 3>& color) {
    const double grey = (color[0] + color[1] + color[2]) / 3;
    return {color[0] - grey, color[1] - grey, color[2] - grey};
}

double size_of(const std::array<double, 3>& hue) { return std::hypot(hue[0], hue[1], hue[2]); }

constexpr double least_hue = 0.08;  ///< what is nearer to grey has none

/// The colours by which a cloth is found: of its sides, or where those are near grey, of its pattern.
std::vector<Vec3> colors_of(const Appearance& look) {
    if (size_of(without_grey(look.front)) > least_hue) return {look.front, back_of(look)};
    return {look.second};
}

/// Share of the picture whose hue is that of `color`. Light and shade change brightness and the checker whitens, but
/// the direction away from grey stays.
double share_of_hue(const std::vector<std::uint8_t>& rgba, const Vec3& color) {
    const std::array<double, 3> wanted = without_grey(color);
    const double wanted_size = size_of(wanted);
    std::size_t found = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const auto hue = without_grey({rgba[i] / 255.0, rgba[i + 1] / 255.0, rgba[i + 2] / 255.0});
        const double size = size_of(hue);
        const double aligned = hue[0] * wanted[0] + hue[1] * wanted[1] + hue[2] * wanted[2];
        if (size > least_hue && aligned > 0.97 * size * wanted_size) ++found;
    }
    return static_cast<double>(found) / (static_cast<double>(rgba.size()) / 4);
}

class SceneRenderTest : public testing::TestWithParam<std::string> {};

void expect_every_cloth_drawn(const SceneDescription& scene, const Frames& frames, std::uint32_t step) {
    for (std::size_t i = 0; i < frames.numbers.size(); ++i) {
        EXPECT_EQ(frames.numbers[i], i * step);
        ASSERT_EQ(frames.pictures[i].size(), std::size_t{width} * height * 4);
        for (const Cloth& cloth : scene.cloths) {
            double share = 0;
            for (const Vec3& color : colors_of(cloth.appearance)) share += share_of_hue(frames.pictures[i], color);
            EXPECT_GT(share, 0.01) << cloth.name << " in frame " << frames.numbers[i];
        }
    }
    EXPECT_NE(frames.pictures.front(), frames.pictures.back()) << "nothing moved in the picture";
}

void expect_the_same(const Frames& second, const Frames& first) {
    EXPECT_EQ(first.numbers, second.numbers);
    EXPECT_TRUE(first.pictures == second.pictures) << "pictures differ";
    ASSERT_EQ(first.positions.size(), second.positions.size());
    for (std::size_t i = 0; i < first.positions.size(); ++i) {
        ASSERT_EQ(first.positions[i].size(), second.positions[i].size());
        EXPECT_EQ(std::memcmp(first.positions[i].data(), second.positions[i].data(),
                              first.positions[i].size() * sizeof(float)),
                  0)
            << "positions of frame " << first.numbers[i];
    }
}

TEST_P(SceneRenderTest, DrawsEveryClothWithOneSample) {
    const SceneDescription scene = test::shipped_scene(GetParam());
    const Frames frames = run(scene, 5, 5, 1);
    ASSERT_EQ(frames.numbers.size(), 2u);
    expect_every_cloth_drawn(scene, frames, 5);
}

TEST_P(SceneRenderTest, DrawsEveryClothWithFourSamplesAndTwiceTheSameBytes) {
    const SceneDescription scene = test::shipped_scene(GetParam());
    const Frames first = run(scene, 24, 8, 4);
    ASSERT_EQ(first.numbers.size(), 4u);
    expect_every_cloth_drawn(scene, first, 8);
    EXPECT_FALSE(first.positions.front() == first.positions.back()) << "nothing moved";
    expect_the_same(run(scene, 24, 8, 4), first);
}

/// This shows that the test of hues is no tautology: without its cloths the same scene has none of their colours.
TEST_P(SceneRenderTest, ColoursAreTheCloths) {
    SceneDescription scene = test::shipped_scene(GetParam());
    std::vector<Vec3> colors;
    for (Cloth& cloth : scene.cloths) {
        std::ranges::copy(colors_of(cloth.appearance), std::back_inserter(colors));
        cloth.appearance = {{0.5, 0.5, 0.5}, Vec3{0.5, 0.5, 0.5}, Pattern::plain};
    }
    const Frames frames = run(scene, 0, 1, 1);
    for (const Vec3& color : colors) EXPECT_LT(share_of_hue(frames.pictures.at(0), color), 0.005);
}

INSTANTIATE_TEST_SUITE_P(EveryScene, SceneRenderTest, testing::ValuesIn(test::shipped_scene_names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace drape
