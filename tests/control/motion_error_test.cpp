// The estimate of the position error, and the difference between error and chaos, on runs whose truth is known.
#include "control/motion_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/byte_stream.h"
#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "control/balance.h"
#include "control/frame_judgement.h"
#include "control/motion_watch.h"
#include "control/sensitivity.h"
#include "control/watch.h"
#include "support/sheets.h"
#include "twin/statistics.h"
#include "twin/twin.h"

namespace drape {
namespace {

const Method& line() { return row_of(SolverMethod::line); }
const Method& explicit_steps() { return row_of(SolverMethod::explicit_steps); }

TEST(MotionErrorTest, TheCompanionHasFewerSubstepsButOfExplicitStepsMore) {
    for (const std::uint32_t substeps : {2u, 4u, 6u, 8u, 12u, 16u, 96u, 4096u}) {
        EXPECT_GT(companion_substeps(line(), substeps), 0u);
        EXPECT_LE(companion_substeps(line(), substeps), substeps / 2);
    }
    EXPECT_EQ(companion_substeps(line(), 96), 24u);
    EXPECT_EQ(companion_substeps(line(), 8), 4u) << "longer substeps tell nothing in contact";
    EXPECT_EQ(companion_substeps(explicit_steps(), 40), 60u);
    // At the most that a loop takes there are no more.
    EXPECT_LT(companion_substeps(explicit_steps(), explicit_steps().most_substeps), explicit_steps().most_substeps);
}

TEST(MotionErrorTest, RichardsonsEstimateIsExactForAnErrorOfThatOrder) {
    EXPECT_LT(error_order(line(), true), error_order(line(), false)) << "changes of substeps leave less";
    for (const Method* method : {&line(), &explicit_steps()})
        for (const std::uint32_t substeps : {4u, 6u, 8u, 12u, 32u, 96u, 4096u}) {
            const double order = error_order(*method, substeps < 10);
            const auto error = [order](double n) { return 0.3 * std::pow(n, -order); };
            const std::uint32_t beside = companion_substeps(*method, substeps);
            const double apart = std::abs(error(beside) - error(substeps));
            EXPECT_NEAR(richardson_error(order, double(substeps) / beside, apart), error(substeps),
                        1e-9 * error(substeps))
                << method->name() << ", " << substeps;
        }
    EXPECT_EQ(richardson_error(1, 4, 0), 0);
}

/// Two cloths, the second twice the size: its error may be twice as large.
SceneDescription two_cloths() {
    SceneDescription scene = test::sheet(9, 8, 1, 0.5, 1);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].size = {2, 1};
    scene.time = {.fps = 50, .frame_count = 101};
    scene.solver = {};
    return scene;
}

TEST(MotionErrorTest, TheWorstClothCountsAndAnErrorHoldsOn) {
    const SimulationModel model(two_cloths());
    MotionError error(model);
    EXPECT_TRUE(std::isnan(error.error()));
    const auto estimate = [&](double apart) {
        return richardson_error(error_order(row_of(model.scene.solver.method), model.closed_loop()),
                                16.0 / model.companion_substeps(16), apart);
    };
    error.saw(25, 16, std::vector{0.01, 0.03});
    EXPECT_DOUBLE_EQ(error.error(), estimate(0.03));
    EXPECT_DOUBLE_EQ(error.share(),
                     std::max(estimate(0.01) / motion_limit(model, 0), estimate(0.03) / motion_limit(model, 1)) / 0.5);
    EXPECT_DOUBLE_EQ(error.allowed(), 0.5 * motion_limit(model, 1)) << "of the cloth whose error is the worse share";
    EXPECT_DOUBLE_EQ(error.at_end(), 4 * error.error()) << "2 s, of which half a one has passed";
    const double before = error.error();
    error.saw(26, 16, std::vector{0.0, 0.0});
    EXPECT_LT(error.error(), before);
    EXPECT_GT(error.error(), 0.9 * before) << "a swing's two runs meet for a moment";
    ByteWriter writer;
    error.transfer(writer);
    MotionError other(model);
    const std::vector<std::byte> bytes = writer.take();
    ByteReader reader(bytes);
    EXPECT_TRUE(other.transfer(reader));
    EXPECT_EQ(other.error(), error.error());
    EXPECT_EQ(other.share(), error.share());
}

/// An error that is `share` of what is allowed at that frame.
MotionError error_of(const SimulationModel& model, std::uint32_t frame, double share) {
    MotionError unit(model);
    const auto saw = [&](MotionError& error, double apart) { error.saw(frame, 16, std::vector{apart, 0.0}); };
    saw(unit, 1);
    MotionError error(model);
    saw(error, share / unit.share());
    return error;
}

/// Returns what a disturbed run that began at `begin` shows when it parts by `parted` in frame `begin` + 1.
Sensitivity parted_by(const SimulationModel& model, std::uint32_t begin, double parted, const MotionError& error) {
    Sensitivity sensitivity(model);
    sensitivity.begin(begin);
    sensitivity.saw(begin + 1, std::vector{parted, 0.0}, error);
    return sensitivity;
}

TEST(SensitivityTest, ADisturbedRunBeginsWhereTheErrorMatters) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    EXPECT_FALSE(sensitivity.begins(10, error_of(model, 10, 0.6), true));
    EXPECT_TRUE(sensitivity.begins(10, error_of(model, 10, 0.8), true));
    EXPECT_TRUE(sensitivity.begins(10, error_of(model, 10, 0.01), false)) << "substeps do not lessen a probe's error";
    sensitivity.begin(10);
    EXPECT_FALSE(sensitivity.begins(11, error_of(model, 11, 0.8), true)) << "it runs";
}

