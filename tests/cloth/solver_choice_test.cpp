// `auto` chooses a method and says why.
#include "cloth/solver_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/frame_steps.h"
#include "control/motion_error.h"
#include "control/substep_control.h"
#include "support/sheets.h"

namespace drape {
namespace {

SceneDescription automatic(std::uint32_t links, double tolerance = 0) {
    SceneDescription scene = test::sheet(links + 1, links + 1, 1, 1, 3, 7);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.solver.method = SolverMethod::automatic;
    scene.solver.tolerance = tolerance;
    return scene;
}

const SolverCandidate& of(const SolverChoice& choice, SolverMethod method) {
    return *std::ranges::find(choice.candidates, method, &SolverCandidate::method);
}

TEST(SolverChoiceTest, ASceneThatNamesItsMethodKeepsItsSettings) {
    SceneDescription scene = automatic(64, 0.02);
    scene.solver.method = SolverMethod::explicit_steps;
    const SolverChoice choice = choose_solver(scene, DeviceKind::cpu);
    EXPECT_EQ(choice.settings, scene.solver);
    EXPECT_TRUE(choice.candidates.empty());
}

TEST(SolverChoiceTest, TheModelRunsWhatWasChosenAndKnowsWhatWasAsked) {
    const SceneDescription scene = automatic(64);
    const SimulationModel model(scene);
    EXPECT_EQ(model.asked_method, SolverMethod::automatic);
    EXPECT_EQ(model.asked_tolerance, 0);
    EXPECT_EQ(model.scene.solver.tolerance, default_tolerance);
    EXPECT_EQ(model.scene.solver.method, model.choice.candidates.front().method);
    // The loop begins with the first of the method's rungs that has as many substeps.
    const SolverCandidate& best = model.choice.candidates.front();
    EXPECT_EQ(model.scene.solver.substeps,
              *std::ranges::find_if(substep_rungs(row_of(best.method)),
                                    [&](std::uint32_t rung) { return rung >= best.substeps; }));
    EXPECT_EQ(model.cloths[0].substep_length, 1.0 / (60.0 * model.scene.solver.substeps));
    for (const char* name : {"line", "explicit", "relax"}) EXPECT_NE(model.choice.reason.find(name), std::string::npos);
}

TEST(SolverChoiceTest, TheCheapestThatReachesComesFirst) {
    const SolverChoice choice = choose_solver(automatic(128), DeviceKind::cpu);
    ASSERT_EQ(choice.candidates.size(), 3u);
    for (std::size_t k = 1; k < 3; ++k)
        EXPECT_TRUE(!choice.candidates[k].reaches ||
                    choice.candidates[k - 1].predicted_ms <= choice.candidates[k].predicted_ms);
    EXPECT_NE(choice.candidates.front().method, SolverMethod::relax);  // damps motion that it does not resolve
}

TEST(SolverChoiceTest, WindAndContactCostASubstepTheSameByEveryMethod) {
    const auto substep_ms = [](const SceneDescription& scene, SolverMethod method) {
        const SolverChoice choice = choose_solver(scene, DeviceKind::cpu);
        const SolverCandidate& candidate = of(choice, method);
        return candidate.predicted_ms / (candidate.substeps + companion_substeps(row_of(method), candidate.substeps));
    };
    const SceneDescription calm = automatic(20);
    SceneDescription windy = calm, met = calm, met_by_four = calm;
    windy.wind.velocity = {5, 0, 0};
    met.colliders = {{.shape = Sphere{{9, 9, 9}, 0.1}}};
    met_by_four.colliders.resize(4, met.colliders[0]);
    const auto more = [&](const SceneDescription& scene, SolverMethod method) {
        return substep_ms(scene, method) - substep_ms(calm, method);
    };
    for (const SceneDescription* scene : {&windy, &met, &met_by_four}) {
        EXPECT_GT(more(*scene, SolverMethod::explicit_steps), substep_ms(calm, SolverMethod::explicit_steps) / 2);
        EXPECT_NEAR(more(*scene, SolverMethod::line), more(*scene, SolverMethod::explicit_steps), 1e-9);
    }
    EXPECT_GT(more(met_by_four, SolverMethod::line), more(met, SolverMethod::line));
}

TEST(SolverChoiceTest, TheLawsScaleAsTheyAreStated) {
    const auto substeps = [](std::uint32_t links, double tolerance, SolverMethod method) {
        return double(of(choose_solver(automatic(links, tolerance), DeviceKind::cpu), method).substeps);
    };
    // All three need substeps in proportion to the links; relaxation and explicit steps by the root of the tolerance.
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        const double tolerance = method == SolverMethod::line ? 1e-5 : 1e-4;  // more substeps than the motion needs
        EXPECT_NEAR(substeps(256, tolerance, method) / substeps(64, tolerance, method), 4, 0.2);
    }
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps})
        EXPECT_NEAR(substeps(128, 1e-5, method) / substeps(128, 1e-3, method), 10, 0.3);
    // Measured on the hanging and swinging sheet (`drape bench accuracy`), 1 % takes about 20 relaxed substeps at 64
    // links; lines from a held edge need as many as the swing.
    EXPECT_NEAR(substeps(64, 0.01, SolverMethod::relax), 25, 6);
    for (const std::uint32_t links : {64u, 256u, 512u})
        EXPECT_EQ(substeps(links, 0.01, SolverMethod::line), links == 512 ? 9 : 6);
}

