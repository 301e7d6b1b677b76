// Through the library's public interface a program steps, streams and reads a simulation.
#include "drape/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "library_device.h"

namespace drape {
namespace {

using test::library_device;
using testing::HasSubstr;

using SimulationTest = test::LibraryTest;

/// The sheet hangs by its top row; a blade falls through it from frame 3 on.
SceneDescription cut_sheet() {
    SceneDescription scene;
    scene.time.frame_count = 12;
    scene.image.size = {64, 48};
    scene.image.samples = 1;
    Cloth cloth;
    cloth.name = "sheet";
    cloth.grid = {12, 10};
    cloth.placement.origin = {-0.5, 1.5, 0};
    cloth.pins.push_back({.particles = {{0, 0}, {11, 0}}, .release = {}, .path = {}, .pivot = {}});
    scene.cloths = {cloth};
    scene.cutters.push_back({{{{0.03, 2, -1}, {0.03, 2, 1}, {0.03, 0.6, 0}}}, 0.05, 0.2, {}});
    scene.solver = {.method = SolverMethod::relax, .substeps = 4};
    return scene;
}

SimulationOptions everything() {
    SimulationOptions options;
    options.draw = options.normals = true;
    return options;
}

struct Copy {
    explicit Copy(const FinishedFrame& from)
        : frame(from.frame), rgba(from.rgba.begin(), from.rgba.end()), energy(from.statistics[0].kinetic_energy) {
        positions.assign(from.positions[0].begin(), from.positions[0].end());
        normals.assign(from.normals[0].begin(), from.normals[0].end());
    }
    std::uint32_t frame;
    std::vector<std::uint8_t> rgba;
    std::vector<float> positions, normals;
    double energy;
    bool operator==(const Copy&) const = default;
};

TEST_F(SimulationTest, SteppingGivesWhatStreamingGives) {
    std::vector<Copy> streamed, stepped;
    Simulation stream(cut_sheet(), everything(), library_device());
    EXPECT_TRUE(stream.run(
        11, [](std::uint32_t) { return true; }, [&](const FinishedFrame& frame) { streamed.emplace_back(frame); }));
    Simulation simulation(cut_sheet(), everything(), library_device());
    while (simulation.step()) stepped.emplace_back(simulation.frame());
    ASSERT_EQ(stepped.size(), 12u);
    EXPECT_TRUE(stepped == streamed);
    EXPECT_EQ(stepped.back().rgba.size(), 64u * 48 * 4);
    EXPECT_FALSE(simulation.step());
    EXPECT_EQ(simulation.frame().frame, 11u);
}

TEST_F(SimulationTest, SkippedFramesAndStopsLeaveTheRestAsItIs) {
    std::vector<Copy> all, parts;
    Simulation whole(cut_sheet(), everything(), library_device());
    while (whole.step()) all.emplace_back(whole.frame());
    Simulation simulation(cut_sheet(), everything(), library_device());
    const auto keep = [&](const FinishedFrame& frame) { parts.emplace_back(frame); };
    int asked = 0;
    EXPECT_FALSE(simulation.run(
        8, [](std::uint32_t frame) { return frame % 2 == 0; }, keep, [&] { return ++asked > 5; }));
    ASSERT_TRUE(simulation.step());
    parts.emplace_back(simulation.frame());
    EXPECT_TRUE(simulation.run(
        11, [](std::uint32_t frame) { return frame == 11; }, keep));
    std::vector<std::uint32_t> frames;
    for (const Copy& part : parts) {
        frames.push_back(part.frame);
        EXPECT_TRUE(part == all[part.frame]) << part.frame;
    }
    EXPECT_THAT(frames, testing::ElementsAre(0, 2, 4, 5, 11));
}

TEST_F(SimulationTest, NormalsAreThoseOfTheTrianglesAround) {
    SceneDescription scene = cut_sheet();
    scene.cutters.clear();
    scene.wind.velocity = {2, 0, 5};
    Simulation simulation(scene, everything(), library_device());
    while (simulation.step()) {
    }
    const FinishedFrame& frame = simulation.frame();
    std::vector<std::array<double, 3>> sums(12 * 10);
    const std::vector<std::uint32_t> faces = simulation.triangles(0);
    EXPECT_EQ(faces.size(), 11u * 9 * 2 * 3);
    for (std::size_t i = 0; i < faces.size(); i += 3) {
        const float* corner[3];
        for (int k = 0; k < 3; ++k) corner[k] = &frame.positions[0][4 * faces[i + k]];
        double u[3], v[3];
        for (int axis = 0; axis < 3; ++axis) u[axis] = corner[1][axis] - corner[0][axis];
        for (int axis = 0; axis < 3; ++axis) v[axis] = corner[2][axis] - corner[0][axis];
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                sums[faces[i + k]][axis] +=
                    u[(axis + 1) % 3] * v[(axis + 2) % 3] - u[(axis + 2) % 3] * v[(axis + 1) % 3];
    }
    for (std::size_t particle = 0; particle < sums.size(); ++particle) {
        const float* normal = &frame.normals[0][4 * particle];
        const double length = std::hypot(sums[particle][0], sums[particle][1], sums[particle][2]);
        EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-6);
        double along = 0;
        for (int axis = 0; axis < 3; ++axis) along += normal[axis] * sums[particle][axis] / length;
        EXPECT_GT(along, 0.999) << particle;
    }
}

// This holds for each method, with substeps that method auto changes from frame to frame.
TEST_F(SimulationTest, VelocitiesAreThoseOfTheStatistics) {
    for (const SolverMethod method :
         {SolverMethod::automatic, SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        SceneDescription scene = cut_sheet();
        scene.cutters.clear();
        scene.cloths[0].velocity = {0, 0, 2};
        scene.solver = {.method = method, .substeps = 12};
        SimulationOptions options;
        options.velocities = true;
        options.statistics = false;  // implied by the velocities
        Simulation simulation(scene, options, library_device());
        while (simulation.step()) {
            const FinishedFrame& frame = simulation.frame();
            double largest = 0;
            for (std::size_t i = 0; i < frame.velocities[0].size(); i += 4) {
                const float* v = &frame.velocities[0][i];
                largest = std::max(largest, std::hypot(static_cast<double>(v[0]), static_cast<double>(v[1]),
                                                       static_cast<double>(v[2])));
                EXPECT_EQ(v[3], 0);
            }
            EXPECT_NEAR(largest / frame.statistics[0].largest_speed, 1, 1e-6) << frame.frame;
            EXPECT_GT(largest, 1);
        }
    }
}

TEST_F(SimulationTest, TellsOfCutsAndHasTheTrianglesThatAreLeft) {
    std::vector<Cut> cuts;
    SimulationOptions options;
    options.on_cut = [&](const Cut& cut) { cuts.push_back(cut); };
    Simulation simulation(cut_sheet(), options, library_device());
    const std::size_t whole = simulation.triangles(0).size();
    while (simulation.step()) {
    }
    ASSERT_FALSE(cuts.empty());
    std::size_t split = 0;
    for (const Cut& cut : cuts) split += cut.triangles;
    EXPECT_GT(split, 0u);
    EXPECT_EQ(simulation.triangles(0), cuts.back().faces);
    EXPECT_EQ(whole - 3 * split, cuts.back().faces.size());
}

TEST_F(SimulationTest, PicturesShowCollidersWhereTheyAreInThatFrame) {
    SceneDescription moving = cut_sheet();
    moving.cutters.clear();
    moving.cloths[0].pins[0].particles = {{0, 0}, {11, 9}};  // all particles, so that nothing but the ball moves
    moving.time = {.fps = 10, .frame_count = 4};
    Collider ball{Sphere{{-0.6, 1, 0.8}, 0.2}};
    ball.path.keys = {{0, {0, 0, 0}, {}}, {0.1, {0.4, 0, 0}, {}}, {0.2, {0.8, 0.2, 0}, {}}, {0.3, {1.2, 0, 0}, {}}};
    // The larger ball, at rest, decides on the number of segments that both are drawn with, the same in every scene
    // here.
    const Collider large{Sphere{{1.2, 1.6, -0.6}, 0.5}};
    moving.colliders = {ball, large};
    Simulation simulation(moving, everything(), library_device());
    for (std::size_t number = 0; number < 4; ++number) {
        ASSERT_TRUE(simulation.step());
        SceneDescription still = moving;
        // The ball is there before the start, by way of all its places: shadow maps cover where a ball may be.
        MotionPath& path = still.colliders[0].path;
        for (MotionKey& key : path.keys) key.time -= 10;
        path.keys.push_back({-1, ball.path.keys[number].translate, {}});
        Simulation there(still, everything(), library_device());
        ASSERT_TRUE(there.step());
        EXPECT_TRUE(std::ranges::equal(simulation.frame().rgba, there.frame().rgba)) << "frame " << number;
    }
}

TEST_F(SimulationTest, WhatIsNotWantedIsNotThere) {
    SimulationOptions options;
    options.positions = options.statistics = false;
    Simulation simulation(cut_sheet(), options, library_device());
    ASSERT_TRUE(simulation.step());
    EXPECT_TRUE(simulation.frame().rgba.empty());
    EXPECT_TRUE(simulation.frame().positions.empty());
    EXPECT_TRUE(simulation.frame().velocities.empty());
    EXPECT_TRUE(simulation.frame().normals.empty());
    EXPECT_TRUE(simulation.frame().statistics.empty());
    const SimulationFacts all = Simulation(cut_sheet(), everything(), library_device()).facts(),
                          few = simulation.facts();
    EXPECT_LT(few.pass_count, all.pass_count);
    EXPECT_GT(few.skipped.size(), all.skipped.size());
}

TEST_F(SimulationTest, SaysWhatItChose) {
    SceneDescription scene = cut_sheet();
    scene.solver = {};
    const Simulation simulation(scene, {}, library_device());
    EXPECT_EQ(simulation.facts().asked_method, "auto");
    EXPECT_NE(simulation.facts().method, "auto");
    EXPECT_FALSE(simulation.facts().choice_reason.empty());
    EXPECT_NE(simulation.scene().solver.method, SolverMethod::automatic);
    EXPECT_THAT(simulation.describe_plan("text"), HasSubstr("sheet"));
}

TEST_F(SimulationTest, AFrameThatIsNoResultIsThrownOrHandedOutAsAsked) {
    SceneDescription scene = cut_sheet();
    scene.gravity = {0, -3e38, 0};
    Simulation simulation(scene, {}, library_device());
    EXPECT_THROW(while (simulation.step()){}, Diverged);
    SimulationOptions options;
    options.keep_promises = false;
    Simulation lenient(scene, options, library_device());
    while (lenient.step()) {
    }
    EXPECT_GT(lenient.frame().statistics[0].non_finite_count, 0u);
}

TEST(SimulationErrors, AreTyped) {
    EXPECT_THROW(Device("no such device"), DeviceError);
    EXPECT_THROW(load_scene("/no/such/scene.json"), SceneFailure);
    try {
        parse_scene("{\"cloths\": [{\"grid\": [1, 2]}], \"wnd\": {}}");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("/cloths/0/grid"), HasSubstr("wnd")));
    }
}

