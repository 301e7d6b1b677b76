// Members of ensembles let go, take and turn gravity as actions say: a release is the scene's to the bit, what is taken
// stays where it is and goes with the hand, and what is let go flies as it must.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ensemble_members.h"
#include "library_device.h"

namespace drape {
namespace {

using test::drawn;
using test::every_method;
using test::library_device;
using test::of_member;
using test::same_bytes;
using test::scene_by;
using test::scene_of;
using testing::HasSubstr;
using HandsTest = test::LibraryTest;

constexpr std::uint32_t seed = 77;
constexpr double fps = 60;

/// A sheet in a vacuum that nothing holds.
SceneDescription free_sheet(const std::string& method) {
    SceneDescription scene = scene_by(method);
    scene.wind = {};
    scene.colliders.clear();
    scene.cloths[0].pins.clear();
    scene.cloths[0].damping = 0;
    return scene;
}

Vec3 at(const MemberArray& array, std::size_t member, std::size_t column, std::size_t row) {
    const float* const from = array.data + member * array.member_stride + 4 * (row * array.columns + column);
    return {double{from[0]}, double{from[1]}, double{from[2]}};
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Frame by frame, the positions of a scene whose second pin lets go by itself after three frames, and those of one
/// that actions have let go.
void expect_same_release(const SceneDescription& by_itself, SceneDescription acted, const EnsembleControls& controls) {
    acted.cloths[0].pins[1].release.reset();
    Ensemble own({by_itself}, {.controls = controls}, library_device());
    Ensemble told({acted}, {.controls = {.holds = true}}, library_device());
    const std::vector<std::uint8_t> both{1, 1}, one{1, 0};
    for (int frame = 1; frame <= 8; ++frame) {
        own.step();
        told.step({.holds = frame <= 3 ? both : one});
        ASSERT_TRUE(same_bytes(of_member(own.positions(0), 0), of_member(told.positions(0), 0))) << frame;
    }
}

TEST_F(HandsTest, AReleaseByActionIsTheScenesToTheBit) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        SceneDescription scene = scene_by(method);
        scene.cloths[0].pins[1].release = 3 / fps;
        // By auto, a scene that takes no actions is judged over several frames at once.
        expect_same_release(scene, scene, {.holds = method == "auto"});
        scene.cloths[0].pins[1].path.keys = {{0, {}, {}}, {0.1, {-0.05, 0.1, 0.02}, {0, 20, 40}}};
        expect_same_release(scene, scene, {.holds = method == "auto"});
    }
}

/// A hand that held all of a cloth, moved and turned it lets go: then its centre of mass flies on a parabola.
TEST_F(HandsTest, WhatIsLetGoFallsFreeWithTheVelocityThatItHas) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        const SceneDescription scene = free_sheet(method);
        Ensemble ensemble({scene}, {.controls = {.hands = {0}}}, library_device());
        const Vec3 middle = ensemble.statistics(0)[0].center_of_mass, velocity{0.6, 1.2, -0.3};
        const std::vector<std::int32_t> all{0, 0, 16, 11}, none{-1, -1, -1, -1};
        std::vector<double> hand{middle[0], middle[1], middle[2], 0, 0, 0};
        ensemble.step({.hands = hand, .grasps = all});
        EXPECT_LT(distance(ensemble.statistics(0)[0].center_of_mass, middle), 1e-6);
        for (int frame = 0; frame < 4; ++frame) {
            for (std::size_t k = 0; k < 3; ++k) hand[k] += velocity[k] / fps;
            hand[4] += 2;
            ensemble.step({.hands = hand});
        }
        const Vec3 from = ensemble.statistics(0)[0].center_of_mass;
        EXPECT_LT(distance(from, {hand[0], hand[1], hand[2]}), 2e-6);
        for (int frame = 1; frame <= 6; ++frame) {
            ensemble.step({.grasps = none});
            const double time = frame / fps;
            Vec3 expected;
            for (std::size_t k = 0; k < 3; ++k)
                expected[k] = from[k] + velocity[k] * time + scene.gravity[k] * time * time / 2;
            EXPECT_LT(distance(ensemble.statistics(0)[0].center_of_mass, expected), 2e-5) << frame;
        }
        EXPECT_FALSE(ensemble.failure(0).has_value());
    }
}

