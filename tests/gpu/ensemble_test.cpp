// A member of an ensemble is its scene alone, to the bit, whatever the others do; the seed that draws them is printed
// where a test fails.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ensemble_members.h"
#include "library_device.h"
#include "support/gas_scenes.h"

namespace drape {
namespace {

using test::drawn;
using test::expect_each_as_alone;
using test::expect_reset_and_restored;
using test::library_device;
using test::of_member;
using test::same_bytes;
using test::scene_of;
using testing::HasSubstr;
using EnsembleTest = test::LibraryTest;

constexpr std::uint32_t seed = 51;

TEST_F(EnsembleTest, MembersOfEveryMethodAreAsAlone) {
    for (const char* method : {"line", "explicit", "relax"}) {
        const SceneDescription scene = scene_of({fmt::format("/solver/method=\"{}\"", method)});
        SCOPED_TRACE(fmt::format("{}, seed {}", method, seed));
        expect_each_as_alone(drawn(scene, 7, seed), 8, true);
    }
}

TEST_F(EnsembleTest, SixtyFourMembersOfEveryMethodAreAsAlone) {
    for (const char* method : {"line", "explicit", "relax"}) {
        const SceneDescription scene = scene_of({fmt::format("/solver/method=\"{}\"", method)});
        SCOPED_TRACE(fmt::format("{}, seed {}", method, seed));
        expect_each_as_alone(drawn(scene, 64, seed + 1), 12, true);
    }
}

TEST_F(EnsembleTest, ScenesOfSeveralClothsWithHolesAndTethers) {
    SceneDescription scene = scene_of({"/solver/tethers=true"});
    scene.cloths[0].stiffness.rigid = true;
    scene.cloths[0].holes = {{{4, 3}, {8, 7}}};
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].placement.origin[2] += 1;
    Cloth third = scene.cloths[0];
    third.name = "third";
    third.grid = {9, 20};
    third.holes.clear();
    third.pins = {scene.cloths[0].pins[0]};
    scene.cloths.push_back(third);
    expect_each_as_alone(drawn(scene, 5, seed), 6, true);
}

/// Every member starts in a shape of its own, but all have the same maps.
TEST_F(EnsembleTest, OfGivenStartsAndMaps) {
    SceneDescription scene = scene_of();
    Cloth& cloth = scene.cloths[0];
    const std::size_t cells = std::size_t{cloth.grid[0] - 1} * (cloth.grid[1] - 1);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        cloth.cell_stiffness.push_back(0.25f + 0.75f * static_cast<float>(cell % 7) / 6);
        cloth.cell_density.push_back(1 + static_cast<float>(cell % 5));
    }
    for (std::uint32_t particle = 0; particle < cloth.grid[0] * cloth.grid[1]; ++particle) {
        cloth.particle_friction.push_back(static_cast<float>(particle % 4));
        cloth.particle_thickness.push_back(1.0f / static_cast<float>(1 + particle % 3));
    }
    std::vector<SceneDescription> members = drawn(scene, 4, seed);
    for (std::size_t k = 0; k < members.size(); ++k)
        for (std::uint32_t i = 0; i < cloth.grid[0] * cloth.grid[1]; ++i) {
            const std::uint32_t column = i % cloth.grid[0], row = i / cloth.grid[0];
            members[k].cloths[0].start.push_back(
                {0.04 * column - 0.4, 1.2 - 0.04 * row, 0.02 * std::sin(0.5 * column + static_cast<double>(k))});
        }
    expect_each_as_alone(members, 6, true);
    members[2].cloths[0].cell_density[3] = 9;
    EXPECT_THROW(Ensemble(members, {}, library_device()), Error);
    members[2] = members[0];
    members[2].cloths[0].particle_thickness[3] = 0.875f;
    EXPECT_THROW(Ensemble(members, {}, library_device()), Error);
}

TEST_F(EnsembleTest, WithoutWindAndColliders) {
    SceneDescription scene = scene_of({"/solver/substeps=3"});
    scene.colliders.clear();
    std::vector<SceneDescription> members = drawn(scene, 6, seed);
    for (SceneDescription& member : members) member.wind = {};
    expect_each_as_alone(members, 6, true);
}

