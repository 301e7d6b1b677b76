// What an ensemble's member was told is a scene that gives the same bytes, by every method, also where it is saved and
// goes on in the middle.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ensemble_members.h"
#include "library_device.h"

namespace drape {
namespace {

using test::drawn;
using test::every_method;
using test::library_device;
using test::of_member;
using test::same_bytes;
using test::scene_of;
using testing::HasSubstr;
using RecordedActionsTest = test::LibraryTest;

constexpr std::uint32_t last = 9;

/// A sheet in wind above a ball and a floor, pulled by a load, that tells its forces.
SceneDescription told_scene(const std::string& method) {
    SceneDescription scene = drawn(scene_of({fmt::format("/solver={{\"method\": \"{}\"}}", method), "/forces=true",
                                             R"(/cloths/0/loads=[{"at": [8, 11], "force": [0, 0, 0.1]}])"}),
                                   1, 5)
                                 .front();
    if (method != "auto") scene.solver.substeps = method == "explicit" ? 24 : 4;
    scene.time.frame_count = last + 1;
    return scene;
}

/// Steps a member of such a scene with everything that can be told, of which each step has a part.
struct Told : test::ToldLists {
    explicit Told(std::uint32_t frame) {
        const double at = 0.1 * frame;
        if (frame == 2 || frame == 5) wind = {3 - at, -0.0, at};
        if (frame == 4) gravity = {at, -9, 1.0 / 3};
        if (frame >= 2 && frame < 6) pins = {0.003 * frame, 0, -0.0, 0, 1.5 * frame, 0, 0, 0, 0, 0, 0, 0};
        if (frame % 3 == 0) colliders = {0, 0.01 * at, 0, 0, 0, 0, 0.02 * at, 0, 0, 0, 5.0 * frame, 0};
        if (frame == 3 || frame == 7) loads = {0, -at, 1e-17 + 0.1};
        if (frame == 3) holds = {1, 0};
        if (frame == 8) holds = {0, 0};
        if (frame > 1) hands = {0.2, 0.5 + 0.003 * frame, 0.1, 0, 2.0 * frame, 0};
        if (frame == 3) grasps = {5, 9, 6, 11};
        if (frame == 7) grasps = {-1, -1, -1, -1};
    }
};

const EnsembleControls all_controls{
    .wind = true, .pins = true, .colliders = true, .holds = true, .gravity = true, .loads = true, .hands = {0}};

/// A member's frame as an ensemble or a simulation had it.
struct Frame {
    std::vector<float> positions, velocities;
    std::vector<ForceOnCloth> forces;
    std::vector<BodyState> bodies;

    explicit Frame(const Ensemble& ensemble)
        : positions(of_member(ensemble.positions(0), 0)),
          velocities(of_member(ensemble.velocities(0), 0)),
          forces(ensemble.statistics(0)[0].forces),
          bodies(ensemble.bodies(0)) {}
};

void expect_same(const Frame& told, const FinishedFrame& replayed) {
    ASSERT_TRUE(same_bytes(told.positions, replayed.positions[0])) << replayed.frame;
    ASSERT_TRUE(same_bytes(told.velocities, replayed.velocities[0])) << replayed.frame;
    const std::vector<ForceOnCloth>& forces = replayed.statistics[0].forces;
    ASSERT_EQ(told.forces.size(), forces.size());
    for (std::size_t k = 0; k < forces.size(); ++k) {
        EXPECT_EQ(told.forces[k].force, forces[k].force) << replayed.frame << " " << forces[k].by;
        EXPECT_EQ(told.forces[k].moment, forces[k].moment) << replayed.frame << " " << forces[k].by;
    }
    ASSERT_EQ(told.bodies.size(), replayed.bodies.size());
    for (std::size_t k = 0; k < told.bodies.size(); ++k) {
        EXPECT_EQ(told.bodies[k].position, replayed.bodies[k].position) << replayed.frame;
        EXPECT_EQ(told.bodies[k].velocity, replayed.bodies[k].velocity) << replayed.frame;
    }
}

/// Replays a scene, and once more from a state that is saved on the way.
void expect_replayed(const SceneDescription& scene, const std::vector<Frame>& frames) {
    const SimulationOptions options{.velocities = true};
    Simulation whole(scene, options, library_device());
    SimulationState saved;
    for (std::uint32_t frame = 0; frame < frames.size(); ++frame) {
        ASSERT_TRUE(whole.step());
        expect_same(frames[frame], whole.frame());
        if (frame == 5) saved = whole.save();
    }
    EXPECT_FALSE(whole.step());
    Simulation rest(scene, options, library_device());
    for (int again = 0; again < 2; ++again) {
        rest.restore(saved);
        for (std::uint32_t frame = 6; frame < frames.size(); ++frame) {
            ASSERT_TRUE(rest.step());
            expect_same(frames[frame], rest.frame());
        }
    }
    // Frames that nobody waits for one by one.
    Simulation run(scene, options, library_device());
    run.run(
        last, [](std::uint32_t frame) { return frame % 4 == 1; },
        [&](const FinishedFrame& frame) { expect_same(frames[frame.frame], frame); });
}

TEST_F(RecordedActionsTest, AreASceneWithTheSameBytes) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        SceneDescription scene = told_scene(method);
        Ensemble ensemble({scene}, {.controls = all_controls, .record = true}, library_device());
        std::vector<Frame> frames{Frame(ensemble)};
        for (std::uint32_t frame = 1; frame <= last; ++frame) {
            ensemble.step(Told(frame).actions());
            frames.emplace_back(ensemble);
        }
        ASSERT_FALSE(ensemble.failure(0).has_value()) << ensemble.failure(0)->reason;
        scene.actions = ensemble.recorded(0);
        ASSERT_EQ(scene.actions->steps.size(), 8u);
        expect_replayed(scene, frames);
    }
}

