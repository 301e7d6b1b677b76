// A simulation that is told between frames what to do goes on as an ensemble's only member and as a scene with these
// actions, to the bit, also from a saved state; what it cannot follow changes nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "ensemble_members.h"
#include "library_device.h"

namespace drape {
namespace {

using test::library_device;
using test::of_member;
using test::same_bytes;
using test::scene_of;
using testing::HasSubstr;
using ToldSimulationTest = test::LibraryTest;

constexpr std::uint32_t end_frame = 8;
const EnsembleControls some_controls{
    .wind = true, .pins = true, .colliders = true, .holds = true, .gravity = true, .hands = {0}};

SceneDescription scene_to_tell(const char* method) {
    SceneDescription scene = scene_of({std::string("/solver={\"method\": \"") + method + "\"}"});
    if (std::string_view(method) != "auto") scene.solver.substeps = std::string_view(method) == "explicit" ? 24 : 4;
    scene.time.frame_count = end_frame + 1;
    return scene;
}

/// What is told for a frame.
struct ToldFor : test::ToldLists {
    explicit ToldFor(std::uint32_t frame) {
        if (frame == 2) wind = {1, 0, 0.25};
        if (frame == 3) gravity = {0.5, -9, 0};
        if (frame > 1 && frame < 6) pins = {0.003 * frame, 0, 0, 0, 1.0 * frame, 0, 0, 0, 0, 0, 0, 0};
        if (frame == 4) colliders = {0, 0.01, 0, 0, 0, 0, 0.02, 0, 0, 0, 5, 0};
        if (frame == 5) holds = {1, 0};
        if (frame > 1) hands = {0.2, 0.5 + 0.003 * frame, 0.1, 0, 2.0 * frame, 0};
        if (frame == 3) grasps = {5, 9, 6, 11};
        if (frame == 7) grasps = {-1, -1, -1, -1};
    }
};

std::vector<float> positions_of(const Simulation& simulation) {
    const std::span<const float> positions = simulation.frame().positions[0];
    return {positions.begin(), positions.end()};
}

std::string refused(Simulation& simulation, const EnsembleActions& actions) {
    try {
        simulation.act(actions);
    } catch (const ActionError& error) {
        return error.what();
    }
    return "taken";
}

TEST_F(ToldSimulationTest, IsAnEnsembleOfOneAndASceneWithActions) {
    for (const char* method : {"line", "relax", "explicit", "auto"}) {
        SCOPED_TRACE(method);
        SceneDescription scene = scene_to_tell(method);
        const SimulationOptions options{.velocities = true, .controls = some_controls};
        Simulation told(scene, options, library_device());
        Ensemble one({scene}, {.controls = some_controls, .record = true}, library_device());
        std::vector<std::vector<float>> frames;
        SimulationState saved;
        for (std::uint32_t frame = 0; frame <= end_frame; ++frame) {
            if (frame > 0) told.act(ToldFor(frame).actions());
            if (frame > 0) one.step(ToldFor(frame).actions());
            ASSERT_TRUE(told.step());
            ASSERT_TRUE(same_bytes(of_member(one.positions(0), 0), told.frame().positions[0])) << frame;
            frames.push_back(positions_of(told));
            if (frame == 4) saved = told.save();
        }
        EXPECT_EQ(told.recorded(), one.recorded(0));
        Simulation rest(scene, options, library_device());
        rest.restore(saved);
        for (std::uint32_t frame = 5; frame <= end_frame; ++frame) {
            rest.act(ToldFor(frame).actions());
            ASSERT_TRUE(rest.step());
            EXPECT_TRUE(same_bytes(frames[frame], rest.frame().positions[0])) << frame;
        }
        EXPECT_EQ(rest.recorded(), told.recorded());
        scene.actions = told.recorded();
        Simulation replayed(scene, {}, library_device());
        for (std::uint32_t frame = 0; replayed.step(); ++frame)
            EXPECT_TRUE(same_bytes(frames[frame], replayed.frame().positions[0])) << frame;
    }
}

TEST_F(ToldSimulationTest, WhatItCannotFollowChangesNothing) {
    const SceneDescription scene = scene_to_tell("line");
    Simulation told(scene, {.controls = some_controls}, library_device()),
        quiet(scene, {.controls = some_controls}, library_device());
    told.step(), quiet.step();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> bad{0, nan, 0}, far{0, 0, 0, 0, 0, 0, 50, 0, 0, 0, 0, 0}, two{0, 0};
    const std::vector<std::int32_t> grasp{0, 0, 0, 0}, outside{99, 0, 99, 0};
    const std::vector<double> hand{0, 1, 0, 0, 0, 0}, loads{0, 0, 0};
    EXPECT_THAT(refused(told, {.wind = bad}), HasSubstr("wind: number 1 is nan, expected a finite one"));
    EXPECT_THAT(refused(told, {.wind = two}), HasSubstr("wind has 2 numbers"));
    EXPECT_THAT(refused(told, {.pins = far}), HasSubstr("jumps"));
    EXPECT_THAT(refused(told, {.grasps = grasp}), HasSubstr("hand 0 is nowhere yet"));
    EXPECT_THAT(refused(told, {.hands = hand, .grasps = outside}), HasSubstr("grasps"));
    EXPECT_THAT(refused(told, {.loads = loads}), HasSubstr("control of loads"));
    EXPECT_TRUE(told.recorded().steps.empty());
    while (told.step()) {
        ASSERT_TRUE(quiet.step());
        EXPECT_TRUE(same_bytes(told.frame().positions[0], quiet.frame().positions[0]));
    }
    Simulation plain(scene, {}, library_device());
    EXPECT_THAT(refused(plain, {}), HasSubstr("made without controls"));
    EXPECT_THROW(plain.recorded(), Error);
    SceneDescription own = scene;
    own.actions = SceneActions{some_controls, {}};
    EXPECT_THROW(Simulation(own, {.controls = some_controls}, library_device()), Error);
}

/// Both count, what is told again as it was told last.
TEST_F(ToldSimulationTest, MayBeToldTwiceForAFrame) {
    const SceneDescription scene = scene_to_tell("line");
    const std::vector<double> first{9, 9, 9}, wind{1, 0, 0}, hand{0.2, 0.5, 0.1, 0, 0, 0};
    const std::vector<std::int32_t> grasp{5, 9, 6, 11};
    Simulation once(scene, {.controls = some_controls}, library_device()),
        twice(scene, {.controls = some_controls}, library_device());
    once.act({.wind = wind, .hands = hand, .grasps = grasp});
    twice.act({.wind = first, .hands = hand});
    twice.act({.wind = wind, .grasps = grasp});
    EXPECT_EQ(once.recorded(), twice.recorded());
    while (once.step()) {
        ASSERT_TRUE(twice.step());
        EXPECT_TRUE(same_bytes(once.frame().positions[0], twice.frame().positions[0]));
    }
}

/// Pictures show pins and colliders where they were told to go.
TEST_F(ToldSimulationTest, IsDrawnWhereThingsAre) {
    SceneDescription scene = scene_to_tell("line");
    scene.image.size = {64, 48};
    scene.camera = Camera{.position = {1, 1, 2.5}, .target = {0.3, 0.3, 0}};
    const SimulationOptions options{.draw = true, .controls = some_controls};
    Simulation told(scene, options, library_device());
    std::vector<std::vector<std::uint8_t>> pictures;
    for (std::uint32_t frame = 0; frame <= end_frame; ++frame) {
        if (frame > 0) told.act(ToldFor(frame).actions());
        told.step();
        pictures.emplace_back(told.frame().rgba.begin(), told.frame().rgba.end());
    }
    SceneDescription replayed = scene;
    replayed.actions = told.recorded();
    Simulation again(replayed, {.draw = true}, library_device());
    for (std::uint32_t frame = 0; again.step(); ++frame)
        EXPECT_TRUE(std::ranges::equal(again.frame().rgba, pictures[frame])) << frame;
}

}  // namespace
}  // namespace drape
