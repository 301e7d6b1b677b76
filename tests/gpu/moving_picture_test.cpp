// Pictures of what moves, and layers of what is strained, are those of the states that a run goes through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "library_device.h"
#include "picture/motion_blur.h"

namespace drape {
namespace {

using test::library_device;

class MovingPictureTest : public test::LibraryTest {};

/// A sheet that nothing pulls at and that goes to the right, a ball that goes up, and a camera that goes along.
SceneDescription moving_scene(double fps, std::uint32_t frames) {
    return parse_scene(R"({"time": {"fps": )" + std::to_string(fps) + R"(, "frames": )" + std::to_string(frames) +
                       R"(}, "gravity": [0, 0, 0],
  "image": {"size": [160, 120], "samples": 4, "fixtures": false},
  "camera": {"keys": [{"t": 0, "position": [0, 0, 3], "target": [0, 0, 0]},
                      {"t": 1, "position": [0.6, 0, 3], "target": [0.6, 0, 0]}]},
  "cloths": [{"grid": [9, 9], "size": [0.5, 0.5], "placement": {"origin": [-0.7, -0.5, 0], "u": [1, 0, 0], "v": [0, 1, 0]},
              "velocity": [2, 0, 0], "damping": 0}],
  "colliders": {"spheres": [{"center": [0.6, -0.4, 0], "radius": 0.2,
                             "path": [{"t": 0}, {"t": 1, "translate": [0, 1, 0]}]}]},
  "solver": {"method": "line", "substeps": 4}})");
}

std::vector<std::vector<std::uint8_t>> pictures_of(const SceneDescription& scene, std::uint32_t from) {
    SimulationOptions options;
    options.draw = true;
    Simulation simulation(scene, options, library_device());
    std::vector<std::vector<std::uint8_t>> all;
    simulation.run(
        scene.time.frame_count - 1, [from](std::uint32_t frame) { return frame >= from; },
        [&](const FinishedFrame& frame) { all.emplace_back(frame.rgba.begin(), frame.rgba.end()); });
    return all;
}

double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += (double(a[i]) - b[i]) * (double(a[i]) - b[i]);
    return std::sqrt(squares / static_cast<double>(a.size()));
}

/// The shutter is open for half the time, so two moments of a frame are two of four times as many frames.
TEST_F(MovingPictureTest, BlurIsTheMeanOfFinerFrames) {
    SceneDescription blurred = moving_scene(15, 5);
    blurred.image.motion_blur = 2;
    const std::vector<std::uint8_t> found = pictures_of(blurred, 4).at(0);
    const auto finer = pictures_of(moving_scene(60, 17), 15);
    ASSERT_EQ(finer.size(), 2u);
    PictureMean mean;
    for (const auto& each : finer) mean.add(each);
    const std::vector<std::uint8_t> expected(mean.mean().begin(), mean.mean().end());
    EXPECT_LT(difference(found, expected), 0.5);
    EXPECT_GT(difference(found, finer.back()), 5) << "nothing is blurred";
    EXPECT_GT(difference(finer.front(), finer.back()), 10);
}

TEST_F(MovingPictureTest, WhatStandsStillIsNotBlurred) {
    SceneDescription scene = moving_scene(60, 3);
    scene.cloths[0].velocity = {0, 0, 0};
    scene.colliders[0].path.keys.clear();
    scene.camera->keys.clear();
    const auto sharp = pictures_of(scene, 2);
    scene.image.motion_blur = 5;
    EXPECT_EQ(pictures_of(scene, 2), sharp);
}

TEST_F(MovingPictureTest, LayersShowTheStrainOfTheStatistics) {
    SceneDescription scene = parse_scene(R"({"time": {"frames": 20}, "image": {"size": [160, 120]},
  "cloths": [{"grid": [9, 9], "size": [0.5, 0.5], "placement": {"origin": [0, 1, 0]}, "areal_density": 0.5,
              "stiffness": {"stretch": 4, "shear": 1, "bend": 1e-5}, "pins": [{"edge": "top"}]}],
  "solver": {"method": "line", "substeps": 20}})");
    SimulationOptions options;
    options.layers = true;
    Simulation simulation(scene, options, library_device());
    while (simulation.step()) {
    }
    const FinishedFrame& frame = simulation.frame();
    EXPECT_TRUE(frame.rgba.empty());
    ASSERT_EQ(frame.layers.size(), 160u * 120);
    const auto most = std::ranges::max_element(frame.layers, {}, &LayerPixel::strain)->strain;
    const double largest = frame.statistics[0].stretch.largest;
    EXPECT_GT(largest, 0.01);
    EXPECT_LT(most, 1.0001 * largest);
    EXPECT_GT(most, 0.9 * largest);
    options.draw = true;
    Simulation both(scene, options, library_device());
    options.layers = false;
    Simulation picture(scene, options, library_device());
    both.step(), picture.step();
    EXPECT_TRUE(std::ranges::equal(both.frame().rgba, picture.frame().rgba));
    EXPECT_TRUE(picture.frame().layers.empty());
}

}  // namespace
}  // namespace drape
