// Members of an ensemble whose cloth meets itself share dispatches and stay their scenes alone, to the bit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "ensemble_members.h"
#include "library_device.h"
#include "simulation/state_checksum.h"

namespace drape {
namespace {

using test::drawn;
using test::expect_each_as_alone;
using test::expect_reset_and_restored;
using test::library_device;
using test::of_member;
using test::same_bytes;
using test::scene_of;
using EnsembleContactTest = test::LibraryTest;

constexpr std::uint32_t seed = 77;
constexpr double spacing = 0.05;
constexpr std::uint32_t columns = 12, rows = 13;

/// Returns where a sheet's particles are that is folded over once, so that its upper half falls on the lower one, with
/// rows that slide over each other by `askew`.
std::vector<std::array<double, 3>> folded_once(double askew) {
    std::vector<std::array<double, 3>> places;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const bool upper = row > rows / 2;
            const double along = spacing * (upper ? rows - row : row), above = upper ? spacing : 0;
            places.push_back({spacing * column + (upper ? askew * along : 0), 0.31 + above, along});
        }
    return places;
}

/// Draws members that each fall together in folds of their own, on a floor.
std::vector<SceneDescription> folded(std::size_t count, const std::vector<std::string>& overrides = {}) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(random);
    };
    SceneDescription scene = scene_of(overrides);
    Cloth& cloth = scene.cloths[0];
    cloth.grid = {columns, rows};
    cloth.pins.clear();
    cloth.self_collision = SelfCollision{};
    cloth.size = {spacing * (columns - 1), spacing * (rows - 1)};
    scene.colliders[1].shape = Plane{{0, 1, 0}, 0.3};
    scene.solver.substeps = 6;
    std::vector<SceneDescription> members = drawn(scene, count, seed);
    for (SceneDescription& member : members) {
        Cloth& own = member.cloths[0];
        own.size = scene.cloths[0].size;
        own.placement = {};
        own.start = folded_once(between(-0.3, 0.3));
        own.velocity = {between(-0.1, 0.1), 0, between(-0.1, 0.1)};
        own.self_collision->thickness = between(0.01, 0.02);
        own.self_collision->friction = between(0, 0.8);
        own.thickness = between(0.002, 0.008);
        member.wind.velocity = {0, between(-3, -1), 0};
    }
    return members;
}

/// Returns whether contact of cloth with itself changes every member within so many frames.
bool all_meet(const std::vector<SceneDescription>& members, int frames) {
    std::vector<SceneDescription> through = members;
    for (SceneDescription& member : through)
        for (Cloth& cloth : member.cloths) cloth.self_collision.reset();
    Ensemble meeting(members, {}, library_device()), other(through, {}, library_device());
    for (int frame = 0; frame < frames; ++frame) meeting.step(), other.step();
    for (std::size_t k = 0; k < members.size(); ++k)
        if (same_bytes(of_member(meeting.positions(0), k), of_member(other.positions(0), k))) return false;
    return true;
}

TEST_F(EnsembleContactTest, MembersOfEveryMethodAreAsAlone) {
    for (const char* method : {"line", "explicit", "relax"}) {
        SCOPED_TRACE(fmt::format("{}, seed {}", method, seed));
        const auto members = folded(5, {fmt::format("/solver/method=\"{}\"", method)});
        EXPECT_TRUE(all_meet(members, 12));
        expect_each_as_alone(members, 13, true);
    }
}

TEST_F(EnsembleContactTest, SixtyFourMembersOfEveryMethodAreAsAlone) {
    for (const char* method : {"line", "explicit", "relax"}) {
        SCOPED_TRACE(fmt::format("{}, seed {}", method, seed));
        expect_each_as_alone(folded(64, {fmt::format("/solver/method=\"{}\"", method)}), 16, true);
    }
}

/// Two cloths of one shape and one of another fall on each other, some of them held, with maps of how they meet.
TEST_F(EnsembleContactTest, OfSeveralClothsWithHolesPinsAndMaps) {
    std::vector<SceneDescription> members = folded(4);
    for (SceneDescription& member : members) {
        Cloth second = member.cloths[0];
        second.name = "second";
        for (auto& place : second.start) place[1] += 0.12;
        Cloth third = second;
        third.name = "third";
        third.grid = {20, 9};
        third.size = {0.5, 0.3};
        third.start.clear();
        third.placement.origin = {0, 0.5, 0};
        third.placement.v = {0, 0, 1};
        third.holes = {{{4, 3}, {8, 5}}};
        third.self_collision.reset();
        third.pins = {scene_of().cloths[0].pins[0]};
        for (std::uint32_t i = 0; i < 20 * 9; ++i) {
            third.particle_friction.push_back(static_cast<float>(i % 4));
            third.particle_thickness.push_back(1.0f / static_cast<float>(1 + i % 3));
        }
        member.cloths.push_back(second);
        member.cloths.push_back(third);
    }
    EXPECT_TRUE(all_meet(members, 10));
    expect_each_as_alone(members, 14, true);
}