/// Two hands take corners of cloth that falls. One turns about itself, so its particles go round it.
TEST_F(HandsTest, WhatIsTakenStaysWhereItIsAndGoesWithTheHand) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        SceneDescription scene = free_sheet(method);
        if (method == "explicit") scene.solver.substeps = 24;  // a single particle bears half of the cloth
        Ensemble ensemble({scene}, {.controls = {.hands = {0, 0}}}, library_device());
        for (int frame = 0; frame < 4; ++frame) ensemble.step();
        const Vec3 left = at(ensemble.positions(0), 0, 1, 1), right = at(ensemble.positions(0), 0, 16, 0);
        const std::vector<std::int32_t> corners{0, 0, 1, 1, 16, 0, 16, 0};
        const Vec3 center{left[0] + 0.03, left[1], left[2] - 0.01};
        std::vector<double> hands{center[0], center[1], center[2], 0, 0, 0, 0, 0, 0, 0, 0, 0};
        ensemble.step({.hands = hands, .grasps = corners});
        EXPECT_EQ(at(ensemble.positions(0), 0, 1, 1), left);
        EXPECT_EQ(at(ensemble.positions(0), 0, 16, 0), right);
        for (int frame = 1; frame <= 10; ++frame) {
            hands[5] = 3 * frame;
            hands[6 + 1] = 0.002 * frame;
            ensemble.step({.hands = hands});
        }
        const double angle = 30 * std::numbers::pi / 180, x = left[0] - center[0], y = left[1] - center[1];
        const Vec3 turned{center[0] + x * std::cos(angle) - y * std::sin(angle),
                          center[1] + x * std::sin(angle) + y * std::cos(angle), left[2]};
        EXPECT_LT(distance(at(ensemble.positions(0), 0, 1, 1), turned), 2e-6);
        EXPECT_LT(distance(at(ensemble.positions(0), 0, 16, 0), {right[0], right[1] + 0.02, right[2]}), 2e-6);
        EXPECT_LT(at(ensemble.positions(0), 0, 8, 11)[1], left[1]);
        EXPECT_FALSE(ensemble.failure(0).has_value()) << ensemble.failure(0)->reason;
    }
}

/// A pin of the scene lets go and takes its particle again: it has it where that fell, and moves it from there.
TEST_F(HandsTest, APinTakesItsParticleAgainWhereItIs) {
    SceneDescription scene = scene_by("line");
    scene.cloths[0].pins[0].path = {};
    scene.cloths[0].pins[1].release.reset();
    Ensemble ensemble({scene}, {.controls = {.pins = true, .holds = true}}, library_device());
    const Vec3 start = at(ensemble.positions(0), 0, 16, 0);
    const std::vector<std::uint8_t> both{1, 1}, one{1, 0};
    for (int frame = 0; frame < 6; ++frame) ensemble.step({.holds = one});
    const Vec3 fallen = at(ensemble.positions(0), 0, 16, 0);
    EXPECT_LT(fallen[1], start[1] - 0.01);
    std::vector<double> pins(12);
    pins[6] = 0.004;
    ensemble.step({.pins = pins, .holds = both});
    ensemble.step();
    EXPECT_LT(distance(at(ensemble.positions(0), 0, 16, 0), {fallen[0] + 0.004, fallen[1], fallen[2]}), 1e-6);
}

/// What a pin let go, by its scene's time or by an action, a hand may have from the next step on.
TEST_F(HandsTest, AHandTakesOverWhatPinsLetGo) {
    SceneDescription scene = scene_by("line");
    scene.cloths[0].pins[0].path = {};
    Ensemble ensemble({scene}, {.controls = {.holds = true, .hands = {0, 0}}}, library_device());
    const std::vector<std::uint8_t> none{0, 0};
    for (int frame = 0; frame < 5; ++frame) ensemble.step();  // the second pin lets go by itself at 0.06 s
    std::vector<double> hands(12, 0.2);
    std::vector<std::int32_t> grasps(8, -1);
    ensemble.step({.hands = hands});
    std::vector<Vec3> taken{at(ensemble.positions(0), 0, 0, 0), at(ensemble.positions(0), 0, 16, 0)};
    grasps[4] = grasps[6] = 16, grasps[5] = grasps[7] = 0;
    ensemble.step({.holds = none, .grasps = grasps});
    grasps[0] = grasps[1] = grasps[2] = grasps[3] = 0;
    taken[0] = at(ensemble.positions(0), 0, 0, 0);
    for (int frame = 0; frame < 4; ++frame) {
        hands[0] += 0.001, hands[6] -= 0.001;
        ensemble.step({.hands = hands, .grasps = grasps});
    }
    const Vec3 left = at(ensemble.positions(0), 0, 0, 0), right = at(ensemble.positions(0), 0, 16, 0);
    EXPECT_LT(distance(left, {taken[0][0] + 0.004, taken[0][1], taken[0][2]}), 1e-6);
    EXPECT_LT(distance(right, {taken[1][0] - 0.004, taken[1][1], taken[1][2]}), 1e-6);
}

