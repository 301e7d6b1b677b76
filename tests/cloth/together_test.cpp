// Cloths that are alike are simulated together, and their steps become one.
#include "cloth/together.h"

#include <gtest/gtest.h>

#include "cloth/frame_steps.h"
#include "cloth/kernel_steps.h"
#include "support/sheets.h"

namespace drape {
namespace {

using Lists = std::vector<std::vector<std::size_t>>;

SceneDescription sheets(std::size_t count) {
    SceneDescription scene = test::sheet(9, 7, 1, 1, 3);
    scene.solver.method = SolverMethod::line;
    for (std::size_t k = 1; k < count; ++k) {
        Cloth cloth = scene.cloths[0];
        cloth.name = "sheet " + std::to_string(k);
        cloth.placement.origin = {0, 0, 1.5 * static_cast<double>(k)};
        cloth.velocity = {0, 0.1 * static_cast<double>(k), 0};
        cloth.pins = {test::pin_box(0, 0, static_cast<std::uint32_t>(k), 0)};
        cloth.appearance.pattern = Pattern::checker;
        scene.cloths.push_back(cloth);
    }
    return scene;
}

/// Gives a cloth other numbers of every sort.
void make_unlike(Cloth& cloth, double by) {
    cloth.size = {cloth.size[0] * by, cloth.size[1] / by};
    cloth.areal_density *= by;
    cloth.stiffness.stretch *= 1 / by;
    cloth.stiffness.shear *= by;
    cloth.stiffness.compression /= by;
    cloth.damping += by;
    cloth.friction /= by;
    cloth.thickness *= by;
}

TEST(TogetherTest, ClothsOfOneGridAndItsHolesAreAlike) {
    SceneDescription scene = sheets(6);
    EXPECT_EQ(cloths_alike(scene), (Lists{{0, 1, 2, 3, 4, 5}}));
    make_unlike(scene.cloths[1], 2);
    scene.cloths[3].grid = {7, 9};
    scene.cloths[4].holes = {{{2, 2}, {4, 5}}};
    EXPECT_EQ(cloths_alike(scene), (Lists{{0, 1, 2, 5}}));
    scene.cloths[2].holes = scene.cloths[4].holes;
    EXPECT_EQ(cloths_alike(scene), (Lists{{0, 1, 5}, {2, 4}}));
}

TEST(TogetherTest, ClothsWithMapsOfContactAreAlike) {
    SceneDescription scene = sheets(4);
    scene.cloths[1].particle_friction.assign(63, 2);
    scene.cloths[3].particle_thickness.assign(63, 0.5f);
    EXPECT_EQ(cloths_alike(scene), (Lists{{0, 2}, {1, 3}}));
}

TEST(TogetherTest, NumbersAreTheSameWhateverTheStateHolds) {
    const SceneDescription scene = sheets(3);
    EXPECT_TRUE(have_same_numbers(scene.cloths[0], scene.cloths[2]));
    Cloth other = scene.cloths[2];
    other.damping = 1;
    EXPECT_FALSE(have_same_numbers(scene.cloths[0], other));
}

TEST(TogetherTest, WhatTakesOtherStepsStaysApart) {
    const auto lists = [](SolverMethod method, auto&& change) {
        SceneDescription scene = sheets(4);
        scene.solver.method = method;
        for (Cloth& cloth : scene.cloths) cloth.pins = {test::pin_box(0, 0, 0, 0)};
        change(scene.cloths[1]);
        change(scene.cloths[3]);
        return cloths_together(SimulationModel(scene));
    };
    const Lists all{{0, 1, 2, 3}}, apart{{0, 2}, {1, 3}};
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps, SolverMethod::relax}) {
        EXPECT_EQ(lists(method, [](Cloth& cloth) { make_unlike(cloth, 1.5); }), all);
        EXPECT_EQ(lists(method, [](Cloth& cloth) { cloth.stiffness.bend = 1e-4; }), apart);
        EXPECT_EQ(lists(method, [](Cloth& cloth) { cloth.stiffness.shear = 0; }), apart);
        EXPECT_EQ(lists(method, [](Cloth& cloth) { cloth.pins[0].release = 0.1; }), apart);
    }
    EXPECT_EQ(lists(SolverMethod::relax, [](Cloth& cloth) { cloth.stiffness.rigid = true; }), apart);
}

TEST(TogetherTest, RoundsOfNestedBoxesAreOfAsManyPins) {
    SceneDescription scene = sheets(3);
    const auto held_at = [](std::uint32_t column, std::uint32_t row) {
        return test::pin_box(column, row, column, row);
    };
    for (Cloth& cloth : scene.cloths) cloth.grid = {65, 65};
    scene.cloths[0].pins = {held_at(0, 0), held_at(64, 0)};
    scene.cloths[1].pins = {held_at(0, 0), held_at(0, 64)};  // both of one column, and so of one strip
    scene.cloths[2].pins = {held_at(0, 5), held_at(60, 0)};
    EXPECT_EQ(cloths_together(SimulationModel(scene)), (Lists{{0, 2}}));
}

TEST(TogetherTest, CutsOwnIterationsSelfContactAndSizeKeepThemApart) {
    SceneDescription scene = sheets(2);
    const auto alone = [&](auto&& change) {
        SceneDescription changed = scene;
        change(changed);
        return cloths_alike(changed).empty();
    };
    EXPECT_FALSE(alone([](SceneDescription&) {}));
    EXPECT_TRUE(alone([](SceneDescription& s) { s.cutters.emplace_back(); }));
    EXPECT_TRUE(
        alone([](SceneDescription& s) { s.cloths[0].tear = s.cloths[1].tear = Tear{.strain = 1, .tension = {}}; }));
    EXPECT_TRUE(alone([](SceneDescription& s) { s.solver.tolerance = 0.1, s.solver.iterations = 2; }));
    EXPECT_TRUE(alone([](SceneDescription& s) { s.cloths[1].self_collision.emplace(); }));
    EXPECT_TRUE(alone([](SceneDescription& s) {
        for (Cloth& cloth : s.cloths) cloth.grid = {200, 200};
    }));
}