/// Expects that a scene with one change is refused for what the pointer names.
void refused(const char* pointer, void (*change)(SceneDescription&)) {
    SceneDescription scene = cut_sheet();
    change(scene);
    try {
        const Simulation simulation(scene, {}, library_device());
        ADD_FAILURE() << pointer;
    } catch (const SceneFailure& failure) {
        EXPECT_EQ(failure.result().errors.at(0).pointer, pointer);
    }
}

TEST(SimulationErrors, NumbersOfAClothBuiltInCodeAreChecked) {
    refused("/cloths/0/placement", [](SceneDescription& scene) { scene.cloths[0].placement.u = {NAN, 0, 0}; });
    refused("/cloths/0/stiffness", [](SceneDescription& scene) { scene.cloths[0].stiffness.bend = -1; });
    refused("/cloths/0/stiffness", [](SceneDescription& scene) { scene.cloths[0].stiffness.stretch.weft = INFINITY; });
    refused("/cloths/0/damping", [](SceneDescription& scene) { scene.cloths[0].damping = -1; });
    refused("/cloths/0/friction", [](SceneDescription& scene) { scene.cloths[0].friction = NAN; });
    refused("/cloths/0/thickness", [](SceneDescription& scene) { scene.cloths[0].thickness = -0.01; });
    refused("/cloths/0/self_collision",
            [](SceneDescription& scene) { scene.cloths[0].self_collision = {.thickness = 0, .friction = {}}; });
    refused("/cloths/0/velocity", [](SceneDescription& scene) { scene.cloths[0].velocity = {0, INFINITY, 0}; });
}

