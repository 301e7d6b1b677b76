// A cloth's model holds what its scene needs and leaves out the rest.
#include "cloth/cloth_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/frame_steps.h"
#include "cloth/kernel_steps.h"
#include "cloth/method_line.h"
#include "cloth/nested_boxes.h"
#include "support/method_steps.h"
#include "support/sheets.h"

namespace drape {
namespace {

using testing::ElementsAre;
using testing::Pair;

bool skips(const std::vector<SkippedWork>& list, const std::string& what) {
    return std::ranges::any_of(list, [&](const SkippedWork& work) { return work.what == what; });
}

int count(const std::vector<Step>& steps, StepKind kind) {
    return static_cast<int>(std::ranges::count(steps, kind, &Step::kind));
}

TEST(ClothModelTest, SpringConstantsFollowTheCellShape) {
    SceneDescription scene = test::sheet(11, 6, 1.0, 1.0, 10);  // dx 0.1, dy 0.2
    scene.cloths[0].stiffness = {false, 1000, 100, 0};
    scene.cloths[0].areal_density = 0.25;
    const ClothModel model(scene, 0);
    EXPECT_DOUBLE_EQ(model.inner_mass, 0.25 * 0.1 * 0.2);
    const double h = 1.0 / 600;
    const auto springs = test::pushes<glsl::SpringPush>(model.scheme);
    const auto stiffness = [&](std::size_t spring) {
        return model.inner_mass / (h * h * static_cast<double>(springs[spring].compliance));
    };
    EXPECT_NEAR(stiffness(0), 1000 * 0.2 / 0.1, 1e-3);
    EXPECT_NEAR(stiffness(2), 1000 * 0.1 / 0.2, 1e-3);
    EXPECT_NEAR(stiffness(4), 100 * (0.01 + 0.04) / (2 * 0.1 * 0.2), 1e-3);
    EXPECT_FLOAT_EQ(springs[0].rest_length, 0.1f);
    EXPECT_FLOAT_EQ(springs[2].rest_length, 0.2f);
    EXPECT_FLOAT_EQ(springs[4].rest_length, std::sqrt(0.05f));
}

TEST(ClothModelTest, RigidSpringsHaveNoComplianceAndNoTension) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 4, 8);
    scene.cloths[0].stiffness.rigid = true;
    const ClothModel model(scene, 0);
    const auto springs = test::pushes<glsl::SpringPush>(model.scheme);
    ASSERT_EQ(springs.size(), 8u);
    for (const glsl::SpringPush& push : springs) EXPECT_EQ(push.compliance, 0.0f);
    for (const bool has : model.scheme.carries_tension) EXPECT_FALSE(has);
}

TEST(ClothModelTest, NeedlessWorkIsLeftOutWithAReason) {
    SceneDescription scene = test::sheet(2, 9, 1, 1, 4, 1);
    scene.cloths[0].stiffness.shear = 0;
    const SimulationModel model(scene);
    EXPECT_EQ(model.cloths[0].scheme.iterated.size(), 3u);  // row even, column even, column odd
    EXPECT_TRUE(skips(model.skipped(), "sheet/spring row odd"));
    EXPECT_TRUE(skips(model.skipped(), "sheet/spring shear down-right even"));
    EXPECT_TRUE(skips(model.skipped(), "sheet/spring shares"));
    EXPECT_TRUE(skips(model.skipped(), "sheet/tension between iterations"));
    EXPECT_TRUE(skips(model.skipped(), "wind"));
    EXPECT_TRUE(skips(model.skipped(), "gas"));
    EXPECT_TRUE(skips(model.skipped(), "collision"));
}

TEST(ClothModelTest, AGpuIsNotAskedWhetherSmallClothNeedsAnotherIteration) {
    const std::string question = "questions whether a substep needs another iteration";
    const auto decisions = [](const SimulationModel& model) {
        return std::ranges::count(frame_steps(model), StepKind::decide, &Step::kind);
    };
    SceneDescription scene = test::sheet(255, 255, 1, 1, 2, 4);
    scene.solver.tolerance = 0.05;
    const SimulationModel cpu(scene), gpu(scene, {.device = DeviceKind::gpu});
    EXPECT_EQ(decisions(cpu), 6);
    EXPECT_FALSE(skips(cpu.skipped(), question));
    EXPECT_EQ(decisions(gpu), 0);
    EXPECT_TRUE(skips(gpu.skipped(), question));
    scene.cloths[0].grid = {256, 256};
    EXPECT_EQ(decisions(SimulationModel(scene, {.device = DeviceKind::gpu})), 6);
    scene.cloths[0].grid = {65, 65};
    scene.solver.method = SolverMethod::line;
    EXPECT_EQ(decisions(SimulationModel(scene, {.device = DeviceKind::gpu})), 6);
}

