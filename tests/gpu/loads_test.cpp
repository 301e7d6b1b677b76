// Loads of members of ensembles: each as alone, by actions as by the scene, saved and restored; what is told wrongly is
// refused.
#include "support/loads.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "ensemble_members.h"
#include "library_device.h"

namespace drape {
namespace {

using test::library_device;
using test::of_member;
using test::press;
using test::pull;
using test::same_bytes;
using testing::HasSubstr;
using MemberLoadsTest = test::LibraryTest;

constexpr std::uint32_t seed = 78;
const EnsembleControls controls{.loads = true};

/// Sheets that a corner's weight and a pressure on some rows load.
std::vector<SceneDescription> loaded(const std::string& method, std::size_t count) {
    std::vector<SceneDescription> members = test::drawn(test::scene_by(method), count, seed);
    for (std::size_t k = 0; k < count; ++k)
        members[k].cloths[0].loads = {pull({{0, 11}, {0, 11}}, Vec3{0, -0.01 * static_cast<double>(k + 1), 0}),
                                      press({{0, 4}, {11, 11}}, static_cast<double>(k))};
    return members;
}

TEST_F(MemberLoadsTest, MembersAreAsAlone) {
    for (const std::string& method : test::every_method) {
        SCOPED_TRACE(method);
        test::expect_each_as_alone(loaded(method, 3), 6, true);
    }
}

/// The forces on members, loads among them, are those on each alone.
TEST_F(MemberLoadsTest, ForcesOnMembersAreAsAlone) {
    for (const std::string& method : test::every_method) {
        SCOPED_TRACE(method);
        std::vector<SceneDescription> members = loaded(method, 3);
        for (SceneDescription& member : members) member.forces = true;
        test::expect_each_as_alone(members, 6, true);
    }
}

TEST_F(MemberLoadsTest, ActionsAreTheScenesLoadsToTheBit) {
    for (const std::string method : {"line", "explicit", "relax"}) {
        SCOPED_TRACE(method);
        const std::vector<SceneDescription> wanted = loaded(method, 2);
        // The steps are made for the loads of time 0, so those are the same.
        std::vector<SceneDescription> told = wanted;
        for (SceneDescription& member : told)
            member.cloths[0].loads[0].force_keys = {{0, member.cloths[0].loads[0].force}, {0.001, {3, 3, 3}}};
        Ensemble own(wanted, {.controls = controls}, library_device());
        Ensemble acted(told, {.controls = controls}, library_device());
        const std::vector<double> loads{0, -0.01, 0, 0, 0, 0, 0, -0.02, 0, 1, 0, 0};
        for (int frame = 1; frame <= 6; ++frame) {
            own.step();
            acted.step(frame == 1 ? EnsembleActions{.loads = loads} : EnsembleActions{});
            for (std::size_t k = 0; k < 2; ++k)
                ASSERT_TRUE(same_bytes(of_member(own.positions(0), k), of_member(acted.positions(0), k)))
                    << "member " << k << ", frame " << frame;
        }
    }
}

TEST_F(MemberLoadsTest, SavedMembersAreLoadedAsTheyWere) {
    Ensemble ensemble(loaded("line", 2), {.controls = controls}, library_device());
    const std::size_t zero[] = {0};
    const std::vector<double> first{0, 0.1, 0, 2, 0, 0, 0, 0, 0, 3, 0, 0},
        second{0, -0.1, 0, -2, 0, 0, 0, 0, 0, 0, 0, 0};
    ensemble.step({.loads = first});
    const SimulationState saved = ensemble.save(0);
    ensemble.step();
    const std::vector<float> kept = of_member(ensemble.positions(0), 0);
    ensemble.step({.loads = second});
    ensemble.restore(zero, std::span(&saved, 1));
    ensemble.step();
    EXPECT_TRUE(same_bytes(of_member(ensemble.positions(0), 0), kept));
}

TEST_F(MemberLoadsTest, WhatIsToldWronglyIsRefused) {
    Ensemble ensemble(loaded("line", 2), {.controls = controls}, library_device());
    std::vector<double> loads(12);
    const auto refusal = [&](const EnsembleActions& actions) -> std::string {
        try {
            ensemble.step(actions);
        } catch (const ActionError& error) {
            return error.what();
        }
        return "nothing";
    };
    loads[7] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal({.loads = loads}), HasSubstr("member 1: loads: number 1 is nan"));
    loads[7] = 0;
    loads[10] = 2;
    EXPECT_THAT(refusal({.loads = loads}), HasSubstr("member 1: loads: number 4 is 2, expected 0 after a pressure"));
    EXPECT_EQ(ensemble.frame(0), 0u);
    std::vector<SceneDescription> plain = loaded("line", 1);
    plain[0].cloths[0].loads.clear();
    EXPECT_THROW(Ensemble(plain, {.controls = controls}, library_device()), Error);
    std::vector<SceneDescription> unlike = loaded("line", 2);
    unlike[1].cloths[0].loads[0].particles = {{1, 11}, {1, 11}};
    try {
        Ensemble refused(unlike, {}, library_device());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("/cloths/0/loads"));
    }
}

}  // namespace
}  // namespace drape
