// In the closed loop of method `auto` the device judges, redoes and changes steps as its twin does, to the bit, and
// nobody who asks for the frames one by one gets others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "library_device.h"
#include "picture/frame_copy.h"
#include "simulation/frame_server.h"
#include "support/self_contact_scenes.h"
#include "twin/twin_loop.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::everything;

SceneDescription automatic(SceneDescription scene, std::uint32_t frames) {
    scene.solver = {};
    scene.time.frame_count = frames + 1;
    return scene;
}

SceneDescription hanging_by_corners(std::uint32_t frames) {
    SceneDescription scene = test::sheet(33, 30, 1, 0.9, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(32, 0, 32, 0)};
    return automatic(scene, frames);
}

struct Seen {
    std::vector<FrameEffort> efforts;
    std::vector<std::vector<float>> positions;  // all cloths one after the other
    std::uint64_t most_cells = 0;               // room of the list in the end
};

/// The elements of one of contact's fields, 0 where there is none.
std::uint64_t count_of(const graph::Graph& graph, ContactField field) {
    const ContactRow& row = contact_fields()[static_cast<std::size_t>(field)];
    for (const graph::Resource& resource : graph.resources())
        if (resource.name == resource_name(row)) return resource.byte_count() / row.element.size;
    return 0;
}

bool same(const FrameEffort& a, const FrameEffort& b) {
    const auto equal = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    return a.substeps == b.substeps && a.attempts == b.attempts && a.predictable == b.predictable &&
           a.asleep == b.asleep && equal(a.motion_error, b.motion_error) && equal(a.position_error, b.position_error) &&
           equal(a.position_error_at_end, b.position_error_at_end) && equal(a.position_allowed, b.position_allowed) &&
           a.sensitive == b.sensitive && equal(a.parted, b.parted);
}

Seen on_device(const SceneDescription& scene, const ModelOptions& options = {}) {
    const SimulationModel model(scene, options);
    FrameOptions wanted;
    wanted.draw = false;
    wanted.positions = wanted.statistics = true;
    FrameServer server(test::gpu().device, model, wanted, {.keep_promises = false});
    Seen seen;
    server.run(
        scene.time.frame_count - 1, [](std::uint32_t frame) { return frame > 0; },
        [&](const FinishedFrame& frame) {
            EXPECT_EQ(frame.frame, seen.efforts.size() + 1);
            seen.efforts.push_back(frame.effort);
            std::vector<float>& all = seen.positions.emplace_back();
            for (const std::span<const float> cloth : frame.positions)
                all.insert(all.end(), cloth.begin(), cloth.end());
        });
    seen.most_cells =
        count_of(server.graphs().planned(server.graphs().contents(true, false)).graph, ContactField::cells);
    return seen;
}

/// Compares every frame's positions, substeps, attempts and estimate; returns what the device did.
Seen compare_loops(const SceneDescription& scene) {
    Seen device = on_device(scene);
    const SimulationModel model(scene);
    TwinLoop twin(model);
    EXPECT_EQ(device.efforts.size(), scene.time.frame_count - 1);
    twin.run(scene.time.frame_count - 1, [&](std::uint32_t frame, const Twin& state, const FrameEffort& effort) {
        if (frame > device.efforts.size()) return;
        const float* found = device.positions[frame - 1].data();
        for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
            const std::vector<glsl::vec4>& expected = state.cloth(cloth)[Field::position];
            EXPECT_EQ(std::memcmp(found, expected.data(), expected.size() * sizeof(glsl::vec4)), 0)
                << "frame " << frame << ", cloth " << cloth;
            found += 4 * expected.size();
        }
        EXPECT_TRUE(same(device.efforts[frame - 1], effort))
            << "frame " << frame << ": " << effort.substeps << ", " << device.efforts[frame - 1].substeps;
    });
    return device;
}

std::uint32_t most_attempts(const Seen& seen) {
    std::uint32_t most = 0;
    for (const FrameEffort& effort : seen.efforts) most = std::max(most, effort.attempts);
    return most;
}

bool changes(const Seen& seen) {
    return std::ranges::any_of(seen.efforts,
                               [&](const FrameEffort& e) { return e.substeps != seen.efforts[0].substeps; });
}

TEST(ClosedLoop, TheTwinDecidesAsTheDeviceDoes) {
    SceneDescription scene = hanging_by_corners(20);
    scene.solver.tolerance_motion = 0.02;
    const Seen seen = compare_loops(scene);
    EXPECT_GT(most_attempts(seen), 1u);
    EXPECT_TRUE(changes(seen));
}