/// Returns the steps of one cloth within a list, by itself or together.
std::vector<StepKind> kinds_of(std::size_t cloth, const std::vector<Step>& steps, const Lists& lists) {
    std::vector<StepKind> kinds;
    for (const Step& step : steps) {
        bool is_its = step.cloth == cloth || step.cloth == all_cloths;
        for (const std::vector<std::size_t>& list : lists)
            if (step.together && list.front() == step.cloth)
                is_its = is_its || std::ranges::find(list, cloth) != list.end();
        if (is_its) kinds.push_back(step.kind);
    }
    return kinds;
}

std::size_t count_of(const std::vector<Step>& steps, bool together) {
    return static_cast<std::size_t>(std::ranges::count(steps, together, &Step::together));
}

TEST(TogetherTest, EveryClothKeepsItsStepsInTheirOrder) {
    SceneDescription scene = sheets(4);
    scene.cloths[2].holes = {{{2, 2}, {4, 5}}};  // not alike, in their midst
    for (Cloth& cloth : scene.cloths) {
        cloth.pins = {test::pin_box(0, 0, 0, 0)};
        cloth.pins[0].path.keys = {{0, {0, 0, 0}, {}}, {1, {0.1, 0, 0}, {}}};
    }
    scene.colliders.push_back({Sphere{{0, -1, 0}, 0.3}});
    const SimulationModel model(scene);
    const Lists lists = cloths_alike(scene);
    ASSERT_EQ(lists, (Lists{{0, 1, 3}}));
    const std::vector<Step> steps = frame_steps(model), merged = steps_together(steps, lists);
    for (std::size_t cloth = 0; cloth < 4; ++cloth)
        EXPECT_EQ(kinds_of(cloth, merged, lists), kinds_of(cloth, steps, {})) << cloth;
    // Each of three substeps has predict, pins, four directions and collision.
    EXPECT_EQ(count_of(merged, true), 3u * 7);
    EXPECT_EQ(count_of(merged, false), 3u * 7 + 1);
}

TEST(TogetherTest, WhatSomeDoNotDoOrDoOtherwiseStaysTheirs) {
    SceneDescription scene = sheets(3);
    scene.cloths[1].pins[0].path.keys = {{0, {0, 0, 0}, {}}, {1, {0.1, 0, 0}, {}}};
    const Lists lists = cloths_alike(scene);
    ASSERT_EQ(lists.size(), 1u);
    std::vector<Step> steps = frame_steps(SimulationModel(scene));
    std::vector<Step> merged = steps_together(steps, lists);
    EXPECT_EQ(count_of(merged, true), 3u * 5) << "one moves a pin";
    EXPECT_EQ(count_of(merged, false), 3u + 1 + 3 * 2) << "that pin, and the turn of the one that hangs by a corner";
    for (Step& step : steps)
        if (step.cloth == 2 && step.kind == StepKind::line && step.substep == 1)
            std::get<glsl::LinePush>(step.constants).compliance *= 2;
    merged = steps_together(steps, lists);
    EXPECT_EQ(count_of(merged, true), 3u * 5) << "and another is softer in one substep";
    for (const Step& step : merged) {
        const bool softer = step.together && step.kind == StepKind::line && step.substep == 1;
        EXPECT_EQ(step.own.size(), softer ? 3u : 0u);
    }
    for (Step& step : steps)
        if (step.cloth == 2 && step.kind == StepKind::line && step.substep == 1)
            std::get<glsl::LinePush>(step.constants).bend = 1;
    merged = steps_together(steps, lists);
    EXPECT_EQ(count_of(merged, true), 3u * 5 - 4) << "or bends there";
    for (std::size_t cloth = 0; cloth < 3; ++cloth)
        EXPECT_EQ(kinds_of(cloth, merged, lists), kinds_of(cloth, steps, {})) << cloth;
}

TEST(TogetherTest, ExplicitStepsInFlightOfSomeLeaveTheOthersAlone) {
    SceneDescription scene = sheets(3);
    scene.solver.method = SolverMethod::explicit_steps;
    scene.solver.substeps = 11;
    scene.cloths[1].pins[0].path.keys = {{0, {0, 0, 0}, {}}, {1, {0.1, 0, 0}, {}}};
    const Lists lists = cloths_alike(scene);
    ASSERT_EQ(lists.size(), 1u);
    const std::vector<Step> steps =
        explicit_steps_together(frame_steps(SimulationModel(scene)), Kernel::explicit_stream, [](std::size_t) {
            return FlightSize{4, 4};
        });
    const std::vector<Step> merged = steps_together(steps, lists);
    const auto substeps_of = [](std::size_t cloth, const std::vector<Step>& all) {
        std::vector<std::uint32_t> substeps;
        for (const Step& step : all)
            if (step.kind == StepKind::explicit_step && (step.cloth == cloth || step.together))
                for (std::uint32_t k = 0; k < step.count; ++k) substeps.push_back(step.substep + k);
        return substeps;
    };
    for (std::size_t cloth = 0; cloth < 3; ++cloth) {
        EXPECT_EQ(substeps_of(cloth, merged), substeps_of(cloth, steps)) << cloth;
        EXPECT_EQ(substeps_of(cloth, merged).size(), 11u);
    }
}

}  // namespace
}  // namespace drape