/// Steps with actions that differ from member to member and from frame to frame.
struct Plan {
    std::size_t members;
    int frame;
    std::vector<double> hands, wind, gravity;
    std::vector<std::int32_t> grasps;
    Plan(const Ensemble& ensemble, int now, std::size_t first = 0) : members(ensemble.size()), frame(now) {
        for (std::size_t k = first; k < first + members; ++k) {
            const auto number = static_cast<double>(k);
            hands.insert(hands.end(), {0.3, 0.8 + 0.002 * frame * number, 0.002 * frame, 0, 3.0 * frame, 0});
            wind.insert(wind.end(), {number, 0, 1 - number});
            gravity.insert(gravity.end(), {0.1 * frame, -9 + number, 0});
            const bool holds = frame >= 2 && frame < 7 && k != 1;
            const auto column = static_cast<std::int32_t>(5 + k);
            if (holds)
                grasps.insert(grasps.end(), {column, 9, column + 1, 11});
            else
                grasps.insert(grasps.end(), 4, -1);
        }
    }
    EnsembleActions actions() const { return {.wind = wind, .gravity = gravity, .hands = hands, .grasps = grasps}; }
};

const EnsembleControls planned{.wind = true, .gravity = true, .hands = {0}};

TEST_F(HandsTest, MembersThatActAreAsAlone) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        const std::vector<SceneDescription> members = drawn(scene_by(method), 3, seed);
        Ensemble together(members, {.controls = planned}, library_device());
        std::vector<Ensemble> alone;
        for (const SceneDescription& member : members)
            alone.emplace_back(std::vector{member}, EnsembleOptions{.controls = planned}, library_device());
        for (int frame = 1; frame <= 9; ++frame) {
            together.step(Plan(together, frame).actions());
            for (std::size_t k = 0; k < members.size(); ++k) {
                alone[k].step(Plan(alone[k], frame, k).actions());
                ASSERT_TRUE(same_bytes(of_member(together.positions(0), k), of_member(alone[k].positions(0), 0)))
                    << "member " << k << ", frame " << frame;
            }
        }
    }
}

TEST_F(HandsTest, SavedAndResetMembersHoldWhatTheyHeld) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        Ensemble ensemble(drawn(scene_by(method), 2, seed), {.controls = planned}, library_device());
        const std::size_t zero[] = {0};
        std::vector<std::vector<float>> frames;
        SimulationState saved;
        for (int frame = 1; frame <= 8; ++frame) {
            ensemble.step(Plan(ensemble, frame).actions());
            if (frame == 4) saved = ensemble.save(0);
            frames.push_back(of_member(ensemble.positions(0), 0));
        }
        ensemble.restore(zero, std::span(&saved, 1));
        for (int frame = 5; frame <= 8; ++frame) {
            ensemble.step(Plan(ensemble, frame).actions());
            EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 0), frames[frame - 1])) << frame;
        }
        ensemble.reset(zero);
        for (int frame = 1; frame <= 3; ++frame) {
            ensemble.step(Plan(ensemble, frame).actions());
            EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 0), frames[frame - 1])) << frame;
        }
    }
}

