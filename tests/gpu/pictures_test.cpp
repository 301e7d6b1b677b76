// Pictures that a second device draws while the first simulates on are, frame by frame, those that one device draws.
#include "picture/pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "library_device.h"

namespace drape {
namespace {

using test::library_device;

/// Returns the library's device with another one that draws beside it, whatever the tests' environment says of threads.
Device device_beside(const SceneDescription& scene) {
    constexpr const char* variable = "LP_NUM_THREADS";
    const char* set = std::getenv(variable);
    const std::optional<std::string> before = set ? std::optional<std::string>(set) : std::nullopt;
    unsetenv(variable);
    const Device device = Device::for_scene(scene, true, {}, Validation::count);
    EXPECT_EQ(std::getenv(variable), nullptr);
    if (before) setenv(variable, before->c_str(), 1);
    return device;
}

struct Pictured {
    std::uint32_t frame;
    std::vector<std::uint8_t> rgba;
    std::vector<std::byte> layers;
    std::vector<std::vector<float>> positions, normals;
    double energy;
    bool failed;
    bool operator==(const Pictured&) const = default;
};

std::vector<std::vector<float>> copied(const std::vector<std::span<const float>>& arrays) {
    std::vector<std::vector<float>> all;
    for (const auto& each : arrays) all.emplace_back(each.begin(), each.end());
    return all;
}

Pictured pictured(const FinishedFrame& frame) {
    const auto layers = std::as_bytes(frame.layers);
    return {frame.frame,
            {frame.rgba.begin(), frame.rgba.end()},
            {layers.begin(), layers.end()},
            copied(frame.positions),
            copied(frame.normals),
            frame.statistics.empty() ? 0 : frame.statistics[0].kinetic_energy,
            frame.failure.has_value()};
}

SimulationOptions pictures_of(View view = View::shaded) {
    SimulationOptions options;
    options.draw = true;
    options.positions = false;
    options.view.kind = view;
    options.keep_promises = false;
    return options;
}

bool every_frame(std::uint32_t) { return true; }

/// Returns the wanted frames from the next one on.
std::vector<Pictured> shown_by(Simulation& simulation, const std::function<bool(std::uint32_t)>& wanted = every_frame,
                               const std::function<bool()>& stop = {}) {
    std::vector<Pictured> all;
    simulation.run(
        simulation.scene().time.frame_count - 1, wanted,
        [&](const FinishedFrame& frame) { all.push_back(pictured(frame)); }, stop);
    return all;
}

class PicturesTest : public test::LibraryTest {
  protected:
    void SetUp() override {
        if (library_device().info().type != "cpu") GTEST_SKIP() << "the device draws its pictures itself";
    }

    void open(const std::string& text) {
        scene_ = parse_scene(text);
        beside_.emplace(device_beside(scene_));
    }

    void TearDown() override {
        test::LibraryTest::TearDown();
        EXPECT_TRUE(!beside_ || beside_->validation_count() == 0);
    }

    void compare(const SimulationOptions& options, const std::function<bool(std::uint32_t)>& wanted = every_frame) {
        Simulation one(scene_, options, library_device()), two(scene_, options, *beside_);
        const std::vector<Pictured> expected = shown_by(one, wanted), found = shown_by(two, wanted);
        ASSERT_GT(expected.size(), 3u);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_TRUE(found[i] == expected[i]) << "frame " << expected[i].frame;
        EXPECT_NE(expected.front().rgba, expected.back().rgba) << "nothing moves";
    }

    SceneDescription scene_;
    std::optional<Device> beside_;
};

constexpr const char* colliding_scene =
    R"({"time": {"fps": 60, "frames": 24}, "image": {"size": [64, 48], "samples": 4},
  "wind": {"velocity": [2, 0, 1]},
  "cloths": [{"grid": [17, 14], "size": [0.6, 0.5], "placement": {"origin": [0, 1, 0]}, "areal_density": 0.2,
              "pins": [{"corner": "top_left"}, {"corner": "top_right", "release": 0.2}]},
             {"grid": [9, 11], "size": [0.3, 0.4], "placement": {"origin": [0, 1, 1]}, "areal_density": 0.2,
              "holes": [[[2, 2], [5, 5]]], "pins": [{"edge": "top"}]}],
  "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0}],
                "spheres": [{"center": [0.3, 0.7, 0.5], "radius": 0.15,
                             "path": [{"t": 0}, {"t": 0.4, "translate": [0, 0, -0.6]}]}]}})";