TEST(SensitivityTest, OnlyAGoodShareOfTheErrorExcuses) {
    const SimulationModel model(two_cloths());
    for (const double share : {0.8, 1.0, 3.0, 10.0}) {
        const MotionError error = error_of(model, 10, share);
        for (const double part : {0.01, 0.1, 0.4, 0.6, 2.0}) {
            const Sensitivity sensitivity = parted_by(model, 10, part * error.error(), error);
            EXPECT_EQ(sensitivity.is_sensitive(), part >= 0.5) << share << ", " << part;
            EXPECT_DOUBLE_EQ(sensitivity.parted(), part * error.error());
            FrameEffort effort;
            note_motion(error, sensitivity, effort);
            EXPECT_DOUBLE_EQ(effort.position_error, error.error()) << "the error is stated beside what parted";
            EXPECT_DOUBLE_EQ(effort.parted, sensitivity.parted());
        }
    }
    const MotionError small = error_of(model, 10, 0.01);
    EXPECT_FALSE(parted_by(model, 10, small.error(), small).is_sensitive()) << "runs that part by less than matters";
    EXPECT_TRUE(parted_by(model, 10, 0.4 * small.allowed(), small).is_sensitive());
}

TEST(SensitivityTest, AnErrorThatGrowsBeyondWhatPartedIsNotExcusedForEver) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    sensitivity.begin(10);
    const double parted = 0.6 * error_of(model, 11, 1).error();
    const auto see = [&](std::uint32_t frame, double share) {
        const MotionError error = error_of(model, frame, share);
        sensitivity.saw(frame, std::vector{parted, 0.0}, error);
        return error;
    };
    see(11, 1);
    EXPECT_TRUE(sensitivity.excuses());
    for (std::uint32_t frame = 12; frame < 300; ++frame) see(frame, 8);
    EXPECT_FALSE(sensitivity.excuses());
    EXPECT_TRUE(sensitivity.is_sensitive());
    EXPECT_TRUE(sensitivity.runs()) << "what it excuses must be known";
    FrameEffort effort;
    note_motion(see(300, 8), sensitivity, effort);
    MotionWatch watch(model);
    watch.look(300, effort);
    ASSERT_TRUE(watch.worst());
    EXPECT_DOUBLE_EQ(watch.worst()->excused, parted);
    EXPECT_GT(watch.worst()->share(), 7);
}