/// What keys of a scene do at once, an action does too.
TEST_F(HandsTest, GravityByActionIsTheKeysToTheBit) {
    SceneDescription keyed = scene_by("line");
    const Vec3 later{3, -2, 1};
    keyed.gravity_keys = {{0, keyed.gravity}, {3 / fps - 1e-9, keyed.gravity}, {3 / fps, later}};
    Ensemble own({keyed}, {}, library_device());
    Ensemble told({scene_by("line")}, {.controls = {.gravity = true}}, library_device());
    const std::vector<double> turned{later[0], later[1], later[2]};
    for (int frame = 1; frame <= 8; ++frame) {
        own.step();
        told.step(frame == 4 ? EnsembleActions{.gravity = turned} : EnsembleActions{});
        ASSERT_TRUE(same_bytes(of_member(own.positions(0), 0), of_member(told.positions(0), 0))) << frame;
    }
}

/// By auto, cloth at which nothing happens for long is no longer simulated until an action.
TEST_F(HandsTest, AnActionWakesClothThatSleeps) {
    SceneDescription scene = free_sheet("auto");
    scene.time.fps = 10;
    scene.gravity = {};
    scene.cloths[0].placement.jitter = 0;
    Ensemble ensemble({scene}, {.controls = {.gravity = true}}, library_device());
    for (int frame = 0; frame < 14; ++frame) ensemble.step();
    EXPECT_TRUE(ensemble.effort(0).asleep);
    const double before = ensemble.statistics(0)[0].center_of_mass[1];
    const std::vector<double> down{0, -10, 0};
    ensemble.step({.gravity = down});
    // BDF2 follows a jump of what drives the cloth half a substep late.
    const double late = 0.1 / ensemble.effort(0).substeps, fell = before - ensemble.statistics(0)[0].center_of_mass[1];
    EXPECT_LE(fell, 5 * 0.1 * 0.1 + 1e-5);
    EXPECT_GE(fell, 5 * (0.1 - late) * (0.1 - late));
}

TEST_F(HandsTest, ActionsThatNobodyCanFollowAreRefusedAndNothingAdvances) {
    Ensemble ensemble(std::vector{scene_of(), scene_of()}, {.controls = {.pins = true, .holds = true, .hands = {0, 0}}},
                      library_device());
    const std::vector<std::int32_t> none(16, -1);
    std::vector<double> hands(24), pins(24);
    ensemble.step({.hands = hands});
    const std::vector<float> before = of_member(ensemble.positions(0), 1);
    const auto refused = [&](const EnsembleActions& actions) {
        try {
            ensemble.step(actions);
        } catch (const ActionError& error) {
            return fmt::format("{}: {}", error.member(), error.what());
        }
        return std::string("nothing");
    };
    const auto grasping = [&](std::vector<std::int32_t> hand, std::vector<std::int32_t> other = {-1, -1, -1, -1}) {
        std::vector<std::int32_t> all = none;
        std::ranges::copy(hand, all.begin() + 8);
        std::ranges::copy(other, all.begin() + 12);
        return all;
    };
    EXPECT_THAT(refused({.grasps = grasping({17, 3, 17, 3})}),
                HasSubstr("1: actions: member 1: grasps: hand 0: columns 17 to 17 of rows 3 to 3 are no particles"));
    EXPECT_THAT(refused({.grasps = grasping({4, 3, 3, 3})}), HasSubstr("no particles"));
    EXPECT_THAT(refused({.grasps = grasping({-2, 3, 3, 3})}), HasSubstr("no particles"));
    EXPECT_THAT(refused({.grasps = grasping({0, 0, 3, 3})}), HasSubstr("hand 0 takes what pin 0 holds"));
    EXPECT_THAT(refused({.grasps = grasping({4, 4, 6, 6}, {6, 6, 8, 8})}), HasSubstr("takes what hand "));
    const std::vector<std::uint8_t> too_few{1, 1, 1};
    EXPECT_THAT(refused({.holds = too_few}), HasSubstr("holds has 3 numbers"));
    pins[18] = 2;
    EXPECT_THAT(refused({.pins = pins}), HasSubstr("1: actions: member 1: pins: pin 1 holds cloth and jumps 2 m"));
    hands[13] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refused({.hands = hands}), HasSubstr("member 1: hands: number 1 is nan"));
    EXPECT_THAT(refused({.gravity = std::span(hands).first(6)}), HasSubstr("without control of gravity"));
    EXPECT_EQ(ensemble.frame(1), 1u);
    EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 1), before));
    // A hand that holds cloth neither jumps nor takes other particles at once.
    hands[13] = 0;
    ensemble.step({.grasps = grasping({4, 4, 6, 6})});
    EXPECT_THAT(refused({.grasps = grasping({4, 4, 6, 7})}), HasSubstr("hand 0 holds other particles"));
    hands[12] = 1.5;
    EXPECT_THAT(refused({.hands = hands}), HasSubstr("hands: hand 0 holds cloth and jumps 1.5 m"));
    EXPECT_EQ(ensemble.frame(1), 2u);
    Ensemble nowhere({scene_of()}, {.controls = {.hands = {0}}}, library_device());
    const std::vector<std::int32_t> one{4, 4, 4, 4};
    EXPECT_THROW(nowhere.step({.grasps = one}), ActionError);
    EXPECT_THROW(Ensemble({scene_of()}, {.controls = {.hands = {1}}}, library_device()), Error);
}