TEST(SimulationErrors, ASceneBuiltInCodeIsChecked) {
    refused("/cloths", [](SceneDescription& scene) { scene.cloths.clear(); });
    refused("/cloths/0/grid", [](SceneDescription& scene) { scene.cloths[0].grid = {1, 10}; });
    refused("/cloths/0/grid", [](SceneDescription& scene) { scene.cloths[0].grid = {70000, 70000}; });
    refused("/cloths/0/size", [](SceneDescription& scene) { scene.cloths[0].size = {1, NAN}; });
    refused("/cloths/0/pins/0", [](SceneDescription& scene) { scene.cloths[0].pins[0].particles.last = {12, 0}; });
    refused("/cloths/0/holes/0", [](SceneDescription& scene) { scene.cloths[0].holes = {{{3, 3}, {2, 9}}}; });
    refused("/cloths/0/holes", [](SceneDescription& scene) {
        const std::array<std::uint32_t, 2>& grid = scene.cloths[0].grid;
        scene.cloths[0].holes = {{{0, 0}, {grid[0] - 1, grid[1] - 1}}};
    });
    refused("/cloths/0/start", [](SceneDescription& scene) { scene.cloths[0].start.resize(7); });
    refused("/cloths/0/start", [](SceneDescription& scene) {
        scene.cloths[0].start.resize(std::size_t{scene.cloths[0].grid[0]} * scene.cloths[0].grid[1]);
    });
    refused("/cloths/0/velocities", [](SceneDescription& scene) { scene.cloths[0].velocities.resize(7); });
    refused("/cloths/0/maps/stiffness", [](SceneDescription& scene) { scene.cloths[0].cell_stiffness = {1}; });
    refused("/cloths/0/maps/tear", [](SceneDescription& scene) { scene.cloths[0].cell_tear = {1, 0}; });
    refused("/cloths/0/maps/friction", [](SceneDescription& scene) { scene.cloths[0].particle_friction = {1}; });
    refused("/cloths/0/maps/thickness", [](SceneDescription& scene) {
        const std::array<std::uint32_t, 2>& grid = scene.cloths[0].grid;
        scene.cloths[0].particle_thickness.assign(std::size_t{grid[0]} * grid[1], 1.5f);
    });
    refused("/cloths/0/tear", [](SceneDescription& scene) { scene.cloths[0].tear = Tear{}; });
    refused("/cloths/0/tear", [](SceneDescription& scene) { scene.cloths[0].tear = Tear{0.1, 5}; });
    refused("/cloths/0/tear", [](SceneDescription& scene) { scene.cloths[0].tear = Tear{-1, {}}; });
    refused("/cloths/0/tear", [](SceneDescription& scene) {
        scene.cloths[0].stiffness.rigid = true;
        scene.cloths[0].tear = Tear{.strain = 0.1, .tension = {}};
    });
    refused("/cloths/0/maps/density", [](SceneDescription& scene) {
        const std::array<std::uint32_t, 2>& grid = scene.cloths[0].grid;
        scene.cloths[0].cell_density.assign(std::size_t{grid[0] - 1} * (grid[1] - 1), 0.5f);
    });
    refused("/cloths/0", [](SceneDescription& scene) {
        scene.overlap = Overlap::refuse;
        scene.colliders = {{Sphere{{0, 0, 0}, 100}}};
    });
    refused("/cloths/1/name", [](SceneDescription& scene) { scene.cloths.push_back(scene.cloths[0]); });
    refused("/time", [](SceneDescription& scene) { scene.time.fps = 0; });
    refused("/solver", [](SceneDescription& scene) { scene.solver.substeps = 0; });
    refused("/image", [](SceneDescription& scene) { scene.image.samples = 3; });
    refused("/lights", [](SceneDescription& scene) { scene.lights.resize(5); });
}

}  // namespace
}  // namespace drape