TEST(ClosedLoop, WithEverythingThatASceneMayHave) {
    SceneDescription scene = automatic(everything(), 12);
    scene.solver.tolerance = 0.004;
    scene.solver.tolerance_motion = 0.5;
    EXPECT_GT(most_attempts(compare_loops(scene)), 1u);
}

/// Limits are kept as far as probes tell, no error of positions is stated.
TEST(ClosedLoop, WithoutRunsBesideTheRun) {
    SceneDescription scene = hanging_by_corners(20);
    scene.solver.tolerance_motion = 0.02;
    scene.solver.estimate_error = false;
    const Seen seen = compare_loops(scene);
    EXPECT_GT(most_attempts(seen), 1u);
    for (const FrameEffort& effort : seen.efforts) {
        EXPECT_TRUE(std::isnan(effort.position_error));
        EXPECT_FALSE(effort.sensitive);
        EXPECT_FALSE(effort.predictable && effort.motion_error > 0.02) << "it is NaN where no probe was";
    }
}

TEST(ClosedLoop, InWeatherThatChanges) {
    SceneDescription scene = hanging_by_corners(20);
    scene.gravity_keys = {{0, {0, -9.81, 0}}, {0.15, {8, 0, 2}}};
    scene.wind.keys = {{0.05, {0, 0, 0}}, {0.2, {1, 4, 8}}};
    scene.solver.tolerance_motion = 0.02;
    EXPECT_GT(most_attempts(compare_loops(scene)), 1u);
}

/// Rigid cloth let go level buckles by whatever there is.
TEST(ClosedLoop, CrumplingClothIsSensitive) {
    SceneDescription scene = test::sheet(17, 17, 0.3, 0.3, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(16, 0, 16, 0)};
    cloth.stiffness.rigid = true;
    cloth.areal_density = 0.03;
    scene.time.fps = 60;
    scene = automatic(scene, 45);
    scene.solver.tolerance_motion = 0.002;
    const Seen seen = compare_loops(scene);
    EXPECT_FALSE(seen.efforts.front().sensitive);
    EXPECT_TRUE(seen.efforts.back().sensitive);
    EXPECT_GT(seen.efforts.back().parted, 0);
}

/// A sheet is thrown at a thin shelf so fast that contact is sure of nothing with the substeps that its stretch takes.
TEST(ClosedLoop, WhatMayPassAColliderIsDoneAgain) {
    SceneDescription scene = test::sheet(9, 8, 0.4, 0.3, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.2, 0.55, -0.15}, {1, 0.1, 0}, {0, 0, 1}};
    cloth.velocity = {0, -20, 0};
    scene.time.fps = 200;
    scene.colliders = {Collider{Box{{0, 0, 0}, {0.6, 4e-3, 0.6}}}};
    scene = automatic(scene, 12);
    scene.solver.tolerance = 0.25;
    scene.solver.tolerance_worst = 1;
    scene.solver.tolerance_motion = 50;
    const Seen seen = compare_loops(scene);
    EXPECT_GT(most_attempts(seen), 1u);
    scene.colliders.clear();
    const auto most = [](const Seen& each) {
        return std::ranges::max(each.efforts, {}, &FrameEffort::substeps).substeps;
    };
    EXPECT_GT(most(seen), 2 * most(on_device(scene)));
    for (const std::vector<float>& positions : seen.positions)
        for (std::size_t i = 1; i < positions.size(); i += 4) EXPECT_GT(positions[i], 0);
}

/// Bodies are kept, restored and compared with the cloth, by substeps that change, and each run has its own.
TEST(ClosedLoop, WithBodiesThatClothMoves) {
    SceneDescription scene = everything();
    for (const std::size_t k : {0u, 2u}) {
        scene.colliders[k].path = {};
        scene.colliders[k].mass = 0.5;
        scene.colliders[k].velocity = {0.1, 0.2, 0.3};
        scene.colliders[k].angular_velocity = {1, -2, 0.5};
    }
    scene = automatic(scene, 12);
    scene.solver.tolerance = 0.004;
    scene.solver.tolerance_motion = 0.5;
    const Seen seen = compare_loops(scene);
    EXPECT_GT(most_attempts(seen), 1u);
    EXPECT_GT(seen.efforts.back().position_error, 0);
}