/// Wind and gravity change, in each member otherwise; actions end the wind's keys, and a restored member has them
/// again.
TEST_F(EnsembleTest, InWeatherThatChanges) {
    std::vector<SceneDescription> members = drawn(scene_of(), 4, seed);
    double more = 0;
    for (SceneDescription& member : members) {
        member.gravity_keys = {{0.01, member.gravity}, {0.08, {2 + more, -3, 1}}};
        member.wind.keys = {{0, member.wind.velocity}, {0.1, {0, more, 5}}};
        more += 1;
    }
    expect_each_as_alone(members, 8, true);
    Ensemble fresh(members, {}, library_device()), ensemble(members, {.controls = {.wind = true}}, library_device());
    for (int frame = 0; frame < 3; ++frame) fresh.step(), ensemble.step();
    const SimulationState saved = ensemble.save(2);
    const std::vector<double> wind(3 * members.size(), 7.0);
    fresh.step();
    ensemble.step({.wind = wind});
    EXPECT_FALSE(same_bytes(of_member(ensemble.positions(0), 2), of_member(fresh.positions(0), 2)));
    const std::size_t two[] = {2};
    ensemble.restore(two, std::span(&saved, 1));
    ensemble.step();
    EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 2), of_member(fresh.positions(0), 2)));
}

/// In a scene whose gravity changes and that has no wind there is air once actions may move it.
TEST_F(EnsembleTest, ActionsMoveTheAirOfASceneWithoutWind) {
    SceneDescription scene = scene_of();
    scene.wind = {};
    scene.colliders.clear();
    scene.gravity_keys = {{0, {0, -9.81, 0}}, {0.1, {0, -5, 0}}};
    const std::vector<double> still{0, 0, 0}, strong{0, 0, 20};
    Ensemble airless({scene}, {}, library_device()), calm({scene}, {.controls = {.wind = true}}, library_device()),
        blown({scene}, {.controls = {.wind = true}}, library_device());
    for (int frame = 0; frame < 6; ++frame) {
        airless.step();
        calm.step({.wind = still});
        blown.step({.wind = strong});
    }
    EXPECT_FALSE(same_bytes(of_member(airless.positions(0), 0), of_member(calm.positions(0), 0)));
    EXPECT_FALSE(same_bytes(of_member(blown.positions(0), 0), of_member(calm.positions(0), 0)));
}

/// Some members' colliders move, others' rest.
TEST_F(EnsembleTest, OfMembersWhoseCollidersRestBesideOthers) {
    std::vector<SceneDescription> members = drawn(scene_of(), 4, seed);
    for (Collider& collider : members[2].colliders) collider.path = {};
    expect_each_as_alone(members, 8, true);
}

TEST_F(EnsembleTest, MembersThatShareNoDispatchesAreAsAlone) {
    std::vector<std::vector<std::string>> kinds = {
        {"/solver/method=\"auto\"", "/solver/tolerance_motion=1", "/cloths/0/self_collision={}"},
        {"/cutters=[{\"triangle\": [[-1, 0.7, -1], [1, 0.7, -1], [0, 0.7, 2]], \"active\": [0.02, 0.05]}]"},
        {"/cloths/0/tear={\"strain\": 0.02}"},
        {"/solver/estimate_error=true"},
        {"/colliders/meshes=[{\"file\": \"" DRAPE_SOURCE_DIR
         "/tests/scene/box.obj\", \"scale\": 0.3, \"position\": [-0.3, 0.6, 0.1]}]"}};
    // On a GPU such small cloth does all of its iterations, and shares them.
    if (library_device().info().type == "cpu")
        kinds.push_back({"/solver/method=\"relax\"", "/solver/iterations=4", "/solver/tolerance=0.2"});
    for (const std::vector<std::string>& overrides : kinds) {
        SCOPED_TRACE(overrides.front());
        expect_each_as_alone(drawn(scene_of(overrides), 3, seed), 6, false);
    }
}

TEST_F(EnsembleTest, MembersWhoseClothsCloseGasInAreAsAlone) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps}) {
        std::vector<SceneDescription> members(3, test::gas_cushion(method, 7, 8, 0.02));
        for (SceneDescription& member : members) member.time.frame_count = 8;
        for (std::size_t k = 0; k < members.size(); ++k) {
            test::blow_up(members[k], 0.004 + 0.001 * static_cast<double>(k), 0.1);
            members[k].gas[0].ambient *= 1 - 0.2 * static_cast<double>(k);
        }
        expect_each_as_alone(members, 6, false);
    }
}

/// Each has a shape of its own; one that is flat at rest cannot be among them.
TEST_F(EnsembleTest, OfMembersThatRestAsTheyStart) {
    std::vector<SceneDescription> members = drawn(scene_of(), 3, seed);
    for (std::size_t k = 0; k < members.size(); ++k) {
        Cloth& cloth = members[k].cloths[0];
        const double height = 0.03 + 0.02 * static_cast<double>(k);
        for (std::uint32_t row = 0; row < 12; ++row)
            for (std::uint32_t column = 0; column < 17; ++column)
                cloth.start.push_back(
                    {0.05 * column - 0.4, 0.9 - 0.04 * row + height * std::sin(0.6 * column), 0.04 * row});
        cloth.placement = {};
        cloth.rest = Rest::start;
    }
    expect_each_as_alone(members, 6, true);
    members[1].cloths[0].rest = Rest::flat;
    EXPECT_THAT([&] { Ensemble(members, {}, library_device()); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("/cloths/0/rest is flat, not start")));
}