TEST(SensitivityTest, WhereRunsPartAsFarAsTheErrorForHalfASecondNothingMoreIsToldOfIt) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    sensitivity.begin(10);
    std::uint32_t frame = 10;
    while (!sensitivity.is_lost() && frame < 1000) {
        ++frame;
        const MotionError error = error_of(model, frame, 2);
        sensitivity.saw(frame, std::vector{(frame == 20 ? 0.1 : 1.2) * error.error(), 0.0}, error);
    }
    EXPECT_EQ(frame, 35u) << "25 frames after the first; what parted is held for a moment, as the error is";
    EXPECT_FALSE(sensitivity.runs());
    FrameEffort effort;
    note_motion(error_of(model, frame, 2), sensitivity, effort);
    EXPECT_TRUE(std::isnan(effort.position_error));
    EXPECT_TRUE(effort.sensitive);
}

TEST(SensitivityTest, ARunThatDoesNotPartEndsAndMayBeginAgainLater) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    sensitivity.begin(10);
    std::uint32_t frame = 10;
    while (sensitivity.runs() && frame < 1000) {
        ++frame;
        sensitivity.saw(frame, std::vector{1e-6, 1e-6}, error_of(model, frame, 2));
    }
    EXPECT_EQ(frame, 60u) << "a second, at 50 frames per second";
    EXPECT_FALSE(sensitivity.is_sensitive());
    EXPECT_FALSE(sensitivity.begins(frame + 50, error_of(model, frame + 50, 2), true));
    EXPECT_TRUE(sensitivity.begins(frame + 150, error_of(model, frame + 150, 2), true));
}

/// A stiff sheet that stands upright leaves its place by a factor of e in a quarter of a second.
TEST(SensitivityTest, ARunThatPartsSlowlyGoesOn) {
    const SimulationModel model(two_cloths());
    Sensitivity sensitivity(model);
    sensitivity.begin(0);
    std::uint32_t frame = 0;
    while (sensitivity.undecided() && frame < 1000) {
        ++frame;
        const double parted = 1e-6 * std::exp(4 * frame / model.scene.time.fps);
        sensitivity.saw(frame, std::vector{parted, 0.0}, error_of(model, frame, 1e-3));
    }
    EXPECT_GT(frame, 100u);
    EXPECT_TRUE(sensitivity.is_sensitive());
}

FrameEffort effort_of(double error, double allowed) {
    FrameEffort effort;
    effort.position_error = error;
    effort.position_allowed = allowed;
    return effort;
}

TEST(MotionWatchTest, TheWorstFrameIsStatedAndNotTheLast) {
    const SimulationModel model(two_cloths());
    MotionWatch watch(model);
    EXPECT_FALSE(watch.worst());
    watch.look(0, {});
    watch.look(1, effort_of(4e-3, 0.01));
    EXPECT_TRUE(watch.warnings().empty());
    for (std::uint32_t frame = 2; frame <= 9; ++frame) watch.look(frame, effort_of(0.02 + 1e-3 * frame, 0.01));
    watch.look(10, effort_of(5e-3, 0.02));
    ASSERT_TRUE(watch.worst());
    EXPECT_EQ(watch.worst()->frame, 9u);
    const std::vector<std::string> warnings = watch.warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], testing::HasSubstr("at frame 9 positions are about 29 mm from the exact motion"));
    EXPECT_THAT(warnings[0], testing::HasSubstr("8 frames are beyond it"));
}