/// Two cloths, alike and unlike, share dispatches (cloth/together.h), and are kept, restored and compared at once.
TEST(ClosedLoop, WithClothsThatAreSimulatedTogether) {
    SceneDescription scene = everything();
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    scene.cloths[1].placement.origin[1] += 0.3;
    scene.cloths[1].velocity = {};
    scene = automatic(scene, 8);
    scene.solver.tolerance = 0.004;
    scene.solver.tolerance_motion = 0.5;
    EXPECT_GT(most_attempts(compare_loops(scene)), 1u);
    scene.cloths[1].damping *= 4;
    scene.cloths[1].areal_density *= 2;
    scene.cloths[1].stiffness.stretch *= 3;
    EXPECT_GT(most_attempts(compare_loops(scene)), 1u);
}

/// The cloth folds on the ground.
TEST(ClosedLoop, WithClothThatMeetsItself) {
    SceneDescription scene = automatic(test::fold(15, 0.5, SolverMethod::line, 1), 20);
    scene.cloths[0].velocity = {0, -4, 0};
    scene.solver.tolerance = 0.0005;
    scene.solver.tolerance_motion = 0.5;  // the default takes 1536 substeps, which the twin's search for pairs feels
    EXPECT_GT(most_attempts(compare_loops(scene)), 1u);
}

TEST(ClosedLoop, WithClothsThatMeetEachOther) {
    SceneDescription scene = automatic(test::layers(SolverMethod::line, 1), 12);
    for (Cloth& cloth : scene.cloths) cloth.velocity = {0, -3, 0};
    scene.solver.tolerance = 0.0004;
    scene.solver.tolerance_motion = 0.5;
    EXPECT_GT(most_attempts(compare_loops(scene)), 1u);
}

/// A pile of sheets that are nearer to each other than the search for cells looks.
SceneDescription pile(std::uint32_t substeps) {
    SceneDescription scene = test::stack(24, 6, SolverMethod::line, substeps);
    for (std::size_t k = 0; k < scene.cloths.size(); ++k) {
        scene.cloths[k].placement.origin[1] = 0.32 + 0.015 * static_cast<double>(k);
        scene.cloths[k].self_collision->thickness = 0.014;
    }
    return scene;
}

void expect_growth(const SceneDescription& scene, const Seen& seen) {
    EXPECT_GT(seen.most_cells, SimulationModel(scene).self_contact->capacity.cells);
}

/// Too short lists are made longer and the frame is done again, which only the device notices: the twin has none.
TEST(ClosedLoop, WithMoreContactThanTheListsHadRoomFor) {
    SceneDescription scene = automatic(pile(1), 5);
    scene.solver.tolerance = 0.1;
    scene.solver.tolerance_motion = 5;
    expect_growth(scene, compare_loops(scene));
}

TEST(NamedMethod, WithMoreContactThanTheListsHadRoomFor) {
    SceneDescription scene = pile(6);
    scene.time.frame_count = 9;
    const Seen seen = on_device(scene);
    expect_growth(scene, seen);
    ASSERT_EQ(seen.positions.size(), 8u);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame < scene.time.frame_count; ++frame) {
        twin.run_frame(frame);
        const float* found = seen.positions[frame - 1].data();
        for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
            const std::vector<glsl::vec4>& expected = twin.cloth(cloth)[Field::position];
            EXPECT_EQ(std::memcmp(found, expected.data(), expected.size() * sizeof(glsl::vec4)), 0)
                << "frame " << frame << ", cloth " << cloth;
            found += 4 * expected.size();
        }
    }
}

TEST(ClosedLoop, TwoRunsGiveTheSameBytesAndSoDoFramesAskedForOneByOne) {
    SceneDescription scene = hanging_by_corners(16);
    scene.solver.tolerance_motion = 0.03;
    const Seen once = on_device(scene), twice = on_device(scene);
    ASSERT_EQ(once.efforts.size(), 16u);
    EXPECT_TRUE(std::ranges::equal(once.efforts, twice.efforts, same));
    EXPECT_EQ(once.positions, twice.positions);
    Simulation simulation(scene, {}, test::library_device());
    ASSERT_TRUE(simulation.step());
    for (std::uint32_t frame = 1; simulation.step(); ++frame) {
        const auto& positions = simulation.frame().positions[0];
        EXPECT_TRUE(std::ranges::equal(positions, once.positions[frame - 1])) << "frame " << frame;
        EXPECT_TRUE(same(simulation.frame().effort, once.efforts[frame - 1])) << "frame " << frame;
    }
    EXPECT_EQ(test::library_device().validation_count(), 0u);
}

