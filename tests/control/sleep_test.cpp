// Some events wake cloth, and some cloth never falls asleep.
#include "control/sleep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/byte_stream.h"
#include "support/sheets.h"

namespace drape {
namespace {

constexpr std::uint32_t fps = 60;

SceneDescription hung() {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 4);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.time.frame_count = 1000;
    scene.solver = {};
    scene.solver.method = SolverMethod::automatic;
    return scene;
}

ClothStatistics moving_at(double speed) {
    ClothStatistics statistics;
    statistics.largest_speed = speed;
    statistics.largest_distance = 1;
    return statistics;
}

/// Returns whether a scene falls asleep in or after `frames` frames of these speeds, by frame.
template <class Speed>
bool sleeps(const SceneDescription& scene, const Speed& speed, std::uint32_t frames = 70) {
    const SimulationModel model(scene);
    Sleep sleep(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        if (sleep.asleep(frame)) return true;
        sleep.saw({moving_at(speed(frame))}, 4);
    }
    return sleep.asleep(frames + 1);
}

TEST(SleepTest, WhatIsStillForASecondSleeps) {
    EXPECT_TRUE(sleeps(hung(), [](std::uint32_t) { return 1e-4; }));
    EXPECT_FALSE(sleeps(
        hung(), [](std::uint32_t) { return 1e-4; }, fps - 1));
    EXPECT_FALSE(sleeps(hung(), [](std::uint32_t) { return 1e-3; }));
}

TEST(SleepTest, WhatTurnsRoundOrBeginsToToppleDoesNot) {
    EXPECT_FALSE(sleeps(hung(), [](std::uint32_t frame) { return frame % 50 == 0 ? 0.0 : 0.1; }));
    EXPECT_FALSE(sleeps(hung(), [](std::uint32_t frame) { return 1e-4 * std::exp(0.01 * frame); }));
    EXPECT_TRUE(sleeps(hung(), [](std::uint32_t frame) { return 1e-4 * std::exp(-0.01 * frame); }));
}

TEST(SleepTest, ATighterMotionKeepsAwake) {
    SceneDescription scene = hung();
    scene.solver.tolerance_motion = 1e-3;
    EXPECT_FALSE(sleeps(scene, [](std::uint32_t) { return 1e-4; }));
}

TEST(SleepTest, AllThatChangesIsNotQuiet) {
    const auto is_quiet = [](const SceneDescription& scene, double time) {
        return quiet(SimulationModel(scene), static_cast<std::uint32_t>(time * fps + 0.5));
    };
    const std::vector<MotionKey> keys{{1, {0, 0, 0}, {0, 0, 0}}, {2, {0.5, 0, 0}, {0, 0, 0}}};
    SceneDescription pulled = hung(), pushed = hung(), released = hung(), cut = hung(), gusty = hung(), windy = hung();
    pulled.cloths[0].pins[0].path.keys = keys;
    pushed.colliders = {{Sphere{}}};
    pushed.colliders[0].path.keys = keys;
    released.cloths[0].pins[0].release = 1.495;
    cut.cutters.resize(1);
    cut.cutters[0].begin = 1.2, cut.cutters[0].end = 1.6;
    SceneDescription turning = hung(), heavier = hung();
    turning.wind.keys = {{1, {3, 0, 0}}, {2, {0, 0, 3}}};
    heavier.gravity_keys = {{1, {0, -2, 0}}, {2, {0, -9, 0}}};
    windy.wind.velocity = gusty.wind.velocity = {3, 0, 0};
    gusty.wind.gust.amplitude = 1;
    for (const SceneDescription& scene : {pulled, pushed, released, cut, turning, heavier}) {
        EXPECT_TRUE(is_quiet(scene, 1));
        EXPECT_FALSE(is_quiet(scene, 1.5));
        EXPECT_TRUE(is_quiet(scene, 2.1));
    }
    EXPECT_TRUE(is_quiet(windy, 1));
    EXPECT_FALSE(is_quiet(gusty, 1));
}

TEST(SleepTest, WhatToreSleepsOnlyAfterASecond) {
    const SimulationModel model(hung());
    Sleep sleep(model);
    std::uint32_t frame = 1;
    for (; !sleep.asleep(frame); ++frame) sleep.saw({moving_at(1e-4)}, 4);
    sleep.wake();
    const std::uint32_t woken = frame;
    for (; !sleep.asleep(frame); ++frame) sleep.saw({moving_at(1e-4)}, 4);
    EXPECT_EQ(frame - woken, woken - 1);
}

TEST(SleepTest, WhatHasMovedSleepsAgainOnlyAfterASecond) {
    SceneDescription scene = hung();
    scene.colliders = {{Sphere{}}};
    scene.colliders[0].path.keys = {{2, {0, 0, 0}, {0, 0, 0}}, {2.1, {0.5, 0, 0}, {0, 0, 0}}};
    const SimulationModel model(scene);
    Sleep sleep(model);
    std::vector<bool> asleep;
    for (std::uint32_t frame = 1; frame <= 4 * fps; ++frame) {
        asleep.push_back(sleep.asleep(frame));
        if (!asleep.back()) sleep.saw({moving_at(1e-4)}, 4);
    }
    EXPECT_TRUE(asleep[2 * fps - 1]);
    for (std::uint32_t frame = 2 * fps + 1; frame < 3 * fps; ++frame) EXPECT_FALSE(asleep[frame - 1]) << frame;
    EXPECT_TRUE(asleep.back());
}

TEST(SleepTest, NoMoreSpeedsAreReadBackThanASecondHas) {
    const SimulationModel model(hung());
    const auto reads = [&](std::size_t count) {
        ByteWriter writer;
        writer(std::vector<double>(count, 0.5));
        const std::vector<std::byte> bytes = writer.take();
        ByteReader reader(bytes);
        Sleep sleep(model);
        return sleep.transfer(reader) && sleep.remembers() == (count > 0);
    };
    EXPECT_TRUE(reads(0));
    EXPECT_TRUE(reads(fps));
    EXPECT_FALSE(reads(fps + 1));
}

}  // namespace
}  // namespace drape