TEST_F(EnsembleTest, TheNumberOfPassesIsThatOfOneMember) {
    const SceneDescription scene = scene_of();
    const Ensemble one(drawn(scene, 1, seed), {}, library_device()), many(drawn(scene, 40, seed), {}, library_device());
    EXPECT_GT(one.pass_count(), 10u);
    EXPECT_EQ(many.pass_count(), one.pass_count());
}

TEST_F(EnsembleTest, AMemberThatDivergesLeavesTheOthersAsTheyAre) {
    std::vector<SceneDescription> members = drawn(scene_of(), 4, seed);
    Ensemble right(members, {}, library_device());
    members[1].cloths[0].velocity = {1e36, 0, 0};
    Ensemble ensemble(members, {}, library_device());
    for (int frame = 0; frame < 10; ++frame) {
        right.step();
        ensemble.step();
    }
    ASSERT_TRUE(ensemble.failure(1).has_value());
    EXPECT_THAT(ensemble.failure(1)->reason, HasSubstr("cloth 'sheet'"));
    for (const std::size_t k : {0u, 2u, 3u}) {
        EXPECT_FALSE(ensemble.failure(k).has_value());
        EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), k), of_member(right.positions(0), k)));
    }
    // However many frames follow, it tells of the one that it failed in.
    const FrameFailure failure = *ensemble.failure(1);
    ensemble.step();
    EXPECT_EQ(ensemble.failure(1)->reason, failure.reason);
}

TEST_F(EnsembleTest, ResetAndRestoredMembersGoOnToTheSameBits) {
    for (const char* method : {"line", "explicit", "relax"}) {
        SCOPED_TRACE(method);
        expect_reset_and_restored(drawn(scene_of({fmt::format("/solver/method=\"{}\"", method)}), 5, seed));
    }
}

/// Controls that are never used change nothing.
TEST_F(EnsembleTest, WithoutActionsControlsChangeNoBit) {
    const std::vector<SceneDescription> members = drawn(scene_of(), 3, seed);
    Ensemble plain(members, {}, library_device());
    Ensemble controlled(members, {.controls = {.wind = true, .pins = true, .colliders = true}}, library_device());
    for (int frame = 0; frame < 8; ++frame) {
        plain.step();
        controlled.step();
    }
    for (std::size_t k = 0; k < members.size(); ++k)
        EXPECT_TRUE(same_bytes(of_member(plain.positions(0), k), of_member(controlled.positions(0), k)));
}

TEST_F(EnsembleTest, ActionsPutPinsAndCollidersWhereTheySay) {
    std::vector<SceneDescription> members = drawn(scene_of(), 3, seed);
    for (SceneDescription& member : members) member.cloths[0].pins[1].release.reset();
    Ensemble ensemble(members, {.controls = {.wind = true, .pins = true, .colliders = true}}, library_device());
    const std::vector<float> start = of_member(ensemble.positions(0), 2);
    std::vector<double> pins(3 * 2 * 6), wind(3 * 3);
    for (int frame = 1; frame <= 5; ++frame) {
        pins[2 * 12 + 0] = 0.01 * frame;       // member 2, the first pin: along x
        pins[2 * 12 + 6 + 1] = -0.01 * frame;  // its second: down
        ensemble.step({.wind = wind, .pins = pins});
    }
    const std::vector<float> now = of_member(ensemble.positions(0), 2);
    const std::size_t right = 4 * 16;
    EXPECT_NEAR(now[0], start[0] + 0.05, 1e-6);
    EXPECT_NEAR(now[1], start[1], 1e-6);
    EXPECT_NEAR(now[right + 1], start[right + 1] - 0.05, 1e-6);
    // It goes there at constant speed: half of the way is half of the step's.
    const std::vector<float> velocity = of_member(ensemble.velocities(0), 2);
    EXPECT_NEAR(velocity[0], 0.01 * 60, 1e-4);
    // Without another action it stays.
    for (int frame = 0; frame < 3; ++frame) ensemble.step();
    const std::vector<float> later = of_member(ensemble.positions(0), 2);
    EXPECT_EQ(later[0], now[0]);
    EXPECT_EQ(later[right + 1], now[right + 1]);
    // A saved state knows of that.
    const SimulationState saved = ensemble.save(2);
    const std::size_t two[] = {2};
    ensemble.step();
    const std::vector<float> next = of_member(ensemble.positions(0), 2);
    ensemble.reset(two);
    ensemble.restore(two, std::span(&saved, 1));
    ensemble.step();
    EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 2), next));
}