std::string sliced(const std::string& method) {
    return R"({"time": {"fps": 60, "frames": 31}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"grid": [12, 10], "size": [0.5, 0.4], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "top"}]},
             {"grid": [8, 9], "size": [0.3, 0.4], "placement": {"origin": [0.1, 1, 0.1]}, "pins": [{"edge": "top"}]}],
  "cutters": [{"triangle": [[-0.1, 0.8, -1], [0.3, 0.75, 1], [-0.1, 0.78, 1]], "active": [0.1, 0.4],
               "path": [{"t": 0.1}, {"t": 0.4, "translate": [0.3, 0, 0]}]}],
  "solver": {"method": )" +
           method + "}}";
}

TEST_F(PicturesTest, OfColliders) {
    open(colliding_scene);
    compare(pictures_of());
}

TEST_F(PicturesTest, WithLayers) {
    open(sliced("\"line\", \"substeps\": 5"));
    SimulationOptions options = pictures_of();
    options.layers = true;
    compare(options);
    options.draw = false;
    open(colliding_scene);
    Simulation one(scene_, options, library_device()), two(scene_, options, *beside_);
    const std::vector<Pictured> expected = shown_by(one), found = shown_by(two);
    EXPECT_TRUE(found == expected);
    EXPECT_TRUE(expected.back().rgba.empty());
    EXPECT_EQ(expected.back().layers.size(), 64u * 48 * sizeof(LayerPixel));
    EXPECT_NE(expected.front().layers, expected.back().layers);
}

TEST_F(PicturesTest, WithMotionBlur) {
    open(colliding_scene);
    scene_.image.motion_blur = 3;
    compare(pictures_of());
}

TEST_F(PicturesTest, OfStretchAroundHoles) {
    open(colliding_scene);
    compare(pictures_of(View::stretch));
}

TEST_F(PicturesTest, OfClothThatIsCut) {
    open(sliced("\"auto\""));
    compare(pictures_of());
}

TEST_F(PicturesTest, OfStretchOfClothThatIsCut) {
    open(sliced("\"line\", \"substeps\": 5"));
    compare(pictures_of(View::stretch));
}

TEST_F(PicturesTest, OfClothsThatAreSimulatedTogether) {
    std::string cloths;
    for (int i = 0; i < 3; ++i)
        cloths += std::string(i > 0 ? "," : "") + R"({"grid": [8, 9], "size": [0.3, 0.4], "placement": {"origin": [)" +
                  std::to_string(i) + R"(, 1, 0]}, "velocity": [0, 0, )" + std::to_string(i) +
                  R"(], "pins": [{"edge": "top"}]})";
    open(R"({"time": {"frames": 9}, "image": {"size": [48, 32], "samples": 1}, "solver": {"method": "explicit",
             "substeps": 12}, "cloths": [)" +
         cloths + "]}");
    compare(pictures_of());
}

/// Frames in which cloth sleeps come sooner than their pictures can be drawn, and more of them than may wait.
TEST_F(PicturesTest, OfClothThatSleeps) {
    open(R"({"time": {"fps": 60, "frames": 161}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"grid": [8, 9], "size": [0.3, 0.4], "placement": {"origin": [0, 1, 0]}, "areal_density": 0.2, "damping": 4,
              "pins": [{"edge": "top"}]}],
  "colliders": {"spheres": [{"center": [0.1, 0.8, 1], "radius": 0.1,
                             "path": [{"t": 0}, {"t": 0.3, "translate": [0.2, 0, 0]}]}]}})");
    compare(pictures_of());
    Simulation simulation(scene_, pictures_of(), *beside_);
    std::uint32_t asleep = 0;
    simulation.run(160, every_frame, [&](const FinishedFrame& frame) { asleep += frame.effort.asleep ? 1 : 0; });
    EXPECT_GT(asleep, 24u);
}

TEST_F(PicturesTest, OfSomeFramesWithArrays) {
    open(colliding_scene);
    SimulationOptions options = pictures_of();
    options.positions = options.normals = true;
    compare(options, [](std::uint32_t frame) { return frame % 3 == 1; });
}

TEST_F(PicturesTest, GoOnFromASavedState) {
    open(sliced("\"line\", \"substeps\": 5"));
    Simulation whole(scene_, pictures_of(), library_device());
    const std::vector<Pictured> expected = shown_by(whole);
    for (const std::uint32_t after : {3u, 12u, 24u}) {
        Simulation first(scene_, pictures_of(), *beside_), second(scene_, pictures_of(), *beside_);
        const std::vector<Pictured> begun = shown_by(first, every_frame, [&] { return first.next_frame() == after; });
        ASSERT_EQ(begun.size(), after);
        second.restore(first.save());
        std::vector<Pictured> found = begun;
        for (Pictured& each : shown_by(second)) found.push_back(std::move(each));
        EXPECT_TRUE(found == expected) << "after " << after;
    }
}