TEST(ClosedLoop, TighterLimitsTakeMoreSubstepsAndErrLess) {
    SceneDescription scene = hanging_by_corners(12);
    double last_error = 1e9;
    std::uint32_t last_substeps = 0;
    for (const double tolerance : {0.1, 0.004, 0.0004}) {
        scene.solver.tolerance_motion = tolerance;
        const Seen seen = on_device(scene);
        const FrameEffort& effort = seen.efforts[2];
        EXPECT_LE(effort.motion_error, tolerance);
        EXPECT_GE(effort.substeps, last_substeps);
        EXPECT_LT(effort.motion_error, last_error);
        last_error = effort.motion_error;
        last_substeps = effort.substeps;
    }
}

TEST(ClosedLoop, WhatCannotBeKeptIsRefusedWithTheReason) {
    SceneDescription scene = automatic(test::sheet(9, 8, 0.4, 0.3, 1), 6);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(8, 0, 8, 0)};
    scene.solver.tolerance = 1e-7;  // below what single precision resolves
    Simulation simulation(scene, {}, test::library_device());
    try {
        while (simulation.step()) {
        }
        FAIL() << "nothing was refused";
    } catch (const ToleranceMissed& error) {
        EXPECT_NE(std::string(error.what()).find("stretch error"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("4096 substeps"), std::string::npos) << error.what();
    }
}

TEST(ClosedLoop, StillClothSleepsUntilSomethingMoves) {
    // The cloth hangs flat and damped from its edge, which moves after 2.5 s.
    SceneDescription scene = test::sheet(9, 8, 0.4, 0.3, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_top(cloth)};
    cloth.pins[0].path.keys = {{2.5, {0, 0, 0}, {0, 0, 0}}, {3.0, {0.1, 0, 0}, {0, 0, 0}}};
    cloth.damping = 8;
    scene.time.fps = 20;
    scene = automatic(scene, 60);
    const Seen seen = compare_loops(scene);
    const auto asleep = [&](std::uint32_t frame) { return seen.efforts[frame - 1].asleep; };
    EXPECT_FALSE(asleep(1));
    ASSERT_TRUE(asleep(50));  // this run ends at 2.5 s
    EXPECT_EQ(seen.positions[49], seen.positions[48]);
    EXPECT_FALSE(asleep(51));
    EXPECT_NE(seen.positions[51], seen.positions[49]);
    EXPECT_FALSE(asleep(60));
}

TEST(ClosedLoop, APinThatIsJerkedBetweenTwoProbesIsProbed) {
    SceneDescription scene = test::sheet(33, 30, 1, 0.9, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_top(cloth)};
    cloth.pins[0].path.keys = {{0.7, {0, 0, 0}, {0, 0, 0}}, {0.75, {0, 0, 0.05}, {0, 0, 0}}};
    scene.time.fps = 60;
    scene = automatic(scene, 48);
    const Seen seen = compare_loops(scene);
    const auto probed = [&](std::uint32_t frame) { return std::isfinite(seen.efforts[frame - 1].motion_error); };
    EXPECT_TRUE(probed(1));
    EXPECT_FALSE(probed(42)) << "ends at 0.7 s";
    EXPECT_TRUE(probed(43));
    EXPECT_GT(seen.efforts[42].substeps, seen.efforts[41].substeps);
}

class Flight : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Damping, Flight, testing::Values(0.0, 1.0));

TEST_P(Flight, KeepsItsSpeedWhenTheStepChanges) {
    // Substeps change at the probes, which free flight must not notice.
    SceneDescription scene = test::sheet(65, 65, 1, 1, 1);
    scene.cloths[0].velocity = {1, 2, 0};
    scene.cloths[0].pins.clear();
    const double damping = scene.cloths[0].damping = GetParam();
    scene = automatic(scene, 40);
    scene.solver.tolerance_motion = 1;
    const Seen seen = on_device(scene);
    const SimulationModel model(scene);
    EXPECT_TRUE(changes(seen));
    for (std::size_t frame = 0; frame < seen.positions.size(); ++frame) {
        const double t = static_cast<double>(frame + 1) / scene.time.fps;
        for (const std::size_t i : {std::size_t{0}, std::size_t{2140}, std::size_t{4224}}) {
            const glsl::vec4& start = model.cloths[0].position[i];
            // These are the ways of a speed of 1 m/s and of an acceleration of 1 m/s^2.
            const double speed = damping > 0 ? -std::expm1(-damping * t) / damping : t;
            const double acceleration = damping > 0 ? (t - speed) / damping : 0.5 * t * t;
            EXPECT_NEAR(seen.positions[frame][4 * i], start.x + speed, 1e-5);
            EXPECT_NEAR(seen.positions[frame][4 * i + 1], start.y + 2 * speed - 9.81 * acceleration, 1e-5) << frame;
        }
    }
}

}  // namespace
}  // namespace drape