TEST(SolverChoiceTest, ACollidingOrWindyClothGetsMoreSubsteps) {
    const SceneDescription calm = automatic(64, 1e-5);  // the laws ask for more than the swing does
    SceneDescription windy = calm, colliding = calm;
    windy.wind.velocity = {8, 0, 0};
    colliding.colliders.push_back({Sphere{}});
    const auto substeps = [](const SceneDescription& scene, SolverMethod method) {
        return of(choose_solver(scene, DeviceKind::cpu), method).substeps;
    };
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        // Micro-steps follow the stiffness, which asks for more than the laws do.
        const bool stiff = method == SolverMethod::explicit_steps;
        EXPECT_GE(substeps(colliding, method), substeps(calm, method) + (stiff ? 0 : 1));
        EXPECT_GE(substeps(windy, method), substeps(calm, method) + (stiff ? 0 : 1));
    }
}

TEST(SolverChoiceTest, ASwingBoundsTheSubstep) {
    const auto choose = [](double size, double gravity) {
        SceneDescription scene = automatic(8);
        scene.cloths[0].size = {size, 0.5 * size};
        scene.gravity = {0, -gravity, 0};
        return of(choose_solver(scene, DeviceKind::cpu), SolverMethod::line);
    };
    const auto calm = [&](double size, double gravity) { return choose(size, gravity).calm_substeps; };
    EXPECT_EQ(calm(1, 9.81), 6u);
    EXPECT_EQ(calm(0.25, 9.81), 12u);
    EXPECT_EQ(calm(100, 9.81), 1u);
    EXPECT_EQ(calm(1, 0), 1u);
    EXPECT_EQ(choose(0.25, 9.81).least_substeps, 1u) << "a small error may allow fewer";
    EXPECT_GE(choose(0.25, 9.81).substeps, 12u);
}

TEST(SolverChoiceTest, WhatNoSettingReachesIsNotPromised) {
    const SolverChoice choice = choose_solver(automatic(1024, 1e-9), DeviceKind::cpu);
    for (const SolverCandidate& candidate : choice.candidates) {
        EXPECT_FALSE(candidate.reaches);
        EXPECT_LE(candidate.substeps, 4096u);
    }
    EXPECT_NE(choice.reason.find("does not"), std::string::npos);
}

TEST(SolverChoiceTest, WithoutNestedBoxesLonePinsTakeMoreSubsteps) {
    SceneDescription scene = automatic(256);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(256, 0, 256, 0)};
    const auto substeps = [&](DeviceKind device) {
        return of(choose_solver(scene, device), SolverMethod::line).substeps;
    };
    EXPECT_GT(substeps(DeviceKind::gpu), substeps(DeviceKind::cpu));
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    EXPECT_EQ(substeps(DeviceKind::gpu), substeps(DeviceKind::cpu));
}

TEST(SolverChoiceTest, ExplicitStepsThatWouldSoftenTheBendingAreNotChosen) {
    SceneDescription scene = automatic(16);
    scene.cloths[0].stiffness.bend = 1e4;
    EXPECT_FALSE(of(choose_solver(scene, DeviceKind::gpu), SolverMethod::explicit_steps).reaches);
    scene.cloths[0].stiffness.bend = 1e-9;
    EXPECT_TRUE(of(choose_solver(scene, DeviceKind::gpu), SolverMethod::explicit_steps).reaches);
}

}  // namespace
}  // namespace drape