/// A sheet that hangs at rest in a vacuum from a hand at its right upper corner, and from a pin at its left one or from
/// another hand.
SceneDescription hung_up(const std::string& method) {
    SceneDescription scene = free_sheet(method);
    scene.forces = true;
    scene.gravity = {0, -9.81, 0};
    scene.cloths[0].damping = 12;
    scene.cloths[0].placement.v = {0, -1, 0};
    scene.cloths[0].placement.jitter = 0;
    if (method != "auto") scene.solver.substeps = method == "explicit" ? 60 : 12;
    return scene;
}

Vec3 force_of(const Ensemble& ensemble, const std::string& by) {
    for (const ForceOnCloth& each : ensemble.statistics(0)[0].forces)
        if (each.by == by) return each.force;
    ADD_FAILURE() << "no force by " << by;
    return {};
}

TEST_F(HandsTest, HandsBearTheWeightOfWhatTheyHold) {
    for (const std::string& method : every_method) {
        SCOPED_TRACE(method);
        const SceneDescription scene = hung_up(method);
        Ensemble ensemble({scene}, {.controls = {.hands = {0, 0}}}, library_device());
        const std::vector<double> hands(12);
        const std::vector<std::int32_t> corners{0, 0, 0, 0, 16, 0, 16, 0};
        ensemble.step({.hands = hands, .grasps = corners});
        for (int frame = 0; frame < 200; ++frame) ensemble.step();
        const double weight = 9.81 * ensemble.statistics(0)[0].mass;
        EXPECT_LT(distance(force_of(ensemble, "hands"), {0, weight, 0}), 1e-4 * weight);
    }
}

TEST_F(HandsTest, AHandBesideAPinBearsItsHalf) {
    for (const char* const method : {"line", "explicit"}) {
        SCOPED_TRACE(method);
        SceneDescription scene = hung_up(method);
        scene.cloths[0].pins = {{.particles = {{0, 0}, {0, 0}}}};
        Ensemble ensemble({scene}, {.controls = {.hands = {0}}}, library_device());
        const std::vector<double> hand(6);
        const std::vector<std::int32_t> corner{16, 0, 16, 0};
        ensemble.step({.hands = hand, .grasps = corner});
        for (int frame = 0; frame < 200; ++frame) ensemble.step();
        const double weight = 9.81 * ensemble.statistics(0)[0].mass;
        const Vec3 pin = force_of(ensemble, "pins_0"), other = force_of(ensemble, "hands");
        EXPECT_LT(distance({pin[0] + other[0], pin[1] + other[1], pin[2] + other[2]}, {0, weight, 0}), 1e-4 * weight);
        // Among pins it is split as far as rounded positions tell the strain.
        EXPECT_LT(distance(other, {-pin[0], pin[1], 0}), 3e-3 * weight);
    }
}

/// What nobody uses changes no bit.
TEST_F(HandsTest, IdleHandsChangeNoBit) {
    const std::vector<SceneDescription> members = drawn(scene_of(), 2, seed);
    Ensemble plain(members, {}, library_device());
    Ensemble idle(members, {.controls = {.holds = true, .hands = {0}}}, library_device());
    for (int frame = 0; frame < 8; ++frame) {
        plain.step();
        idle.step();
    }
    for (std::size_t k = 0; k < members.size(); ++k)
        EXPECT_TRUE(same_bytes(of_member(plain.positions(0), k), of_member(idle.positions(0), k)));
}

}  // namespace
}  // namespace drape
