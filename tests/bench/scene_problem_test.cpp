// A user's scene is judged by its own refined runs: the reference errs by its estimate, and disagreement is seen.
#include "bench/scene_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "bench/measure.h"
#include "output/temporary_folder.h"
#include "reference/model_scenes.h"
#include "reference/symplectic_reference.h"
#include "run/run.h"

namespace drape::bench {
namespace {

/// A sheet swings from its upper edge for 0.2 s.
SceneDescription swinging_sheet() {
    SceneDescription scene = model_scenes::sheet(9, 7, 1, 0.8, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.5, 0, 0}, {1, 0, 0}, {0, -0.5, std::sqrt(0.75)}};
    cloth.stiffness = {false, 300, 30, 0};
    cloth.pins = {model_scenes::pin_top(cloth)};
    scene.time = {60, 13};
    return scene;
}

RefinementOptions options(std::uint32_t most_substeps) {
    RefinementOptions options;
    options.wanted_error = 1e-6;
    options.most_substeps = most_substeps;
    options.say = [](const std::string&) {};
    options.progress = [](double) {};
    return options;
}

TEST(SceneReferenceTest, IsAsFarFromTheExactMotionAsItSays) {
    const SceneDescription scene = swinging_sheet();
    const Device device("", Validation::count);
    const ReferenceRun run = refined_scene(device, scene, options(128));
    ASSERT_EQ(run.times.size(), 12u);
    EXPECT_DOUBLE_EQ(run.times.back(), 0.2);
    const ReferenceRun exact = run_symplectic(SpringNetwork(scene, 0), run.times, {0.1, {}});
    for (std::size_t k = 0; k < run.times.size(); ++k)
        EXPECT_LT(position_rms(run.states[k].position, exact.states[k].position),
                  2 * run.error_estimate[k] + exact.error_estimate[k] + 2e-6)
            << run.times[k];
    EXPECT_LT(mean_error(run, run.times.size()), 2e-5);
    EXPECT_THAT(run.method, testing::HasSubstr("m from it, its own estimate"));
    EXPECT_EQ(device.validation_count(), 0u);
}

TEST(SceneReferenceTest, PositionsCountUntilTheFinestRunsPart) {
    ReferenceRun run;
    run.times = {0.1, 0.2, 0.3, 0.4};
    run.error_estimate = {0.001, 0.002, 0.01, 0.002};
    run.observed_order = {2, 2, 2, 2};  // the finest two are three times the estimate apart
    EXPECT_EQ(agreeing_count(run, 0.01), 2u) << "what comes back by chance does not count";
    EXPECT_EQ(agreeing_count(run, 0.1), 4u);
    EXPECT_EQ(agreeing_count(run, 0.001), 0u);
    EXPECT_DOUBLE_EQ(mean_error(run, 2), 0.0015);
    EXPECT_EQ(mean_error(run, 0), 0);
}

UserScene two_cloths() {
    UserScene user{"some folder/my scene,1.json", swinging_sheet(), "hash"};
    user.scene.cloths.push_back(user.scene.cloths[0]);
    user.scene.cloths[1].name = "other";
    user.scene.cloths[1].grid = {4, 3};
    user.scene.cloths[1].placement.origin[2] = 3;
    user.scene.cloths[1].pins = {model_scenes::pin_top(user.scene.cloths[1])};
    return user;
}

TEST(SceneProblemTest, SweepsEveryMethodAndAutoWithNamesOfTheirOwn) {
    const Problem problem = user_problem(two_cloths(), Device(), options(64), std::array{1e-3}, false);
    std::set<std::string> names;
    std::set<SolverMethod> seen;
    for (const Sweep& sweep : problem.sweeps)
        for (const Setting& setting : sweep.settings) {
            EXPECT_TRUE(names.insert(case_name(problem, sweep.size, setting)).second);
            seen.insert(setting.method);
        }
    EXPECT_EQ(seen.size(), solver_method_names.size());
    EXPECT_TRUE(names.contains("my_scene_1/8/auto/chosen"));
}

TEST(SceneProblemTest, ErrorsAreOverTheParticlesOfAllCloths) {
    const UserScene user = two_cloths();
    const TemporaryFolder folder;
    References references(folder.path(), [](const std::string&) {}, {});
    const Problem problem = user_problem(user, Device("", Validation::count), options(64), {}, true);
    const ReferenceRun reference = refined_scene(Device(), user.scene, options(64));
    ASSERT_EQ(reference.states[0].position.size(), 9u * 7 + 4 * 3);
    Recording run{user.scene, {{0, {}, {}}}};
    for (std::uint32_t k = 0; k < reference.times.size(); ++k)
        run.samples.push_back({k + 1, reference.states[k].position, {}});
    Metrics metrics = problem.evaluate(run, references);
    EXPECT_EQ(metrics.at("position_rms"), 0) << "the same run on the same device has the same bits";
    EXPECT_EQ(metrics.at("worst_position"), 0);
    EXPECT_EQ(metrics.at("center_error"), 0);
    for (Vec3& x : run.samples.back().position) x[1] += 0.12;
    metrics = problem.evaluate(run, references);
    EXPECT_NEAR(metrics.at("worst_position"), 0.12, 1e-12);
    EXPECT_NEAR(metrics.at("position_rms"), 0.01, 1e-12) << "the mean over twelve frames";
    EXPECT_NEAR(metrics.at("center_error"), 0.12 / std::sqrt(12), 1e-9);
    EXPECT_NEAR(metrics.at("agreement_s"), 0.2, 1e-12);
    EXPECT_GT(metrics.at("stretch_rms_reference"), 1e-4);
    EXPECT_EQ(references.computed_count(), 1u);
    EXPECT_THAT(problem.about(references), testing::HasSubstr("Richardson"));
}

TEST(SceneProblemTest, StatisticsOfClothsAreJoined) {
    ClothStatistics a, b;
    a.stretch = {30, 0.1, 0.2, -0.3};
    b.stretch = {10, 0.3, 0.4, -0.1};
    a.stretch_error_rms = 0.01, b.stretch_error_rms = 0.02;
    a.mass = 1, b.mass = 3;
    b.center_of_mass = {4, 0, 0};
    b.non_finite_count = 2;
    const ClothStatistics both = joined(std::array{a, b});
    EXPECT_NEAR(both.stretch.rms, std::sqrt((30 * 0.01 + 10 * 0.09) / 40), 1e-15);
    EXPECT_EQ(both.stretch.largest, 0.4);
    EXPECT_EQ(both.stretch.smallest, -0.3);
    EXPECT_EQ(both.stretch_error_rms, 0.02) << "a tolerance bounds each";
    EXPECT_EQ(both.center_of_mass[0], 3);
    EXPECT_EQ(both.non_finite_count, 2u);
}

TEST(SceneProblemTest, AFileIsReadUntilTheFramesThatAreWanted) {
    const TemporaryFolder folder;
    const std::string path = folder / "scene.json";
    const auto text = [](int frames) {
        return "{\"time\": {\"frames\": " + std::to_string(frames) + "}, \"cloths\": [{\"name\": \"a\"}]}";
    };
    write_text(path, text(10));
    EXPECT_EQ(read_user_scene(path, {}, 0).scene.time.frame_count, 10u);
    EXPECT_EQ(read_user_scene(path, {}, 3).scene.time.frame_count, 4u);
    EXPECT_EQ(read_user_scene(path, {}, 30).scene.time.frame_count, 10u);
    EXPECT_NE(read_user_scene(path, {"/gravity=[0,0,0]"}, 0).identity, read_user_scene(path, {}, 0).identity);
    write_text(path, text(1));
    EXPECT_THROW(read_user_scene(path, {}, 0), UsageError);
    EXPECT_THROW(read_user_scene(folder / "missing.json", {}, 0), SceneFailure);
}

}  // namespace
}  // namespace drape::bench
