// The watch knows what a scene can do to its cloth, and lets nothing beyond pass for a result.
#include "control/watch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "base/vectors.h"
#include "support/watched_sheet.h"

namespace drape {
namespace {

using test::hanging;
using test::resting;
using test::said;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(WatchTest, WhatHangsAtRestIsPlausible) { EXPECT_THAT(said(hanging(), 60, resting()), IsEmpty()); }

TEST(WatchTest, HeldClothDoesNotFallFasterTheLongerItHangs) {
    ClothStatistics fast = resting();
    fast.largest_speed = 90;  // 10 x 2 sqrt(9.81 sqrt(2)) = 74.5
    fast.potential_energy -= 0.1;
    EXPECT_THAT(said(hanging(), 6000 / 60, fast), HasSubstr("m/s, where at most 74.6 m/s are explained"));
    SceneDescription free = hanging();
    free.cloths[0].pins.clear();
    EXPECT_THAT(said(free, 6000 / 60, fast), IsEmpty());  // 10 x 16 m/s
}

TEST(WatchTest, PinsCollidersAndWindExplainSpeed) {
    ClothStatistics fast = resting();
    fast.largest_speed = 200;
    fast.potential_energy -= 0.1;
    EXPECT_THAT(said(hanging(), 60, fast), HasSubstr("m/s are explained"));
    SceneDescription windy = hanging(), pulled = hanging(), pushed = hanging();
    windy.wind.velocity = {20, 0, 0};
    pulled.cloths[0].pins[0].path.keys = {{0.0, {0, 0, 0}, {0, 0, 0}}, {1.0, {20, 0, 0}, {0, 0, 0}}};
    pushed.colliders.push_back({Sphere{}});
    pushed.colliders[0].path.keys = {{0.0, {0, 0, 0}, {0, 0, 0}}, {1.0, {10, 0, 0}, {0, 0, 0}}};
    for (const SceneDescription& scene : {windy, pulled, pushed}) EXPECT_THAT(said(scene, 60, fast), IsEmpty());
    fast.largest_speed = 1e5;
    for (const SceneDescription& scene : {windy, pulled, pushed})
        EXPECT_THAT(said(scene, 60, fast), HasSubstr("moves at 1e+05 m/s"));
}

TEST(WatchTest, ContactMovesWeightlessClothFromWhatItStartsTooNearTo) {
    SceneDescription alone = hanging();
    alone.cloths[0].pins.clear();
    alone.gravity = {0, 0, 0};
    ClothStatistics lifted = resting();
    lifted.potential_energy = 0;
    lifted.largest_speed = 0.2;  // cloth led out at 0.1 m/s takes its neighbours along
    EXPECT_THAT(said(alone, 1, lifted), HasSubstr("moves at 0.2 m/s, where at most 0.1 m/s are explained"));
    lifted.kinetic_energy = 0.5 * 0.1 * 0.1;
    SceneDescription on_ball = alone, on_itself = alone;
    on_ball.colliders.push_back({Sphere{}});
    on_itself.cloths[0].self_collision = SelfCollision{};
    for (const SceneDescription& scene : {on_ball, on_itself}) EXPECT_THAT(said(scene, 1, lifted), IsEmpty());
    lifted.largest_speed = 1.2;
    EXPECT_THAT(said(on_ball, 1, lifted), HasSubstr("where at most 1.1 m/s are explained"));
}

TEST(WatchTest, LongRunsAreJudgedAsIfAllTheirFramesWereRemembered) {
    SceneDescription scene = hanging();
    scene.time.frame_count = 1000;
    scene.cloths[0].pins[0].path.keys = {{0, {0, 0, 0}, {}}, {3, {5, 0, 0}, {}}, {12, {0, 0, 0}, {}}};
    const SimulationModel model(scene);
    Watch one(model);
    std::set<double> told;
    for (const std::uint32_t frame : {0u, 100u, 163u, 100u, 99u, 900u, 901u, 838u, 5u, 6u, 400u}) {
        const double expected = Watch(model).excess(frame, {resting()});
        EXPECT_EQ(one.excess(frame, {resting()}), expected) << frame;
        told.insert(expected);
    }
    EXPECT_GT(told.size(), 3u);  // the pin's way so far counts
}

TEST(WatchTest, NoParticleLeavesWhatItsClothReaches) {
    ClothStatistics far = resting();
    far.largest_distance = 6;  // the farthest starts sqrt(2) m off, and twice the diagonal is 2.86 m
    EXPECT_THAT(said(hanging(), 60, far), HasSubstr("is 6 m from the origin"));
    far.largest_distance = 4;
    EXPECT_THAT(said(hanging(), 60, far), IsEmpty());
}

TEST(WatchTest, EnergyDoesNotComeFromNowhere) {
    ClothStatistics lively = resting();
    lively.kinetic_energy = 2;
    EXPECT_THAT(said(hanging(), 60, lively), HasSubstr("the cloth has gained 2 J"));
    lively.potential_energy -= 1;
    EXPECT_THAT(said(hanging(), 60, lively), IsEmpty());  // a tenth of m g d = 1.39 J
    lively.kinetic_energy = 50;
    SceneDescription windy = hanging();
    windy.wind.velocity = {20, 0, 0};
    EXPECT_THAT(said(windy, 60, lively), IsEmpty());
}

/// Two or three cloths of random masses and speeds, free in space, that meet.
SceneDescription meeting(std::mt19937& random) {
    std::uniform_real_distribution<double> exponent(-2, 1), speed(5, 15);
    SceneDescription scene = hanging();
    scene.gravity = {0, 0, 0};
    scene.cloths[0].pins.clear();
    scene.cloths[0].self_collision = SelfCollision{};
    scene.cloths.resize(2 + random() % 2, scene.cloths[0]);
    for (std::size_t k = 0; k < scene.cloths.size(); ++k) {
        Cloth& cloth = scene.cloths[k];
        cloth.name = fmt::format("cloth {}", k);
        cloth.placement.origin[2] = static_cast<double>(k);
        cloth.areal_density = std::pow(10, exponent(random));
        cloth.velocity = {0, 0, random() % 2 == 0 ? speed(random) : -speed(random)};
    }
    return scene;
}

/// All of the kinetic energy that the cloths start with, `more` times, is one cloth's.
std::vector<ClothStatistics> given_to_one(const SceneDescription& scene, std::size_t index, double more) {
    std::vector<ClothStatistics> all;
    double energy = 0;
    for (const Cloth& cloth : scene.cloths) {
        all.push_back(resting());
        all.back().mass = cloth.areal_density;
        all.back().potential_energy = 0;
        energy += 0.5 * cloth.areal_density * dot(cloth.velocity, cloth.velocity);
    }
    all[index].kinetic_energy = more * energy;
    return all;
}

TEST(WatchTest, WhatOneClothGivesAnotherIsNoGain) {
    std::mt19937 random(48);
    for (int draw = 0; draw < 100; ++draw) {
        SceneDescription scene = meeting(random);
        const std::size_t index = random() % scene.cloths.size();
        const SimulationModel model(scene);
        EXPECT_FALSE(Watch(model).implausible(60, given_to_one(scene, index, 1))) << draw;
        const auto found = Watch(model).implausible(60, given_to_one(scene, index, 1.5));
        ASSERT_TRUE(found) << draw;
        EXPECT_EQ(found->cloth, index);
        EXPECT_THAT(found->what, HasSubstr("it and the cloths that it meets or is sewn to have gained"));
        for (Cloth& cloth : scene.cloths) cloth.self_collision.reset();
        const SimulationModel apart(scene);  // these go through each other, and each has only its own
        EXPECT_TRUE(Watch(apart).implausible(60, given_to_one(scene, index, 10))) << draw;
    }
}

TEST(WatchTest, AHeavyClothThrowsALightOneAtTwiceItsSpeed) {
    std::mt19937 random(7);
    for (int draw = 0; draw < 100; ++draw) {
        SceneDescription scene = meeting(random);
        scene.cloths.resize(2);
        scene.cloths[0].areal_density = 1, scene.cloths[1].areal_density = 1e-3;
        scene.cloths[1].velocity = {0, 0, 0};
        const double speed = 2 * length(scene.cloths[0].velocity);
        std::vector<ClothStatistics> thrown = given_to_one(scene, 0, 0.99);
        thrown[1].largest_speed = speed;
        thrown[1].largest_distance = 2 + speed;  // one second later
        thrown[1].kinetic_energy = 0.5e-3 * speed * speed;
        const SimulationModel model(scene);
        EXPECT_FALSE(Watch(model).implausible(60, thrown)) << draw;
        thrown[1].largest_speed = 20 * speed + 100;
        EXPECT_THAT(Watch(model).implausible(60, thrown).value_or(Implausible{}).what, HasSubstr("moves at"));
    }
}

TEST(WatchTest, StretchErrorsBeyondAnyUseAreNoResult) {
    ClothStatistics stretched = resting();
    stretched.stretch_error_rms = 0.3;
    EXPECT_THAT(said(hanging(), 1, stretched), HasSubstr("a stretch error of 0.3 RMS"));
    SceneDescription asked = hanging();
    asked.solver.tolerance = 0.4;
    EXPECT_THAT(said(asked, 1, stretched), IsEmpty());
    stretched.stretch_error_rms = 0.1;
    stretched.stretch_error_max = 2.2;
    EXPECT_THAT(said(hanging(), 1, stretched), HasSubstr("a spring whose stretch error is 2.2"));
}

TEST(WatchTest, WhatRestsIsExplainedByForces) {
    ClothStatistics locked = resting();
    locked.stretch_error_max = 0.4;
    EXPECT_THAT(said(hanging(), 60, locked), HasSubstr("stretch error is 0.4 of its length (bound 0.333), though"));
    locked.largest_speed = 0.015;  // m/s, of a diagonal of 1.41 m
    EXPECT_THAT(said(hanging(), 60, locked), IsEmpty());
    locked.largest_speed = 0;
    EXPECT_THAT(said(hanging(), 0, locked), IsEmpty());
    locked.stretch_error_max = 0.3;
    EXPECT_THAT(said(hanging(), 60, locked), IsEmpty());
    SceneDescription asked = hanging();
    asked.solver.tolerance = 0.5;
    locked.stretch_error_max = 0.4;
    EXPECT_THAT(said(asked, 60, locked), IsEmpty());
}

/// Returns what is said of `frame`, the last with these stretch errors, or "before" if it is of an earlier one.
std::string said_in_the_end(const SceneDescription& scene, std::uint32_t frame, const std::vector<double>& errors) {
    const SimulationModel model(scene);
    Watch watch(model);
    ClothStatistics statistics = resting();
    statistics.largest_speed = 1;
    const auto first = frame + 1 - static_cast<std::uint32_t>(errors.size());
    for (std::uint32_t k = 0; k < errors.size(); ++k) {
        statistics.stretch_error_max = errors[k];
        const auto found = watch.implausible(first + k, {statistics});
        if (found) return first + k == frame ? found->what : "before";
    }
    return {};
}

TEST(WatchTest, StretchThatLastsIsNoResult) {
    SceneDescription scene = hanging();  // 4 edges, so Lambda = 1.1e-4 at 40 substeps
    scene.solver.substeps = 40;
    const std::vector<double> lasting(6, 0.07), longer(7, 0.07), snap{0.01, 0.9, 0.9, 0.9, 0.9, 0.9, 0.01};
    EXPECT_THAT(said_in_the_end(scene, 60, lasting),
                HasSubstr("is 0.07 or more of their length for six frames (bound 0.06)"));
    EXPECT_EQ(said_in_the_end(scene, 60, longer), "before");
    EXPECT_THAT(said_in_the_end(scene, 60, snap), IsEmpty());
    EXPECT_THAT(said_in_the_end(scene, 60, std::vector<double>(6, 0.05)), IsEmpty());
    SceneDescription coarse = scene;  // Lambda 0.17
    coarse.solver.substeps = 1;
    EXPECT_THAT(said_in_the_end(coarse, 60, std::vector<double>(6, 0.12)), IsEmpty());
    EXPECT_THAT(said_in_the_end(coarse, 60, std::vector<double>(6, 0.13)), HasSubstr("for six frames (bound 0.123)"));
    SceneDescription driven = coarse;  // 5 m/s in the mean
    driven.cloths[0].pins[0].path.keys = {{0.0, {0, 0, 0}, {0, 0, 0}}, {1.0, {5, 0, 0}, {0, 0, 0}}};
    EXPECT_THAT(said_in_the_end(driven, 60, std::vector<double>(6, 0.2)), IsEmpty());
    EXPECT_THAT(said_in_the_end(driven, 60, std::vector<double>(6, 0.45)), HasSubstr("for six frames (bound 0."));
    SceneDescription windy = coarse;
    windy.wind.velocity = {20, 0, 0};
    EXPECT_THAT(said_in_the_end(windy, 60, std::vector<double>(6, 0.13)), IsEmpty());
}

TEST(WatchTest, WhatMeetsItselfMayBePressedTogether) {
    SceneDescription scene = hanging();
    scene.solver.substeps = 40;
    scene.cloths[0].self_collision = SelfCollision{};
    EXPECT_THAT(said_in_the_end(scene, 60, std::vector<double>(6, 0.29)), IsEmpty());
    EXPECT_THAT(said_in_the_end(scene, 60, std::vector<double>(6, 0.31)), HasSubstr("(bound 0.3)"));
}

/// Returns the first frame that is no result, of frames with these stretch errors in turn; nothing: all are results.
std::optional<std::uint32_t> first_failed(const SceneDescription& scene, std::uint32_t count,
                                          const std::vector<double>& errors, std::vector<std::string>* warnings = {}) {
    const SimulationModel model(scene);
    Watch watch(model);
    ClothStatistics statistics = resting();
    statistics.largest_speed = 1;
    for (std::uint32_t frame = 1; frame < count; ++frame) {
        statistics.stretch_error_max = errors[frame % errors.size()];
        if (watch.implausible(frame, {statistics})) return frame;
    }
    if (warnings) *warnings = watch.warnings();
    return std::nullopt;
}

TEST(WatchTest, NoVerdictDependsOnWhereTheSceneEnds) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> moved(0, 6), error(0, 1);
    int failed = 0;
    for (int draw = 0; draw < 60; ++draw) {
        SceneDescription scene = hanging();
        scene.solver.substeps = static_cast<std::uint32_t>(1 + random() % 20);
        scene.cloths[0].pins[0].path.keys = {{0, {}, {}}, {moved(random) + 0.1, {moved(random), 0, 0}, {}}};
        std::vector<double> errors(1 + random() % 900);
        const double most = error(random);
        for (double& each : errors) each = most * error(random);
        scene.time.frame_count = 900;
        const auto expected = first_failed(scene, 900, errors);
        failed += expected ? 1 : 0;
        for (const std::uint32_t count : {1u, 7u, 60u, 400u, 899u}) {
            scene.time.frame_count = count;
            const auto found = first_failed(scene, count, errors);
            EXPECT_EQ(found, expected && *expected < count ? expected : std::nullopt) << draw << ", " << count;
        }
    }
    EXPECT_GT(failed, 5);
    EXPECT_LT(failed, 60);
}

TEST(WatchTest, StretchLastsNoLongerThanWhatMovesTheCloth) {
    SceneDescription scene = hanging();
    scene.solver.substeps = 1;  // bound 0.123 where nothing moves
    scene.time.frame_count = 2000;
    scene.cloths[0].pins[0].path.keys = {{0, {}, {}}, {2, {10, 0, 0}, {}}};
    EXPECT_FALSE(first_failed(scene, 2000, {0.12}));
    std::vector<double> errors(2000, 0.2);
    std::fill_n(errors.begin(), 120, 0.1);
    EXPECT_EQ(first_failed(scene, 2000, errors), 60 * 7 + 1);
    EXPECT_FALSE(first_failed(scene, 2000, {0.2, 0.2, 0.2, 0.2, 0.2, 0.1}));
    scene.cloths[0].pins[0].path.keys.clear();
    EXPECT_EQ(first_failed(scene, 2000, {0.2}), 6u);
}

TEST(WatchTest, WhatHasNotSettledInTheEndIsWarnedOf) {
    SceneDescription scene = hanging();
    scene.solver.substeps = 40;
    std::vector<std::string> warnings;
    EXPECT_FALSE(first_failed(scene, 99, {0.01, 0.07}, &warnings));
    EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr(
                              "cloth 'sheet' has not settled when the run ends, in frame 98: in the last frames the "
                              "stretch error of a spring comes to 0.07 of its length")));
    EXPECT_FALSE(first_failed(scene, 99, {0.05}, &warnings));
    EXPECT_THAT(warnings, IsEmpty());
}