/// Cloth that is pressed to a stack of many layers meets itself in more places than lists have room for at first.
TEST_F(EnsembleContactTest, ListsGrowAndChangeNoBit) {
    std::vector<SceneDescription> members = folded(3, {"/solver/estimate_error=false"});
    for (SceneDescription& member : members) {
        Cloth& cloth = member.cloths[0];
        cloth.self_collision->thickness = 0.005;
        for (std::uint32_t i = 0; i < cloth.start.size(); ++i) {
            const std::uint32_t column = i % columns, row = i / columns;
            cloth.start[i] = {spacing * (column % 2), 0.32 + 0.0006 * column, spacing * row};
        }
        cloth.stiffness.stretch = 20;
        cloth.stiffness.shear = 2;
    }
    const std::uint64_t used = library_device().memory_used();
    Ensemble ensemble(members, {}, library_device());
    const std::uint64_t before = library_device().memory_used() - used;
    ensemble.step();
    EXPECT_GT(library_device().memory_used() - used, before);
    expect_each_as_alone(members, 5, true);
}

TEST_F(EnsembleContactTest, ResetAndRestoredMembersGoOnToTheSameBits) {
    const auto members = folded(5, {"/solver/substeps=10"});
    EXPECT_TRUE(all_meet(members, 9));
    expect_reset_and_restored(members);
}

/// A state saved where pairs press on each other has what they bear.
TEST_F(EnsembleContactTest, StatesSavedInContactGoOnToTheSameBits) {
    const auto members = folded(3);
    Ensemble ensemble(members, {}, library_device());
    for (int frame = 0; frame < 12; ++frame) ensemble.step();
    const SimulationState saved[] = {ensemble.save(1), ensemble.save(2)};
    ASSERT_GT(saved[0].at("field/contact borne").size(), sizeof(float) * 8);
    std::vector<std::vector<float>> after;
    for (int frame = 0; frame < 3; ++frame) ensemble.step();
    for (const std::size_t k : {0u, 1u, 2u}) after.push_back(of_member(ensemble.positions(0), k));
    Ensemble fresh(members, {}, library_device());
    fresh.step();
    const std::size_t both[] = {1, 2}, first[] = {1};
    fresh.restore(both, saved);
    for (int frame = 0; frame < 3; ++frame) fresh.step();
    EXPECT_TRUE(same_bytes(of_member(fresh.positions(0), 1), after[1]));
    EXPECT_TRUE(same_bytes(of_member(fresh.positions(0), 2), after[2]));
    SimulationState wrong = saved[0];
    wrong["field/contact borne"].pop_back();
    seal(wrong);
    EXPECT_THROW(fresh.restore(first, std::span(&wrong, 1)), Error);
    wrong.erase("field/contact borne");
    seal(wrong);
    EXPECT_THROW(fresh.restore(first, std::span(&wrong, 1)), Error);
    EXPECT_TRUE(same_bytes(of_member(fresh.positions(0), 1), after[1]));
}

TEST_F(EnsembleContactTest, AMemberThatDivergesLeavesTheOthersAsTheyAre) {
    std::vector<SceneDescription> members = folded(4);
    Ensemble right(members, {}, library_device());
    members[1].cloths[0].velocity = {1e36, 0, 0};
    Ensemble ensemble(members, {}, library_device());
    for (int frame = 0; frame < 10; ++frame) right.step(), ensemble.step();
    ASSERT_TRUE(ensemble.failure(1).has_value());
    for (const std::size_t k : {0u, 2u, 3u}) {
        EXPECT_FALSE(ensemble.failure(k).has_value());
        EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), k), of_member(right.positions(0), k)));
    }
    const std::size_t failed[] = {1};
    ensemble.reset(failed);
    EXPECT_FALSE(ensemble.failure(1).has_value());
}

TEST_F(EnsembleContactTest, TheNumberOfPassesIsThatOfTwoMembers) {
    const Ensemble two(folded(2), {}, library_device()), many(folded(20), {}, library_device());
    EXPECT_GT(two.pass_count(), 50u);
    EXPECT_EQ(many.pass_count(), two.pass_count());
}

/// Cloths that start through each other are led apart, in some members alone.
TEST_F(EnsembleContactTest, MembersThatStartCrossedShareNothing) {
    std::vector<SceneDescription> members = folded(3);
    for (SceneDescription& member : members) {
        Cloth second = member.cloths[0];
        second.name = "second";
        for (auto& place : second.start) place[1] += 0.2;
        member.cloths.push_back(second);
    }
    for (auto& place : members[2].cloths[1].start)
        place = {place[0], place[1] - 0.2 + 0.01 * (place[2] - 0.15), place[2]};
    expect_each_as_alone(members, 4, false);
}

}  // namespace
}  // namespace drape