TEST_F(EnsembleTest, ActionsThatCannotBeTakenLeaveEveryMemberWhereItIs) {
    const std::vector<SceneDescription> members = drawn(scene_of(), 3, seed);
    Ensemble ensemble(members, {.controls = {.wind = true, .pins = true}}, library_device());
    ensemble.step();
    const std::vector<float> before = of_member(ensemble.positions(0), 0);
    const auto refused = [&](const EnsembleActions& actions) -> std::pair<std::string, std::size_t> {
        try {
            ensemble.step(actions);
        } catch (const ActionError& error) {
            return {error.what(), error.member()};
        }
        return {"nothing", 99};
    };
    std::vector<double> wind(9), pins(3 * 12), few(5);
    wind[4] = std::numeric_limits<double>::quiet_NaN();
    const auto [text, member] = refused({.wind = wind});
    EXPECT_THAT(text, HasSubstr("member 1: wind: number 1 is nan"));
    EXPECT_EQ(member, 1u);
    pins[35] = 1e300;
    EXPECT_THAT(refused({.pins = pins}).first, HasSubstr("member 2: pins: number 11 is 1e+300"));
    EXPECT_THAT(refused({.wind = few}).first, HasSubstr("wind has 5 numbers, 3 members with 3 each are 9"));
    EXPECT_THAT(refused({.colliders = pins}).first, HasSubstr("made without control of colliders"));
    EXPECT_EQ(ensemble.frame(0), 1u);
    EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 0), before));
}

std::string refusal(const std::vector<SceneDescription>& members, const EnsembleOptions& options = {}) {
    try {
        Ensemble(members, options, library_device());
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST_F(EnsembleTest, MembersOfUnlikeShapeAreRefusedWithTheReason) {
    std::vector<SceneDescription> members = drawn(scene_of(), 3, seed);
    members[2].cloths[0].grid = {18, 12};
    EXPECT_THAT(refusal(members),
                HasSubstr("member 2 is of another shape than member 0: /cloths/0/grid is 18 x 12, not 17 x 12"));
    members = drawn(scene_of(), 2, seed);
    members[1].colliders.pop_back();
    EXPECT_THAT(refusal(members), HasSubstr("/colliders is "));
    members = drawn(scene_of(), 2, seed);
    members[1].solver.substeps = 5;
    EXPECT_THAT(refusal(members), HasSubstr("/solver/substeps is 5, not 4"));
    members = drawn(scene_of(), 2, seed);
    members[1].wind = {};
    EXPECT_THAT(refusal(members), HasSubstr("/wind is none, not blowing"));
    members = drawn(
        scene_of({"/gravity_keys=[{\"t\": 0, \"gravity\": [0, 0, 0]}, {\"t\": 1, \"gravity\": [0, 1, 0]}]"}), 2, seed);
    members[1].gravity_keys.clear();
    EXPECT_THAT(refusal(members), HasSubstr("/gravity_keys is steady, not changing"));
    EXPECT_THAT(refusal({}), HasSubstr("needs a member"));
}

TEST_F(EnsembleTest, TooManyMembersAreRefusedBeforeAnythingIsMade) {
    const std::uint64_t used = library_device().memory_used();
    const SceneDescription large = scene_of({"/cloths/0/grid=[512,512]"});
    const std::string text = refusal(std::vector<SceneDescription>(3000, large));
    const std::size_t at = text.find("MiB left: ");
    ASSERT_NE(at, std::string::npos) << text;
    const auto fit = std::stoul(text.substr(at + 10));
    EXPECT_GT(fit, 2u) << text;
    EXPECT_THAT(refusal(std::vector<SceneDescription>(fit + 1, large)), HasSubstr(" fit"));
    EXPECT_EQ(library_device().memory_used(), used);
}

TEST_F(EnsembleTest, PicturesAreThoseOfTheMemberAlone) {
    std::vector<SceneDescription> members = drawn(scene_of({"/image={\"size\": [96, 64], \"samples\": 1}"}), 3, seed);
    Ensemble ensemble(members, {}, library_device());
    for (int frame = 0; frame < 4; ++frame) ensemble.step();
    Simulation alone(members[1], {.draw = true}, library_device());
    for (int frame = 0; frame < 5; ++frame) alone.step();
    const auto own = ensemble.picture(1);
    const auto& other = alone.frame().rgba;
    ASSERT_EQ(own.size(), 96u * 64 * 4);
    EXPECT_TRUE(std::ranges::equal(own, other));
}

}  // namespace
}  // namespace drape