/// A sheet falls on a floor; its cells are 0.25 m, its thickness 5 mm.
SceneDescription falling_on_a_floor() {
    SceneDescription scene = hanging();
    scene.cloths[0].pins.clear();
    scene.colliders.push_back({Plane{{0, 1, 0}, -5}});
    return scene;
}

TEST(WatchTest, PenetrationIsBoundedByWhatExplainsIt) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int draw = 0; draw < 100; ++draw) {
        SceneDescription scene = falling_on_a_floor();
        scene.solver.substeps = static_cast<std::uint32_t>(1 + random() % 20);
        const double speed = 300 * uniform(random), start = uniform(random) < 0.5 ? 0 : 20 * uniform(random);
        scene.cloths[0].velocity = {0, -speed, 0};
        std::get<Plane>(scene.colliders[0].shape).offset = start - 1;  // the lower edge starts at y = -1
        const SimulationModel model(scene);
        ClothStatistics deep = resting();
        deep.kinetic_energy = 0.5 * speed * speed;
        deep.potential_energy -= 0.1;
        deep.penetration = start + 0.3 + speed / (60 * scene.solver.substeps);
        EXPECT_FALSE(Watch(model).implausible(1, {deep})) << draw;
        EXPECT_LE(Watch(model).excess(1, {deep}), 1);
        deep.penetration = start + 1 + 3 * (speed + 2) / (60 * scene.solver.substeps);
        EXPECT_THAT(Watch(model).implausible(1, {deep}).value_or(Implausible{}).what,
                    HasSubstr("m deep in what colliders keep free, where at most"))
            << draw;
        EXPECT_GT(Watch(model).excess(1, {deep}), 1);
    }
}

