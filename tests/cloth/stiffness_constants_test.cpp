// Spring constants follow docs/physics.md 1, and softening keeps explicit steps stable.
#include "cloth/stiffness_constants.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cloth/cloth_model.h"
#include "cloth/method_explicit.h"
#include "support/method_steps.h"
#include "support/sheets.h"

namespace drape {
namespace {

constexpr std::array square{0.01, 0.01}, oblong{0.02, 0.01};

TEST(StiffnessConstantsTest, FollowTheCells) {
    const StiffnessConstants constants = stiffness_constants({false, 1000, 100, 1e-4}, oblong);
    EXPECT_DOUBLE_EQ(constants.spring[0], 500);
    EXPECT_DOUBLE_EQ(constants.spring[1], 2000);
    EXPECT_DOUBLE_EQ(constants.spring[2], 125);
    EXPECT_DOUBLE_EQ(constants.spring[3], 125);
    EXPECT_DOUBLE_EQ(constants.rest_length[0], 0.02);
    EXPECT_DOUBLE_EQ(constants.rest_length[1], 0.01);
    EXPECT_DOUBLE_EQ(constants.rest_length[3], std::sqrt(5e-4));
    EXPECT_DOUBLE_EQ(constants.bend[0], 1e-4 * 0.01 / 8e-6);
    EXPECT_DOUBLE_EQ(constants.bend[1], 1e-4 * 0.02 / 1e-6);
    EXPECT_DOUBLE_EQ(constants.twist, 2e-4 / 2e-4);
}

TEST(ExplicitStiffnessTest, SmallStepsUseAllOfIt) {
    const double mass = 2e-5, h = 1e-5;
    const RelativeStiffness used =
        relative_stiffness(stiffness_constants({false, 1000, 100, 0}, square), square, mass, h, 0.2);
    EXPECT_FALSE(used.softened());
    EXPECT_DOUBLE_EQ(used.spring[0], 1000 * h * h / mass);
    EXPECT_DOUBLE_EQ(used.spring[3], 100 * h * h / mass);
}

TEST(ExplicitStiffnessTest, LargeStepsAreSoftenedToTheStatedLimit) {
    const double mass = 2e-5, h = 1e-3;
    for (const double kappa : {0.0, 0.2, 1.0}) {
        const RelativeStiffness used =
            relative_stiffness(stiffness_constants({false, 1000, 100, 0}, square), square, mass, h, kappa);
        // docs/solvers.md: K_s = 0.45 / ((1 + r_s)(1 + 2 kappa)), K_d = r_s K_s
        EXPECT_NEAR(used.spring[0], 0.45 / (1.1 * (1 + 2 * kappa)), 1e-12);
        EXPECT_NEAR(used.spring[1], used.spring[0], 1e-12);
        EXPECT_NEAR(used.spring[2], 0.1 * used.spring[0], 1e-12);
        // Steps as short as it asks for soften nothing.
        const double enough = h / used.full_substeps_factor * (1 - 1e-9);
        EXPECT_FALSE(relative_stiffness(stiffness_constants({false, 1000, 100, 0}, square), square, mass, enough, kappa)
                         .softened());
    }
}

TEST(ExplicitStiffnessTest, EachAxisIsSoftenedAsFarAsItMustBe) {
    const StiffnessConstants wanted = stiffness_constants({false, 1000, 100, 0}, oblong);
    const double mass = 4e-5;
    const double h =
        std::sqrt(0.45 * mass / 1000);  // the long cells' springs (500 N/m) still fit, the short ones' do not
    const RelativeStiffness used = relative_stiffness(wanted, oblong, mass, h, 0);
    EXPECT_EQ(used.columns_share, 1);
    EXPECT_LT(used.rows_share, 0.5);
    EXPECT_EQ(used.shear_share, used.rows_share);
}

TEST(ExplicitStiffnessTest, TheSceneSaysSo) {
    SceneDescription scene = test::sheet(101, 101, 1, 1, 20);
    scene.solver.method = SolverMethod::explicit_steps;
    const auto note = [](const SceneDescription& described) {
        const std::vector<Compromise> all = ClothModel(described, 0).scheme.compromises;
        return all.empty() ? std::string("none") : all[0].reason;
    };
    // K = k h^2/m = 1000 / 1200^2 / 2e-5 = 34.7 against 0.45 / (1.1 x 1.4) asks for 20 sqrt(118.8) = 218.01 substeps.
    EXPECT_EQ(note(scene),
              "explicit steps follow 8.42 N/m along columns, 8.42 along rows, 0.842 on diagonals and 0 N m of "
              "bending at 20 substeps; "
              "219 substeps would follow all of it");
    scene.solver.substeps = 219;
    EXPECT_EQ(note(scene), "none");
    scene.solver.substeps = 218;
    EXPECT_NE(note(scene), "none");
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_NE(note(scene).find("rigid springs are as stiff as the substeps allow"), std::string::npos);
}

TEST(BendStiffnessTest, RelaxationTakesOffWhatItsSweepAddsAndSaysWhatItFollows) {
    SceneDescription scene = test::sheet(65, 65, 1, 1, 20);
    Cloth& cloth = scene.cloths[0];
    const double cell = 1.0 / 64, mass = cloth.areal_density * cell * cell, h = 1.0 / 1200;
    const auto rigidity = [&](double compliance) { return mass * cell * cell / (compliance * h * h); };
    const auto note = [&] {
        const std::vector<Compromise> all = ClothModel(scene, 0).scheme.compromises;
        return all.empty() ? std::string("none") : all[0].reason;
    };
    cloth.stiffness.bend = rigidity(60);
    const ClothModel model(scene, 0);
    const auto bends = test::pushes<glsl::BendPush>(model.scheme);
    const auto twists = test::pushes<glsl::TwistPush>(model.scheme);
    ASSERT_EQ(bends.size(), 6u);
    ASSERT_EQ(twists.size(), 4u);
    EXPECT_FLOAT_EQ(bends[0].compliance, 57);
    EXPECT_FLOAT_EQ(twists[0].compliance, 28);  // twice as stiff as an axis: 60/2 - 2
    EXPECT_EQ(model.scheme.used_bend, cloth.stiffness.bend);
    EXPECT_EQ(note(), "none");
    cloth.stiffness.bend = rigidity(1);  // four times what a sweep can do on the twist: twice as many substeps
    const ClothModel softened(scene, 0);
    EXPECT_NEAR(softened.scheme.used_bend, rigidity(4), 1e-12);
    EXPECT_FLOAT_EQ(test::pushes<glsl::BendPush>(softened.scheme)[0].compliance,
                    1);  // the axes follow no more than the twist
    EXPECT_GT(test::pushes<glsl::TwistPush>(softened.scheme)[0].compliance, 0);
    EXPECT_LT(test::pushes<glsl::TwistPush>(softened.scheme)[0].compliance, 1e-6f);
    EXPECT_NE(note().find("40 substeps would follow all of it"), std::string::npos) << note();
    cloth.stiffness.bend = 0;
    EXPECT_TRUE(ClothModel(scene, 0).scheme.once.empty());
}

TEST(BendStiffnessTest, ExplicitStepsShareTheirLimitWithBending) {
    const double mass = 2e-5;
    for (const double bend : {1e-6, 1e-3, 1.0})
        for (const double h : {1e-5, 1e-4, 1e-3}) {
            const StiffnessConstants wanted = stiffness_constants({false, 1000, 100, bend}, square);
            const RelativeStiffness used = relative_stiffness(wanted, square, mass, h, 0.2);
            const double q = 4 * (used.bend[0] + used.bend[1] + used.twist), s = used.spring[0] + used.spring[2];
            EXPECT_LE(q, 0.3 * (1 + 1e-12));
            EXPECT_LE(1.4 * s + 0.5 * q, 0.45 * (1 + 1e-12));
            EXPECT_NEAR(used.bend[0], wanted.bend[0] * h * h / mass * used.bend_share, 1e-12);
            EXPECT_NEAR(used.twist, 2 * used.bend[0], 1e-12);  // square cells: softened alike
        }
}

}  // namespace
}  // namespace drape
