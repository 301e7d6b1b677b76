// Members of an ensemble by method auto go together where they want the same substeps, and stay their scenes alone, to
// the bit, whatever each is judged to need.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ensemble_members.h"
#include "library_device.h"

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
using EnsembleAutoTest = test::LibraryTest;

constexpr std::uint32_t seed = 91;

SceneDescription auto_scene(std::vector<std::string> overrides = {}) {
    overrides.insert(overrides.begin(), "/solver={\"method\": \"auto\"}");
    return scene_of(overrides);
}

TEST_F(EnsembleAutoTest, MembersAreAsAlone) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    expect_each_as_alone(drawn(auto_scene(), 6, seed), 14, true);
}

TEST_F(EnsembleAutoTest, SixtyFourMembersAreAsAlone) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    expect_each_as_alone(drawn(auto_scene(), 64, seed + 1), 14, true);
}

/// Some need more substeps than others, and frames are done again in some alone.
TEST_F(EnsembleAutoTest, EachHasTheSubstepsThatItNeeds) {
    std::vector<SceneDescription> members = drawn(auto_scene(), 5, seed);
    for (std::size_t k = 0; k < members.size(); ++k) {
        members[k].cloths[0].stiffness.stretch = 50 * std::pow(8.0, static_cast<double>(k) / 2);
        members[k].wind.velocity[2] = 3.0 * static_cast<double>(k);
    }
    expect_each_as_alone(members, 14, true);
    Ensemble ensemble(members, {}, library_device());
    std::set<std::uint32_t> substeps;
    for (int frame = 0; frame < 13; ++frame) {
        ensemble.step();
        for (std::size_t k = 0; k < members.size(); ++k) substeps.insert(ensemble.effort(k).substeps);
    }
    EXPECT_GT(substeps.size(), 3u);
}

TEST_F(EnsembleAutoTest, OfSeveralClothsWithoutEstimates) {
    SceneDescription scene = auto_scene({"/solver/estimate_error=false"});
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].placement.origin[2] += 1;
    scene.cloths.push_back(scene.cloths[1]);
    scene.cloths[2].name = "third";
    scene.cloths[2].grid = {9, 20};
    scene.cloths[2].holes = {{{4, 3}, {6, 7}}};
    scene.cloths[2].pins.resize(1);
    expect_each_as_alone(drawn(scene, 4, seed), 8, true);
}

TEST_F(EnsembleAutoTest, WhereGravityChangesAndCollidersRest) {
    std::vector<SceneDescription> members = drawn(auto_scene(), 4, seed);
    double more = 0;
    for (SceneDescription& member : members) {
        member.gravity_keys = {{0.01, member.gravity}, {0.08, {2 + more, -3, 1}}};
        more += 1;
    }
    for (Collider& collider : members[2].colliders) collider.path = {};
    expect_each_as_alone(members, 10, true);
}

TEST_F(EnsembleAutoTest, ResetAndRestoredMembersGoOnToTheSameBits) {
    expect_reset_and_restored(drawn(auto_scene(), 5, seed));
}

TEST_F(EnsembleAutoTest, AMemberThatDivergesLeavesTheOthersAsTheyAre) {
    std::vector<SceneDescription> members = drawn(auto_scene(), 4, seed);
    Ensemble right(members, {}, library_device());
    members[1].cloths[0].velocity = {1e36, 0, 0};
    Ensemble ensemble(members, {}, library_device());
    for (int frame = 0; frame < 6; ++frame) right.step(), ensemble.step();
    ASSERT_TRUE(ensemble.failure(1).has_value());
    for (const std::size_t k : {0u, 2u, 3u}) {
        EXPECT_FALSE(ensemble.failure(k).has_value());
        EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), k), of_member(right.positions(0), k)));
    }
}

/// Members for which auto chooses another method go apart from the others.
TEST_F(EnsembleAutoTest, MembersOfSeveralMethods) {
    std::vector<SceneDescription> members = drawn(auto_scene(), 5, seed);
    for (const std::size_t k : {1u, 4u}) {
        members[k].cloths[0].areal_density = 20;
        members[k].gravity = {0, -0.01, 0};
        members[k].wind.velocity = {0, 0, 0.1};
        members[k].wind.gust.amplitude = 0.01;
        members[k].cloths[0].velocity = {};
        members[k].cloths[0].pins[0].path.keys[1].translate = {0, 0, 0.001};
        members[k].cloths[0].stiffness.stretch = 100;
    }
    std::set<std::string> methods;
    for (const SceneDescription& member : members)
        methods.insert(Simulation(member, {}, library_device()).facts().method);
    EXPECT_GT(methods.size(), 1u);
    expect_each_as_alone(members, 8, true);
}

TEST_F(EnsembleAutoTest, TooManyMembersAreRefusedWithHowManyFit) {
    const std::vector<SceneDescription> members(3000, auto_scene({"/cloths/0/grid=[128,128]"}));
    try {
        const Ensemble made(members, {}, library_device());
        FAIL() << made.size();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(" fit"));
    }
}

}  // namespace
}  // namespace drape