TEST(WatchTest, PenetrationBeyondATenthOfACellIsWarnedOf) {
    const SimulationModel model(falling_on_a_floor());
    const auto warned = [&](const std::vector<double>& depths) {
        Watch watch(model);
        ClothStatistics statistics = resting();
        for (std::uint32_t frame = 0; frame < depths.size(); ++frame) {
            statistics.penetration = depths[frame];
            statistics.deepest = 7;
            EXPECT_FALSE(watch.implausible(frame, {statistics}));
        }
        return watch.warnings();
    };
    EXPECT_THAT(warned({0, 0.024, 0.024}), IsEmpty());
    EXPECT_THAT(warned({0.1, 0.1, 0.124}), IsEmpty());  // it starts so deep
    EXPECT_THAT(warned({0, 0.03, 0.04, 0.035}),
                testing::ElementsAre(HasSubstr("from frame 1 on cloth 'sheet' is deeper than 0.025 m in what colliders "
                                               "and its thickness keep free, up to 0.04 m in frame 2, the particle in "
                                               "column 2, row 1")));
}

TEST(WatchTest, FabricStretchedByHalfIsWarnedOfOnce) {
    const auto warned = [](const SceneDescription& scene, const std::vector<double>& strains, double error) {
        const SimulationModel model(scene);
        Watch watch(model);
        ClothStatistics statistics = resting();
        for (std::uint32_t frame = 0; frame < strains.size(); ++frame) {
            statistics.stretch.largest = strains[frame];
            statistics.stretch_error_max = error;
            watch.implausible(frame, {statistics});
        }
        return watch.warnings();
    };
    EXPECT_THAT(warned(hanging(), {0, 0.49, 0.49}, 0), IsEmpty());
    EXPECT_THAT(warned(hanging(), {0, 0.54, 0.54}, 0.05), IsEmpty());  // an error, which is judged as one
    EXPECT_THAT(warned(hanging(), {0, 0.6, 1.74, 0.6}, 0),
                testing::ElementsAre(HasSubstr("from frame 1 on springs of cloth 'sheet' are stretched by more than 50 "
                                               "%, up to 174 % in frame 2")));
    SceneDescription wide = hanging();
    wide.cloths[0].placement.scale = {2, 2};
    EXPECT_THAT(warned(wide, {1, 1, 0.9}, 0), IsEmpty());
}