TEST(ClothModelTest, ALaterPinOverridesAnEarlierOne) {
    SceneDescription scene = test::sheet(4, 4, 1, 1, 4);
    Pin released = test::pin_box(3, 0, 3, 0);
    released.release = 1.5;
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0]), released};
    const ClothModel model(scene, 0);
    for (std::size_t column = 0; column < 4; ++column) EXPECT_EQ(model.position[column].w, 0.0f);
    ASSERT_EQ(model.pinned.size(), 1u);
    EXPECT_EQ(model.pinned[0].index.x, 3);
    EXPECT_EQ(model.pinned[0].rest.w, 4.0f) << "a corner's inverse mass once released";
    EXPECT_TRUE(model.has_release);
    EXPECT_FALSE(model.has_motion);
}

TEST(FrameStepsTest, ExplicitFramesAreMicroSteps) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 3, 2);
    scene.solver.method = SolverMethod::explicit_steps;
    scene.wind.velocity = {1, 0, 0};
    scene.colliders.push_back({Sphere{}});
    const SimulationModel model(scene);
    EXPECT_EQ(model.method().name, "explicit");
    std::vector<StepKind> kinds;
    for (const Step& step : frame_steps(model)) kinds.push_back(step.kind);
    std::vector<StepKind> expected;
    for (int substep = 0; substep < 3; ++substep)
        expected.insert(expected.end(), {StepKind::wind, StepKind::explicit_step, StepKind::collide});
    expected.push_back(StepKind::advance);
    EXPECT_EQ(kinds, expected);
    scene.solver.method = SolverMethod::relax;
    EXPECT_EQ(SimulationModel(scene).method().name, "relax");
}

/// Returns first substeps and counts of a scene's explicit steps with four in flight.
std::vector<std::pair<std::uint32_t, std::uint32_t>> in_flight(const SceneDescription& scene, std::size_t cloth = 0) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    for (const Step& step :
         explicit_steps_together(frame_steps(SimulationModel(scene)), Kernel::explicit_stream, [](std::size_t) {
             return FlightSize{4, 4};
         }))
        if (step.kind == StepKind::explicit_step && step.cloth == cloth) found.emplace_back(step.substep, step.count);
    return found;
}

TEST(FrameStepsTest, MicroStepsAreInFlightTogetherButAFramesFirstAndLast) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 11, 1);
    scene.solver.method = SolverMethod::explicit_steps;
    EXPECT_THAT(in_flight(scene), ElementsAre(Pair(0, 1), Pair(1, 4), Pair(5, 4), Pair(9, 1), Pair(10, 1)));
    // If the last step were not kept apart, 5 to 8 would be one.
    SceneDescription nine = scene;
    nine.solver.substeps = 9;
    EXPECT_THAT(in_flight(nine), ElementsAre(Pair(0, 1), Pair(1, 4), Pair(5, 1), Pair(6, 1), Pair(7, 1), Pair(8, 1)));
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    for (std::size_t cloth : {0, 1})
        EXPECT_THAT(in_flight(scene, cloth), ElementsAre(Pair(0, 1), Pair(1, 4), Pair(5, 4), Pair(9, 1), Pair(10, 1)));
}

TEST(FrameStepsTest, MicroStepsBetweenWhichSomethingHappensGoOneByOne) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 6, 1);
    scene.solver.method = SolverMethod::explicit_steps;
    EXPECT_THAT(in_flight(scene), ElementsAre(Pair(0, 1), Pair(1, 4), Pair(5, 1)));
    const auto alone = ElementsAre(Pair(0, 1), Pair(1, 1), Pair(2, 1), Pair(3, 1), Pair(4, 1), Pair(5, 1));
    SceneDescription colliding = scene, windy = scene, bending = scene;
    colliding.colliders.push_back({Sphere{}});
    windy.wind.velocity = {1, 0, 0};
    bending.cloths[0].stiffness.bend = 1e-4;
    EXPECT_THAT(in_flight(colliding), alone);
    EXPECT_THAT(in_flight(windy), alone);
    EXPECT_THAT(in_flight(bending), alone);
}