TEST_F(RecordedActionsTest, PushBodies) {
    const std::vector<double> force{0.5, 0, -0.2, 0, 0.001, 0}, impulse{0, 0.4, 0, 0, 0, 0.002},
        velocity{0.1, 0.2, 0.3, 0, 1, 0};
    const std::vector<std::uint8_t> sets{1};
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        SceneDescription scene = told_scene(method);
        Collider ball{Sphere{{0, 1, 0.3}, 0.05}};
        ball.mass = 2;
        scene.colliders = {ball};
        Ensemble ensemble({scene}, {.controls = {.bodies = true}, .record = true}, library_device());
        std::vector<Frame> frames{Frame(ensemble)};
        for (std::uint32_t frame = 1; frame <= last; ++frame) {
            EnsembleActions actions;
            if (frame == 2) actions = {.body_forces = force};
            if (frame == 4) actions = {.body_impulses = impulse, .body_velocities = velocity, .body_sets = sets};
            ensemble.step(actions);
            frames.emplace_back(ensemble);
        }
        scene.actions = ensemble.recorded(0);
        ASSERT_EQ(scene.actions->steps.size(), 2u);
        expect_replayed(scene, frames);
    }
}

constexpr const char* told_text =
    R"({"time": {"frames": 3}, "cloths": [{"name": "a", "grid": [5, 5], "pins": [{"corner": "top_left"}], "loads": [{"force": [0, 0, 0]}]},
            {"name": "b", "placement": {"origin": [0, 3, 0]}}], "solver": {"method": "line", "substeps": 2}})";

/// Numbers are written so that they are read as they were, and what is not told is not written.
TEST_F(RecordedActionsTest, AreWrittenExactly) {
    const SceneDescription plain = parse_scene(told_text);
    const EnsembleControls controls{
        .wind = true, .pins = true, .holds = true, .gravity = true, .loads = true, .hands = {1, 0}};
    Ensemble ensemble({plain}, {.controls = controls, .record = true}, library_device());
    const std::vector<double> wind{1.0 / 3, -0.0, 1e-300}, pins{0.1, 1e-17, -0.0, 1, 2, 3}, loads{0, -1e-30, 0.7};
    const std::vector<double> hands{1, 2, 3, 0, 0, 1e22, -0.0, 0.2, 0, 0, 0, 0};
    const std::vector<std::uint8_t> holds{1};
    const std::vector<std::int32_t> grasps{-1, -1, -1, -1, 3, 3, 4, 4};
    ensemble.step();
    ensemble.step({.wind = wind, .pins = pins, .holds = holds, .hands = hands, .grasps = grasps, .loads = loads});
    const SceneActions told = ensemble.recorded(0);
    ASSERT_EQ(told.steps.size(), 1u);
    EXPECT_EQ(told.steps[0].frame, 2u);
    EXPECT_TRUE(std::signbit((*told.steps[0].wind)[1]));
    const SceneDescription read = parse_scene(scene_with_actions(told_text, told, 2));
    ASSERT_TRUE(read.actions.has_value());
    EXPECT_EQ(*read.actions, told);
    EXPECT_TRUE(std::signbit((*read.actions->steps[0].wind)[1]));
    EXPECT_TRUE(std::signbit(read.actions->steps[0].hands[1][0]));
    EXPECT_TRUE(parse_scene(scene_with_actions(told_text, told, 1)).actions->steps.empty()) << "told, not followed yet";
    SceneDescription without = read;
    without.actions.reset();
    EXPECT_EQ(without, parse_scene(resolved_scene(told_text)));
    // A state has what was told until then.
    const SimulationState state = ensemble.save(0);
    const std::size_t zero[] = {0};
    ensemble.reset(zero);
    EXPECT_TRUE(ensemble.recorded(0).steps.empty());
    ensemble.restore(zero, std::span(&state, 1));
    EXPECT_EQ(ensemble.recorded(0), told);
    EXPECT_THROW(Ensemble({read}, {}, library_device()), Error);
    EXPECT_THROW(Ensemble({plain}, {}, library_device()).recorded(0), Error);
}

/// What only the way there shows: a hand that takes what a pin holds.
TEST_F(RecordedActionsTest, ThatCannotBeFollowedAreAnErrorOfTheScene) {
    SceneDescription scene = parse_scene(told_text);
    FrameActions first{.frame = 1}, second{.frame = 2};
    first.hands = {{0, 1, 0, 0, 0, 0}};
    second.grasps = {{0, 0, 1, 1}};
    scene.actions = SceneActions{{.hands = {0}}, {first, second}};
    try {
        Simulation(scene, {}, library_device());
        ADD_FAILURE() << "it was taken";
    } catch (const SceneFailure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("/actions/steps/1: frame 2: actions: member 0: grasps: hand 0 takes what "
                                              "pin 0 holds"));
    }
}

}  // namespace
}  // namespace drape