TEST(WatchTest, WhatPinsHoldInAColliderIsAsDeepAsTheyAre) {
    SceneDescription scene = hanging();  // the top is at y = 0
    scene.colliders.push_back({Plane{{0, 1, 0}, 3}});
    const SimulationModel model(scene);
    ClothStatistics deep = resting();
    deep.penetration = 3.2;
    Watch watch(model);
    EXPECT_FALSE(watch.implausible(1, {deep}));
    scene.cloths[0].pins.clear();
    scene.colliders[0].shape = Plane{{0, 1, 0}, -2};
    const SimulationModel free(scene);
    EXPECT_TRUE(Watch(free).implausible(1, {deep}));
}

TEST(WatchTest, WhatPinsHoldStrainedIsTheScenesOwn) {
    SceneDescription held = hanging();
    held.cloths[0].placement.scale = {3, 1};  // along the top, which the pins hold
    held.time.frame_count = 1000;
    ClothStatistics statistics = resting();
    statistics.largest_speed = 1;
    statistics.stretch_error_max = 2;
    EXPECT_THAT(said(held, 900, statistics), IsEmpty());
    EXPECT_THAT(said(held, 999, statistics), IsEmpty());
    statistics.stretch_error_max = 2.1;
    EXPECT_THAT(said(held, 900, statistics), HasSubstr("(bound 2.02)"));
    held.cloths[0].placement.scale = {1, 3};
    EXPECT_THAT(said(held, 900, statistics), HasSubstr("(bound 1)"));
}