/// Returns the iteration of each of a scene's passes over all springs, and for each of its predictions whether it
/// turns.
std::pair<std::vector<std::uint32_t>, std::vector<bool>> spring_passes_of(const SceneDescription& scene) {
    std::pair<std::vector<std::uint32_t>, std::vector<bool>> found;
    for (const Step& step :
         springs_together(SimulationModel(scene), Kernel::spring_stream, frame_steps(SimulationModel(scene)))) {
        if (step.kind == StepKind::all_springs) found.first.push_back(step.iteration);
        if (step.kind == StepKind::force) found.second.push_back(step.turns);
    }
    return found;
}

TEST(FrameStepsTest, SpringsOfAnIterationAreSweptAndTheDisplacementComesHome) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 2, 1);
    scene.cloths[0].stiffness = {false, 50, 5, 0};
    EXPECT_THAT(spring_passes_of(scene), Pair(ElementsAre(0, 0), ElementsAre(true, true)));
    scene.solver.iterations = 2;
    EXPECT_THAT(spring_passes_of(scene), Pair(ElementsAre(0, 1, 0, 1), ElementsAre(false, false)));
    scene.cloths[0].stiffness.shear = 0;
    EXPECT_THAT(spring_passes_of(scene), Pair(ElementsAre(), ElementsAre(false, false)))
        << "tension of stretch springs alone";
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_THAT(spring_passes_of(scene), Pair(ElementsAre(0, 1, 0, 1), ElementsAre(false, false)));
    scene.solver.iterations = 3;
    EXPECT_THAT(spring_passes_of(scene), Pair(ElementsAre(0, 1, 2, 0, 1, 2), ElementsAre(true, true)));
    scene.solver.tolerance = 0.1;
    EXPECT_THAT(spring_passes_of(scene), Pair(ElementsAre(0, 0), ElementsAre(true, true)))
        << "the device decides on others";
}

TEST(FrameStepsTest, TheTwistOfAllColoursIsSweptAndTheDisplacementComesHome) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 2, 1);
    scene.cloths[0].stiffness = {false, 50, 5, 1e-4};
    for (const auto& [method, turns] : {std::pair{SolverMethod::line, true}, std::pair{SolverMethod::relax, false}}) {
        scene.solver.method = method;
        const SimulationModel model(scene);
        ASSERT_EQ(count(frame_steps(model), StepKind::twist), 2 * 4);
        const std::vector<Step> steps = kernel_steps(model, stream_kernels);
        EXPECT_EQ(count(steps, StepKind::twist), 0);
        EXPECT_EQ(count(steps, StepKind::all_twist), 2);
        const auto plain = test::pushes<glsl::TwistPush>(model.cloths[0].scheme)[0];
        for (const Step& step : steps) {
            const bool predicts = step.kind == StepKind::force || step.kind == StepKind::predict;
            EXPECT_EQ(step.turns, predicts && turns) << "relaxation's springs are a second pass";
            if (step.kind != StepKind::all_twist) continue;
            EXPECT_EQ(step.push<glsl::AllTwistPush>().compliance, plain.compliance);
            EXPECT_EQ(step.push<glsl::AllTwistPush>().compliance_bdf2, plain.compliance_bdf2);
        }
    }
}

TEST(FrameStepsTest, APassOverAllSpringsKnowsTheDirectionsThatThereAre) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 1, 1);
    scene.cloths[0].stiffness = {false, 50, 0, 0};
    const std::vector<Step> steps = kernel_steps(SimulationModel(scene), stream_kernels);
    ASSERT_EQ(count(steps, StepKind::all_springs), 1);
    EXPECT_EQ(count(steps, StepKind::spring), 0);
    const auto pass = std::ranges::find(steps, StepKind::all_springs, &Step::kind);
    for (int d = 0; d < 4; ++d) EXPECT_EQ(has_direction(pass->push<glsl::AllSpringsPush>(), d), d < 2) << d;
}

TEST(FrameStepsTest, LineFramesPredictInSecondOrderWithCollidersToo) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 2, 2);
    scene.solver.method = SolverMethod::line;
    const auto kinds = [&] {
        const SimulationModel model(scene);
        EXPECT_EQ(model.method().name, "line");
        std::vector<StepKind> list;
        for (const Step& step : frame_steps(model)) list.push_back(step.kind);
        return list;
    };
    using enum StepKind;
    const auto expected = [](std::vector<StepKind> substep) {
        std::vector<StepKind> list = substep;
        list.insert(list.end(), substep.begin(), substep.end());
        list.push_back(advance);
        return list;
    };
    EXPECT_EQ(kinds(), expected({predict, line, line, line, line, line, line, line, line, torque, rotate}));
    scene.colliders.push_back({Sphere{}});
    scene.cloths[0].stiffness.shear = 0;
    EXPECT_EQ(kinds(), expected({predict, line, line, collide, line, line, collide}));
}