TEST(MotionWatchTest, WhatPartedIsSaidWithBothFigures) {
    const SimulationModel model(two_cloths());
    MotionWatch watch(model);
    FrameEffort effort = effort_of(0.02, 0.01);
    effort.sensitive = true;
    effort.parted = 0.015;
    watch.look(7, effort);
    EXPECT_TRUE(watch.warnings().empty()) << "15 of 20 mm are excused, 10 allowed";
    EXPECT_THAT(watch.note().value_or(""), testing::HasSubstr("from frame 7 on: runs that are equally exact had parted "
                                                              "by 15 mm there, of the 20 mm"));
    effort.position_error = 0.2;
    watch.look(8, effort);
    ASSERT_EQ(watch.warnings().size(), 1u);
    EXPECT_THAT(watch.warnings()[0], testing::HasSubstr("about 2e+02 mm"));
    EXPECT_THAT(watch.warnings()[0], testing::HasSubstr("beside the 15 mm by which"));
}

TEST(MotionWatchTest, FramesThatAreKeptOverTheMotionsLimitAreSaid) {
    const SimulationModel model(two_cloths());
    MotionWatch watch(model);
    for (const double times : {0.9, 1.1, 4.9, 2.0}) {
        FrameEffort effort;
        effort.motion_error = times * 0.02;
        effort.motion_allowed = 0.02;
        watch.look(static_cast<std::uint32_t>(10 * times), effort);
    }
    ASSERT_EQ(watch.warnings().size(), 1u);
    EXPECT_THAT(watch.warnings()[0], testing::HasSubstr("3 frames were kept"));
    EXPECT_THAT(watch.warnings()[0], testing::HasSubstr("4.9 times as fast at frame 49"));
}

TEST(MotionWatchTest, AStateThatOnlyADisturbedRunLeavesStandsOnAPoint) {
    const SimulationModel model(two_cloths());
    MotionWatch watch(model);
    FrameEffort effort = effort_of(4e-5, 0.01);
    effort.sensitive = true;
    effort.parted = 5e-3;
    watch.look(31, effort);
    ASSERT_EQ(watch.warnings().size(), 1u);
    EXPECT_THAT(watch.warnings()[0], testing::HasSubstr("at frame 31 the run stands on a point"));
    EXPECT_FALSE(watch.note());
    ByteWriter writer;
    watch.transfer(writer);
    const std::vector<std::byte> bytes = writer.take();
    MotionWatch other(model);
    ByteReader reader(bytes);
    EXPECT_TRUE(other.transfer(reader));
    EXPECT_EQ(other.warnings(), watch.warnings());
}

/// A sheet that starts flat, from its middle along u and v; gravity points down y.
SceneDescription flat_sheet(const Vec3& u, const Vec3& v) {
    SceneDescription scene = two_cloths();
    scene.cloths.pop_back();
    scene.cloths[0].placement = {{0, 1, 0}, u, v};
    scene.cloths[0].pins.clear();
    return scene;
}

TEST(BalanceTest, UprightClothStandsOnlyAsHighAsItsBendingHoldsIt) {
    SceneDescription scene = flat_sheet({1, 0, 0}, {0, -1, 0});
    const auto normal = [&] { return stands_upright(SimulationModel(scene), 0); };
    EXPECT_FALSE(normal()) << "it falls freely";
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    EXPECT_FALSE(normal()) << "it hangs";
    scene.cloths[0].pins = {test::pin_box(0, 7, 8, 7)};
    ASSERT_TRUE(normal());
    EXPECT_NEAR(std::abs((*normal())[2]), 1, 1e-12);
    // Greenhill: B = w h^3/7.837 holds the height h.
    const Cloth& cloth = scene.cloths[0];
    const double height = cloth.size[1], weight = cloth.areal_density * 9.81;
    const double holds = weight * height * height * height / 7.837;
    scene.cloths[0].stiffness.bend = 1.01 * holds;
    EXPECT_FALSE(normal());
    scene.cloths[0].stiffness.bend = 0.99 * holds;
    EXPECT_TRUE(normal());
    scene.wind.velocity = {0, 0, 1};
    EXPECT_FALSE(normal());
}