TEST(WatchTest, TheWorstOfTheClothsCounts) {
    SceneDescription scene = hanging();
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    const SimulationModel model(scene);
    Watch watch(model);
    ClothStatistics bad = resting();
    bad.largest_distance = 1e6;
    EXPECT_LE(watch.excess(60, {resting(), resting()}), 1);
    EXPECT_GT(watch.excess(60, {resting(), bad}), 1e5);
    EXPECT_GT(watch.excess(60, {bad, resting()}), 1e5);
    bad.farthest = 7;
    const auto found = watch.implausible(60, {resting(), bad});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->cloth, 1u);
    EXPECT_EQ(found->particle, 7u);
    EXPECT_EQ(found->criterion, "distance from the origin, m");
    EXPECT_EQ(found->value, 1e6);
    EXPECT_LT(found->bound, 10);
}

TEST(WatchTest, WhatOverflowedInSinglePrecisionIsJudgedByWhatItIsAtLeast) {
    ClothStatistics overflown = resting();
    overflown.largest_speed = std::numeric_limits<double>::infinity();
    const SimulationModel model(hanging());
    EXPECT_GT(Watch(model).excess(1, {overflown}), 1e15);
    SceneDescription heavy = hanging();
    heavy.gravity = {0, -3e38, 0};
    heavy.cloths[0].pins.clear();
    overflown.potential_energy = -1.5e38;
    const SimulationModel falling(heavy);
    EXPECT_LT(Watch(falling).excess(1, {overflown}), 1);
    // The stretch of springs whose length overflowed is no number.
    ClothStatistics torn = resting();
    torn.stretch_error_max = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(Watch(model).implausible(1, {torn}));
}

}  // namespace
}  // namespace drape
