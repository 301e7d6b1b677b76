// Which turns of a cloth nothing but air hinders follows from its pins and gravity.
#include "cloth/kept_turn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "cloth/momentum_causes.h"
#include "support/sheets.h"

namespace drape {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

std::optional<KeptTurn> turn_of_sheet(const SceneDescription& scene) {
    return kept_turn(scene, ClothGeometry(scene, scene.cloths[0], false));
}

SceneDescription held_by(std::vector<Pin> pins) {
    SceneDescription scene = test::sheet(7, 5, 0.6, 0.4, 4);
    scene.cloths[0].pins = std::move(pins);
    return scene;
}

TEST(KeptTurnTest, AFreeClothTurnsAboutAnyAxis) {
    const auto turn = turn_of_sheet(held_by({}));
    ASSERT_TRUE(turn);
    EXPECT_EQ(turn->about, (glsl::ivec2{3, 2}));
    EXPECT_FALSE(turn->turns_held());
    EXPECT_EQ(turn->until, 0);
}

TEST(KeptTurnTest, AFlagTurnsRoundItsPoleAndALoneCornerRoundGravity) {
    for (const Pin& pin : {test::pin_box(0, 0, 0, 4), test::pin_box(6, 0, 6, 0)}) {
        const auto turn = turn_of_sheet(held_by({pin}));
        ASSERT_TRUE(turn);
        EXPECT_EQ(turn->about.x, pin.particles.first[0]);
        EXPECT_NEAR(std::abs(turn->axis[1]), 1, 1e-12);
        EXPECT_FALSE(turn->any);
        EXPECT_EQ(turn->until, never);
    }
}

TEST(KeptTurnTest, GravityAcrossTheLineOfPinsHinders) {
    SceneDescription scene = held_by({test::pin_box(0, 0, 6, 0)});
    EXPECT_FALSE(turn_of_sheet(scene));
    scene.gravity = {0, 0, 0};
    ASSERT_TRUE(turn_of_sheet(scene));
    EXPECT_NEAR(std::abs(turn_of_sheet(scene)->axis[0]), 1, 1e-12);
    scene.gravity_keys = {{0, {2, 0, 0}}, {1, {0, 0, 0}}};
    EXPECT_TRUE(turn_of_sheet(scene));
    scene.gravity_keys.push_back({2, {0, 0, 1}});
    EXPECT_FALSE(turn_of_sheet(scene));
}

TEST(KeptTurnTest, WithoutGravityAClothTurnsAboutALonePinAnyhow) {
    SceneDescription scene = held_by({test::pin_box(2, 1, 2, 1)});
    scene.gravity = {0, 0, 0};
    const auto turn = turn_of_sheet(scene);
    ASSERT_TRUE(turn);
    EXPECT_TRUE(turn->any);
}

TEST(KeptTurnTest, PinsThatMoveHinderUntilTheyLetGo) {
    Pin moving = test::pin_box(0, 0, 0, 4);
    moving.path.keys = {{0, {0, 0, 0}, {}}, {1, {0, 1, 0}, {}}};
    EXPECT_FALSE(turn_of_sheet(held_by({moving})));
    moving.release = 0.5;
    const auto turn = turn_of_sheet(held_by({moving}));
    ASSERT_TRUE(turn);
    EXPECT_FALSE(turn->turns_held());
    EXPECT_EQ(turn->until, 0.5);
}

TEST(KeptTurnTest, ArmsAreMeasuredFromThePinThatLetsGoLast) {
    Pin first = test::pin_box(0, 0, 0, 1), last = test::pin_box(0, 2, 0, 4);
    first.release = 0.2, last.release = 0.7;
    const auto turn = turn_of_sheet(held_by({first, last}));
    ASSERT_TRUE(turn);
    EXPECT_EQ(turn->about, (glsl::ivec2{0, 2}));
    EXPECT_EQ(turn->until, 0.7);
}

TEST(KeptTurnTest, ClothInPiecesOrThatMayComeApartDoesNotTurnAsAWhole) {
    SceneDescription scene = held_by({});
    scene.cloths[0].holes = {{{2, 0}, {4, 3}}};
    EXPECT_TRUE(turn_of_sheet(scene)) << "the rows below the hole hold it together";
    scene.cloths[0].holes = {{{2, 0}, {4, 4}}};
    EXPECT_FALSE(turn_of_sheet(scene));
    scene.cloths[0].holes.clear();
    scene.cloths[0].tear = Tear{.strain = 0.1};
    EXPECT_FALSE(turn_of_sheet(scene));
}

/// Says what may change the angular momentum of a free sheet in space.
std::vector<std::string> causes(SolverMethod method, bool in_pieces = false) {
    SceneDescription scene = test::sheet(9, 9, 1, 1, 3, 7);
    scene.gravity = {0, 0, 0};
    scene.cloths[0].damping = 0;
    scene.cloths[0].pins.clear();
    scene.colliders.clear();
    scene.solver.method = method;
    if (in_pieces) scene.cloths[0].holes = {{{3, 0}, {5, 8}}};
    return momentum_causes(SimulationModel(scene), 0).angular_momentum_by;
}

TEST(MomentumCauses, OfAFreeSheetAreThoseOfItsMethod) {
    using testing::ElementsAre;
    EXPECT_THAT(causes(SolverMethod::explicit_steps), ElementsAre());
    EXPECT_THAT(causes(SolverMethod::line), ElementsAre());
    EXPECT_THAT(causes(SolverMethod::relax), ElementsAre());
    EXPECT_THAT(causes(SolverMethod::relax, true), ElementsAre("solver")) << "pieces have a turn each";
    EXPECT_THAT(causes(SolverMethod::line, true), ElementsAre("solver")) << "pieces have a turn each";
    EXPECT_THAT(causes(SolverMethod::automatic), ElementsAre("changes of the substeps"));
}

}  // namespace
}  // namespace drape