TEST(ClothModelTest, LinesSayWhatTheySoften) {
    SceneDescription scene = test::sheet(33, 33, 1, 1, 20);
    scene.solver.method = SolverMethod::line;
    EXPECT_TRUE(ClothModel(scene, 0).scheme.compromises.empty());
    scene.cloths[0].stiffness.stretch = 1e11;
    for (const bool collides : {false, true}) {
        if (collides) scene.colliders.push_back({Sphere{}});
        scene.solver.substeps = 20;
        const ClothModel model(scene, 0);
        ASSERT_EQ(model.scheme.compromises.size(), 1u);
        EXPECT_EQ(model.scheme.compromises[0].what, "sheet/stiffness");
        // The least compliance is in units of (4/9) h^2/m, or of h^2/m.
        const double factor = collides ? 1 : 2.25,
                     used = factor / least_line_compliance * model.inner_mass * 1200 * 1200;
        EXPECT_NEAR(model.scheme.used_stiffness[0], used, 1e-6 * used);
        const glsl::LinePush push = test::pushes<glsl::LinePush>(model.scheme)[2];
        EXPECT_FLOAT_EQ(collides ? push.compliance : push.compliance_bdf2, float(least_line_compliance));
        // With so many substeps nothing is softened, with one less something is.
        scene.solver.substeps = model.scheme.compromises[0].enough_substeps;
        EXPECT_TRUE(ClothModel(scene, 0).scheme.compromises.empty());
        --scene.solver.substeps;
        EXPECT_FALSE(ClothModel(scene, 0).scheme.compromises.empty());
    }
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_EQ(ClothModel(scene, 0).scheme.compromises[0].enough_substeps, 0u);
}

TEST(ClothModelTest, BendingThatNoNumberOfSubstepsFollowsAsksForTheMostThatCanBeSaid) {
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::line, SolverMethod::explicit_steps}) {
        SceneDescription scene = test::sheet(5, 5, 0.01, 0.01, 4);
        scene.solver.method = method;
        scene.cloths[0].stiffness.bend = 1e30;
        EXPECT_EQ(ClothModel(scene, 0).scheme.following_substeps, 1'000'000'000u);
    }
}

TEST(ClothModelTest, LinesCarryTheTensionOfEverySpringThatThereIs) {
    SceneDescription scene = test::sheet(9, 9, 1, 1, 4);
    scene.solver.method = SolverMethod::line;
    EXPECT_EQ(ClothModel(scene, 0).scheme.carries_tension, (PerDirection<bool>{true, true, true, true}));
    scene.cloths[0].stiffness = {true, 0, 0, 0};
    EXPECT_EQ(ClothModel(scene, 0).scheme.carries_tension, (PerDirection<bool>{true, true, true, true}));
    scene.cloths[0].stiffness = {false, 500, 0, 0};
    EXPECT_EQ(ClothModel(scene, 0).scheme.carries_tension, (PerDirection<bool>{true, true, false, false}));
}

TEST(ClothModelTest, NestedBoxesGoRoundEachParticleHeldAlone) {
    SceneDescription scene = test::sheet(65, 65, 1, 1, 4);
    scene.solver.method = SolverMethod::line;
    Cloth& cloth = scene.cloths[0];
    const auto nested = [&] { return test::pushes<glsl::NestedPush>(ClothModel(scene, 0).scheme); };
    cloth.pins = {test::pin_top(cloth)};
    EXPECT_TRUE(nested().empty());
    EXPECT_TRUE(skips(SimulationModel(scene).skipped(), "sheet/nested boxes"));
    // Two corners have boxes that share no particle; a pin between them whose box shares some with the first waits.
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(64, 0, 64, 0), test::pin_box(30, 0, 30, 0)};
    ASSERT_EQ(nested().size(), 2u);
    const std::vector<glsl::ivec4> table = ClothModel(scene, 0).scheme.nested_table;
    const auto first = static_cast<std::size_t>(nested()[0].first_pin);
    EXPECT_EQ(table[first].z, 2);
    EXPECT_EQ(table[first + 1].x, 64);
    EXPECT_EQ(table[static_cast<std::size_t>(nested()[1].first_pin)].x, 30);
    // A strip around a pin's column goes from end to end, so two in a column take turns.
    EXPECT_TRUE(std::ranges::any_of(table, [](const glsl::ivec4& block) { return block.x == 7 && block.y >= 64; }));
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(0, 64, 0, 64)};
    EXPECT_EQ(nested().size(), 2u);
    // On a GPU more substeps are cheaper.
    EXPECT_TRUE(test::pushes<glsl::NestedPush>(ClothModel(scene, 0, {.device = DeviceKind::gpu}).scheme).empty());
    // Two pins beside each other hold each other, and are not lone.
    cloth.pins = {test::pin_box(0, 0, 1, 0)};
    EXPECT_TRUE(nested().empty());
    // A hundred lone pins are too many.
    cloth.pins.clear();
    for (std::uint32_t k = 0; k < 100; ++k)
        cloth.pins.push_back(test::pin_box(6 * (k % 10), 6 * (k / 10), 6 * (k % 10), 6 * (k / 10)));
    EXPECT_TRUE(nested().empty());
}

