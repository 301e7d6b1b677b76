// The forces that a scene asks for, against statics, Coulomb's law, drag and the momenta of impacts, for every method.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "simulated.h"
#include "support/loads.h"

namespace drape {
namespace {

using test::all_methods;
using test::by_method;
using test::expect_near;
using test::level_sheet;
using test::Simulated;

class ForcesTest : public testing::TestWithParam<SolverMethod> {};

TEST_P(ForcesTest, PinsBearTheWeightOfClothThatHangs) {
    SceneDescription scene = level_sheet(0, 12);
    scene.cloths[0].placement.v = {0, -1, 0};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    Simulated run(by_method(scene, GetParam(), 12));
    run.frames(240);
    expect_near(run.force("pins_0"), {0, run.weight(), 0}, 1e-4, "a hanging sheet's pins");
    expect_near(run.force("gravity"), {0, -run.weight(), 0}, 1e-6, "its weight");
}

/// The force at the ends of a chain of elastic links between two points at one height: its horizontal part, N, found by
/// bisection. Its masses are at the links' ends.
double end_pull(std::size_t links, double length, double span, double link_weight, double stiffness) {
    const auto width = [&](double pull) {
        double sum = 0;
        for (std::size_t k = 0; k < links; ++k) {
            const double up = link_weight * (static_cast<double>(k) - 0.5 * static_cast<double>(links - 1));
            const double tension = std::hypot(pull, up);
            sum += (length / static_cast<double>(links) + tension / stiffness) * pull / tension;
        }
        return sum;
    };
    double least = 0, most = 100 * link_weight * static_cast<double>(links);
    for (int k = 0; k < 200; ++k) (width(0.5 * (least + most)) < span ? least : most) = 0.5 * (least + most);
    return least;
}

TEST_P(ForcesTest, EachEndOfACatenaryBearsItsTension) {
    constexpr std::uint32_t links = 32;
    constexpr double span = 0.8, width = 1.0 / links;
    SceneDescription scene = test::sheet(links + 1, 2, 1, width, 8);
    Cloth& cloth = scene.cloths[0];
    // Soft and heavy, so that rounded positions tell its strain, some hundredths, to 1e-4 of it.
    constexpr double stiffness = 400;
    cloth.stiffness = {false, stiffness, 0, 0};
    cloth.areal_density = 1;
    cloth.damping = 8;
    for (std::uint32_t row = 0; row < 2; ++row)
        for (std::uint32_t k = 0; k <= links; ++k) {
            const double x = span * (double(k) / links - 0.5);
            cloth.start.push_back({x, 1.7 * (x * x - 0.25 * span * span), row * width});
        }
    cloth.pins = {test::pin_box(0, 0, 0, 1), test::pin_box(links, 0, links, 1)};
    // Relaxation stretches cloth as (N/passes)^2.
    Simulated run(by_method(scene, GetParam(), GetParam() == SolverMethod::relax ? 400 : 24));
    run.frames(360);
    const double weight = run.weight();
    // Both rows are borders: a link of either has half of the stiffness dy/dx.
    const double pull = end_pull(links, 1, span, weight / links, stiffness * width * links);
    expect_near(run.force("pins_0"), {-pull, 0.5 * weight, 0}, 1e-4, "the left end");
    expect_near(run.force("pins_1"), {pull, 0.5 * weight, 0}, 1e-4, "the right end");
    EXPECT_NEAR(std::hypot(end_pull(links, 1, span, weight / links, 1e9), 0.5 * weight) / weight, 0.6036, 0.001)
        << "docs/physics.md, section 7";
}

TEST_P(ForcesTest, ABoxBearsASheetAndItsMoment) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.cloths[0].placement.origin[0] += 0.05;
    scene.colliders = {{Plane{{0, 1, 0}, -1}, 0.5}, {Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(150);
    const double weight = run.weight();
    expect_near(run.force("collider_1_box"), {0, weight, 0}, 1e-4, "the box under a sheet");
    expect_near(run.moment("collider_1_box"), {0, 0, 0.05 * weight}, 1e-4, "its moment");
    EXPECT_EQ(length(run.force("collider_0_plane")), 0);
}

TEST_P(ForcesTest, FrictionOfASheetThatSlidesIsCoulombs) {
    SceneDescription scene = level_sheet(0.004, 0);
    scene.cloths[0].velocity = {2, 0, 0};
    scene.colliders = {{Plane{}, 0.3}};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(20);
    expect_near(run.force("collider_0_plane"), {-0.3 * run.weight(), run.weight(), 0}, 1e-4, "a plane under a slide");
}

TEST_P(ForcesTest, DragIsTheWeightAtTheTerminalVelocity) {
    SceneDescription scene = level_sheet(0, 0);
    scene.wind.velocity = {0, 2, 0};
    Simulated run(by_method(scene, GetParam(), 8));
    run.frames(120);
    expect_near(run.force("air"), {0, run.weight(), 0}, 1e-4, "the drag");
}

TEST_P(ForcesTest, AnImpactGivesTheMomentumThatItTakes) {
    SceneDescription scene = level_sheet(0.1, 0);
    scene.cloths[0].velocity = {0, -3, 0};
    scene.colliders = {{Plane{}, 0.3}};
    Simulated run(by_method(scene, GetParam(), 8));
    double given = 0;
    constexpr std::uint32_t frames = 12;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        run.frames(1);
        given += run.force("collider_0_plane")[1] * run.frame_time();
    }
    const double mass = run.statistics().mass;
    expect_near({0, given, 0}, {0, mass * (3 + 9.81 * frames * run.frame_time()), 0}, 1e-4, "an impact");
}

INSTANTIATE_TEST_SUITE_P(Methods, ForcesTest, testing::ValuesIn(all_methods),
                         [](const auto& each) { return std::string(named(each.param).name); });

/// Cloths with pins that move and let go, among colliders, in the wind, one above the other, as drawn.
SceneDescription drawn_with_forces(std::mt19937& random) {
    const auto between = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    const auto whether = [&] { return between(0, 1) < 0.5; };
    SceneDescription scene = level_sheet(between(0.1, 0.4), whether() ? between(0, 2) : 0);
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = between(0.1, 0.4);
    cloth.velocity = {between(-1, 1), between(-1, 1), between(-1, 1)};
    cloth.stiffness.bend = whether() ? 1e-5 : 0;
    if (whether()) cloth.pins = {test::pin_box(0, 0, 3, 0), test::pin_box(8, 8, 8, 8)};
    if (!cloth.pins.empty() && whether())
        cloth.pins[0].path.keys = {{0, {0, 0, 0}, {}}, {0.3, {between(-0.2, 0.2), 0.1, 0}, {0, 20, 0}}};
    if (!cloth.pins.empty() && whether()) cloth.pins[1].release = between(0.05, 0.3);
    if (whether()) scene.wind.velocity = {between(-5, 5), between(-5, 5), between(-5, 5)};
    if (whether()) {
        cloth.loads = {test::pull({{2, 2}, {8, 8}}, Vec3{between(-1, 1), between(-1, 1), between(-1, 1)}),
                       test::press({{0, 0}, {8, 8}}, between(-5, 5)),
                       test::pull({{8, 8}, {8, 8}}, std::vector<VectorKey>{{0, {0, 0, 0}}, {0.2, {0, -1, 0.5}}})};
    }
    if (whether()) scene.colliders.push_back({Plane{}, 0.4});
    if (whether()) scene.colliders.push_back({Box{{0.1, 0, 0}, {0.1, 0.1, 0.1}}, 0.4, {10, 30, 0}});
    if (whether()) scene.colliders.push_back({Sphere{{-0.1, 0, 0.1}, 0.1}, 0.4});
    if (whether()) {
        scene.cloths.push_back(cloth);
        scene.cloths[1].name = "upper";
        scene.cloths[1].placement.origin[1] += 0.05;
        scene.cloths[1].velocity[1] -= 2;
        scene.cloths[1].self_collision = SelfCollision{0.01, 0.4};
    }
    const auto kind = std::uniform_int_distribution<std::size_t>(0, 2)(random);
    return by_method(scene, all_methods[kind], 8);
}

TEST(ForcesSumTest, ForcesAddUpToTheChangeOfMomentumInEveryFrame) {
    constexpr std::uint32_t seed = 20261129;
    std::mt19937 random(seed);
    double worst = 0;
    for (int scene = 0; scene < 40; ++scene) {
        Simulated run(drawn_with_forces(random));
        const std::size_t cloths = run.model().cloths.size();
        std::vector<Vec3> before;
        for (std::size_t cloth = 0; cloth < cloths; ++cloth) before.push_back(run.statistics(cloth).momentum);
        for (int frame = 0; frame < 25; ++frame) {
            run.frames(1);
            for (std::size_t cloth = 0; cloth < cloths; ++cloth) {
                const ClothStatistics now = run.statistics(cloth);
                Vec3 sum{};
                double largest = 0;
                for (const ForceOnCloth& each : now.forces) {
                    sum = plus(sum, each.force);
                    largest = std::max(largest, length(each.force));
                }
                const Vec3 change = times(1 / run.frame_time(), minus(now.momentum, before[cloth]));
                worst = std::max(worst, length(minus(sum, change)) / largest);
                before[cloth] = now.momentum;
            }
        }
    }
    std::printf("[ measured ] seed %u: the sums are off by %.1e of the largest force at most\n", seed, worst);
    EXPECT_LT(worst, 1e-4);
}

TEST(ForcesSumTest, AskingChangesNoBitOfTheMotion) {
    std::mt19937 random(7);
    for (int k = 0; k < 9; ++k) {
        const SceneDescription scene = drawn_with_forces(random);
        Simulated asked(scene);
        const SimulationModel model(scene);
        Twin plain(model);
        asked.frames(12);
        for (std::uint32_t frame = 1; frame <= 12; ++frame) plain.run_frame(frame);
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            for (const Field field : {Field::position, Field::displacement})
                EXPECT_TRUE(
                    std::ranges::equal(asked.twin().cloth(cloth).bytes(field), plain.cloth(cloth).bytes(field)));
    }
}

}  // namespace
}  // namespace drape
