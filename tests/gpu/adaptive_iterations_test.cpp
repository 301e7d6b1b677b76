// Iterations end when the tolerance is met: the device decides, and decides as its twin does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "simulation/frame_server.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::DeviceRun;
using test::everything;
using test::expect_same;
using test::frame_count;
using test::substep_count;

/// Compares the iterations by frame of device and twin; returns those of the last frames.
std::vector<std::uint32_t> compare_iterations(const SceneDescription& scene) {
    const SimulationModel model(scene);
    FrameOptions options;
    options.draw = false;
    options.positions = options.statistics = true;
    FrameServer server(test::gpu().device, model, options);
    Twin twin(model);
    std::vector<std::uint32_t> counts;
    server.run(
        frame_count, [](std::uint32_t frame) { return frame > 0; },
        [&](const FinishedFrame& frame) {
            twin.run_frame(frame.frame);
            const TwinCloth& expected = twin.cloth(0);
            EXPECT_EQ(std::memcmp(frame.positions[0].data(), expected[Field::position].data(),
                                  expected[Field::position].size() * sizeof(glsl::vec4)),
                      0)
                << "frame " << frame.frame;
            EXPECT_EQ(frame.statistics[0].iteration_count, expected.iteration_count) << "frame " << frame.frame;
            counts.push_back(frame.statistics[0].iteration_count.value_or(0));
        });
    return counts;
}

TEST(AdaptiveIterations, TheDeviceSkipsWhatTheTwinSkips) {
    SceneDescription scene = everything();
    scene.solver.iterations = 7;
    scene.solver.tolerance = 0.004;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}};
    const std::vector<std::uint32_t> counts = compare_iterations(scene);
    // The tolerance is one for which some substeps need several iterations, and some need one.
    EXPECT_GT(*std::ranges::max_element(counts), substep_count);
    EXPECT_LT(*std::ranges::min_element(counts), 7 * substep_count);
    EXPECT_NE(counts.front(), counts.back());
}

TEST(AdaptiveIterations, RigidSpringsAndContactOncePerSubstep) {
    SceneDescription scene = everything();
    scene.solver.iterations = 5;
    scene.solver.tolerance = 0.01;
    scene.solver.collide = CollideWhen::substep;
    scene.cloths[0].stiffness.rigid = true;
    compare_iterations(scene);
}

TEST(AdaptiveIterations, LineSolvesEndToo) {
    SceneDescription scene = everything();
    scene.solver.method = SolverMethod::line;
    scene.solver.iterations = 6;
    scene.solver.tolerance = 0.004;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}};
    compare_iterations(scene);
    scene.colliders = {};
    scene.solver.tolerance = 1e-4;
    const std::vector<std::uint32_t> counts = compare_iterations(scene);
    EXPECT_GT(*std::ranges::max_element(counts), substep_count);
    EXPECT_LT(*std::ranges::min_element(counts), 6 * substep_count);
}

TEST(AdaptiveIterations, MetAtOnceIsOneIterationAndNeverMetIsAllOfThem) {
    SceneDescription scene = test::sheet(65, 33, 1, 0.5, substep_count);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.solver.iterations = 4;
    for (const auto& [tolerance, each] : {std::pair(10.0, 1u), std::pair(1e-9, 4u)}) {
        scene.solver.tolerance = tolerance;
        for (const std::uint32_t count : compare_iterations(scene)) EXPECT_EQ(count, each * substep_count);
    }
    // All iterations together are those that run without a tolerance, bit for bit.
    SceneDescription plain = scene;
    plain.solver.tolerance = 0;
    const SimulationModel adaptive_model(scene), plain_model(plain);
    DeviceRun adaptive(test::gpu().device, adaptive_model), all(test::gpu().device, plain_model);
    EXPECT_FALSE(all.pool().has("sheet/iterations"));
    for (std::uint32_t frame = 1; frame <= 4; ++frame) {
        adaptive.run_frame(frame);
        all.run_frame(frame);
    }
    expect_same(Field::position, adaptive, all, 4);
}

}  // namespace
}  // namespace drape