/// Returns what the watch warns of in a run by line of 1.2 s.
std::vector<std::string> warned(SceneDescription scene) {
    scene.solver = {.method = SolverMethod::line, .substeps = 10};
    const SimulationModel model(scene);
    Watch watch(model);
    Twin twin(model);
    for (std::uint32_t frame = 0; frame <= 72; ++frame) {
        if (frame > 0) twin.run_frame(frame);
        const auto record = twin_statistics(model, 0, twin.cloth(0), frame_inputs(model, frame));
        watch.implausible(frame, {cloth_statistics(model, model.cloths[0], record)});
    }
    return watch.warnings();
}

TEST(BalanceTest, WhatStandsUprightByANamedMethodIsWarnedOf) {
    SceneDescription scene = flat_sheet({1, 0, 0}, {0, -1, 0});
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_box(0, 7, 8, 7)};
    cloth.stiffness = {.stretch = 1e5, .shear = 1e4};  // a softer one still swings in its plane
    EXPECT_THAT(warned(scene), testing::ElementsAre(testing::HasSubstr("stands at rest in its plane until frame 72")));
    cloth.placement.jitter = 1e-3;
    EXPECT_THAT(warned(scene), testing::IsEmpty()) << "it fell";
    cloth.placement.jitter = 0;
    cloth.pins = {test::pin_top(cloth)};
    EXPECT_THAT(warned(scene), testing::IsEmpty()) << "it hangs";
}

TEST(BalanceTest, UprightClothIsInBalanceAndHangingClothIsNot) {
    SceneDescription scene = flat_sheet({1, 0, 0}, {0, -1, 0});
    const auto balanced = [&] { return starts_in_balance(SimulationModel(scene)); };
    EXPECT_FALSE(balanced()) << "it falls freely";
    scene.cloths[0].pins = {test::pin_box(0, 7, 8, 7)};
    EXPECT_TRUE(balanced()) << "on its lower edge";
    scene.cloths[0].pins = {test::pin_box(0, 3, 8, 3)};
    EXPECT_TRUE(balanced()) << "its upper half is";
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    EXPECT_FALSE(balanced());
    scene.cloths[0].pins[0].path.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.1, 0, 0}, {0, 0, 0}}};
    EXPECT_FALSE(balanced()) << "it moves as a whole";
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 7), test::pin_box(8, 0, 8, 7)};
    EXPECT_FALSE(balanced());
    scene.cloths[0].pins[1].path.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {1, {-0.1, 0, 0}, {0, 0, 0}}};
    EXPECT_TRUE(balanced()) << "it is pushed together in its plane";
    scene.wind.velocity = {0, 0, 1};
    EXPECT_FALSE(balanced()) << "wind blows it over";
    scene.wind.velocity = {};
    scene.cloths[0].placement.jitter = 1e-3;
    EXPECT_FALSE(balanced());
    scene.cloths[0].placement.jitter = 0;
    scene.cloths[0].pins = {test::pin_box(0, 7, 8, 7)};
    scene.cloths[0].placement.v = {0, -0.995, 0.0998749};
    EXPECT_FALSE(balanced()) << "it leans";
}

TEST(BalanceTest, LevelClothAboveTheMiddleOfACollider) {
    SceneDescription scene = flat_sheet({1, 0, 0}, {0, 0, 1});
    const auto balanced = [&](Collider collider) {
        scene.colliders = {std::move(collider)};
        return starts_in_balance(SimulationModel(scene));
    };
    EXPECT_TRUE(balanced({Sphere{{0.5, 0.3, 0.25}, 0.2}}));
    EXPECT_FALSE(balanced({Sphere{{0.9, 0.3, 0.25}, 0.2}})) << "it slides off";
    EXPECT_FALSE(balanced({Plane{}}));
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0)};
    EXPECT_FALSE(balanced({Sphere{{0.5, 0.3, 0.25}, 0.2}}));
}

}  // namespace
}  // namespace drape