TEST(ClothModelTest, NestedBoxesEndBeforeTheDeviceBreaksOff) {
    // The sheet is so large that no block around the pin in its middle is cut short by an edge.
    SceneDescription scene = test::sheet(270, 4200, 1, 1, 1);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].pins = {test::pin_box(135, 2100, 135, 2100)};
    const ClothModel model(scene, 0);
    const auto nested = test::pushes<glsl::NestedPush>(model.scheme);
    ASSERT_EQ(nested.size(), 1u);
    EXPECT_LT(nested_rounds(model.scheme, nested[0], {135, 2100}, glsl::nested_group_width), most_loop_rounds);
}

TEST(FrameStepsTest, OrdersAFrameAsTheSlidesDo) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 3, 2);
    scene.wind.velocity = {1, 0, 0};
    scene.colliders.push_back({Sphere{}});
    const SimulationModel model(scene);
    const std::vector<Step> steps = frame_steps(model);
    EXPECT_EQ(count(steps, StepKind::wind), 3);
    EXPECT_EQ(count(steps, StepKind::force), 3);
    EXPECT_EQ(count(steps, StepKind::spring), 3 * 2 * 8);
    EXPECT_EQ(count(steps, StepKind::collide), 3 * 2);
    EXPECT_EQ(steps[0].kind, StepKind::wind);
    EXPECT_EQ(steps[1].kind, StepKind::force);
    EXPECT_EQ(steps[2].kind, StepKind::spring);
    EXPECT_EQ(steps[10].kind, StepKind::collide);
    EXPECT_EQ(steps.back().kind, StepKind::advance);
    scene.solver.collide = CollideWhen::substep;
    const SimulationModel once(scene);
    EXPECT_EQ(count(frame_steps(once), StepKind::collide), 3);
}

TEST(FrameStepsTest, AllClothsTakeASubstepBeforeTheNextBegins) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 3);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].stiffness.shear = 0;
    const std::vector<Step> steps = frame_steps(SimulationModel(scene));
    ASSERT_EQ(count(steps, StepKind::spring), 3 * (8 + 4));
    for (std::size_t k = 1; k < steps.size(); ++k) {
        EXPECT_GE(steps[k].substep, steps[k - 1].substep);
        if (steps[k].substep == steps[k - 1].substep) {
            EXPECT_GE(steps[k].cloth, steps[k - 1].cloth);
        }
    }
    EXPECT_EQ(count(steps, StepKind::advance), 1);
    EXPECT_EQ(steps.back().kind, StepKind::advance);
    EXPECT_EQ(steps.back().cloth, all_cloths);
}

TEST(MethodTest, PlansOfOneGeometryDifferBySubsteps) {
    SceneDescription scene = test::sheet(9, 9, 1, 1, 10, 2);
    scene.cloths[0].stiffness.bend = 1e-4;
    const ClothGeometry cloth(scene, scene.cloths[0], false);
    for (const Method& method : methods()) {
        const auto bytes = [&](std::uint32_t substeps) {
            return bytes_of(method.scheme(cloth, {substeps, 2, 1.0 / (60 * substeps), scene.gravity, 0.2, false}));
        };
        EXPECT_EQ(bytes(10), bytes(10)) << method.name();
        EXPECT_NE(bytes(10), bytes(11)) << method.name();
    }
}

}  // namespace
}  // namespace drape