/// Explicit steps do not follow inextensible cloth in eight substeps, so the run ends some frames later.
TEST_F(PicturesTest, OfFramesBeforeOneThatFailsAreHandedOut) {
    open(R"({"time": {"frames": 60}, "image": {"size": [48, 32], "samples": 1},
  "solver": {"method": "explicit", "substeps": 8}, "cloths": [{"name": "cloth", "grid": [17, 17], "size": [1, 1],
  "stiffness": "rigid", "placement": {"u": [1, 0, 0], "v": [0, 0, 1]}, "pins": [{"box": [[0, 0], [16, 0]]}]}]})");
    SimulationOptions options = pictures_of();
    options.keep_promises = true;
    std::vector<Pictured> expected, found;
    const auto fill = [&](const Device& device, std::vector<Pictured>& frames) {
        Simulation simulation(scene_, options, device);
        EXPECT_THROW(
            simulation.run(59, every_frame, [&](const FinishedFrame& frame) { frames.push_back(pictured(frame)); }),
            Diverged);
    };
    fill(library_device(), expected);
    fill(*beside_, found);
    ASSERT_GT(expected.size(), 10u);
    EXPECT_TRUE(found == expected);
}

TEST_F(PicturesTest, AfterOneThatTheCallerRefusesAreNotHandedOut) {
    open(colliding_scene);
    for (const Device& device : {library_device(), *beside_}) {
        Simulation simulation(scene_, pictures_of(), device);
        std::uint32_t given = 0;
        const auto refuse = [&](const FinishedFrame& frame) {
            EXPECT_EQ(frame.frame, given++);
            if (frame.frame == 7) throw Diverged("refused", FrameFailure{});
        };
        EXPECT_THROW(simulation.run(20, every_frame, refuse), Diverged);
        EXPECT_EQ(given, 8u);
    }
}

TEST_F(PicturesTest, AreInWhatIsSaidOfTheRun) {
    open(colliding_scene);
    const Simulation one(scene_, pictures_of(), library_device()), two(scene_, pictures_of(), *beside_);
    const auto names = [](const Simulation& simulation) {
        std::vector<std::string> all;
        for (const PassWork& work : simulation.work())
            if (work.stage != "upload" && work.name.find("position readback") == std::string::npos)
                all.push_back(work.name);
        return all;
    };
    EXPECT_THAT(names(two), testing::UnorderedElementsAreArray(names(one)));
    EXPECT_EQ(two.facts().pass_count, one.facts().pass_count + 4) << "of each cloth a readback and an upload";
    EXPECT_EQ(two.facts().skipped.size() + 1, one.facts().skipped.size()) << "positions are read back";
    EXPECT_GT(beside_->memory_used(), library_device().memory_used() / 8);
    EXPECT_THAT(two.describe_plan("text"), testing::HasSubstr("position upload"));
}

TEST_F(PicturesTest, OfClothTooLargeForOneThread) {
    open(R"({"time": {"fps": 60, "frames": 6}, "image": {"size": [64, 48], "samples": 4},
  "cloths": [{"grid": [80, 74], "size": [0.6, 0.5], "placement": {"origin": [0, 1, 0]},
              "pins": [{"corner": "top_left"}, {"corner": "top_right"}]}],
  "solver": {"method": "line", "substeps": 3}})");
    ASSERT_FALSE(prefers_calling_thread(scene_));
    compare(pictures_of());
    const Simulation one(scene_, pictures_of(), library_device()), two(scene_, pictures_of(), *beside_);
    EXPECT_EQ(two.facts().pass_count, one.facts().pass_count + 2 * scene_.cloths.size())
        << "of each cloth a readback and an upload";
}

TEST(DeviceForAScene, SimulatesSmallClothOnTheCallingThread) {
    SceneDescription scene = parse_scene(colliding_scene);
    EXPECT_TRUE(prefers_calling_thread(scene));
    scene.cloths[0].grid = {73, 73};
    EXPECT_FALSE(prefers_calling_thread(scene));
    scene.cloths[0].self_collision.emplace();
    EXPECT_TRUE(prefers_calling_thread(scene));
}

}  // namespace
}  // namespace drape
