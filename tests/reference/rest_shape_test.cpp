// Cloth whose springs are at rest in the shape that it starts in (`rest`: "start") keeps that shape, and moves as the
// double-precision network does.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/symplectic_reference.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr SolverMethod methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

/// A bowl, which no flat cloth can become without strain: a flat sheet of 17 x 17 particles raised at its border.
SceneDescription bowl(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, substeps);
    scene.solver.method = method;
    scene.gravity = {0, 0, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.start.clear();
    for (int row = 0; row < 17; ++row)
        for (int column = 0; column < 17; ++column) {
            const double x = column / 16.0 - 0.5, z = row / 16.0 - 0.5;
            cloth.start.push_back({x, static_cast<float>(x * x + z * z), z});
        }
    cloth.placement = {};
    cloth.rest = Rest::start;
    return scene;
}

/// Returns the largest way (m) of a particle in so many frames.
double largest_motion(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    double largest = 0;
    for (std::size_t i = 0; i < scene.cloths[0].start.size(); ++i) {
        const Vec3 at = test::position_of(twin.cloth(0), i), start = scene.cloths[0].start[i];
        largest = std::max(largest, std::hypot(at[0] - start[0], at[1] - start[1], at[2] - start[2]));
    }
    return largest;
}

TEST(RestShapeTest, ABowlStaysOneWhereItIsAtRest) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = bowl(method, 32);
        const double kept = largest_motion(scene, 60);
        scene.cloths[0].rest = Rest::flat;
        const double sprung = largest_motion(scene, 60);
        std::printf("[ measured ] method %d: a bowl at rest moved by %.1e m, one that is flat at rest by %.1e m\n",
                    static_cast<int>(method), kept, sprung);
        EXPECT_LE(kept, 2e-6);
        EXPECT_GT(sprung, 0.02);
    }
}

/// It hangs by half of its border, which strains it by a percent.
SceneDescription hanging_bowl(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = bowl(method, substeps);
    scene.gravity = {0, -9.81, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.damping = 1;
    cloth.stiffness = {false, 500, 100, 0};
    cloth.pins = {test::pin_box(0, 0, 8, 0)};
    return scene;
}

/// Returns the RMS distance (m) of a method from the reference after a quarter of a second.
double hanging_error(SolverMethod method, std::uint32_t substeps, const ReferenceRun& reference) {
    const SceneDescription scene = hanging_bowl(method, substeps);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 15; ++frame) twin.run_frame(frame);
    std::vector<Vec3> at;
    for (std::size_t i = 0; i < scene.cloths[0].start.size(); ++i) at.push_back(test::position_of(twin.cloth(0), i));
    return position_rms(at, reference.states[0].position);
}

TEST(RestShapeTest, AHangingBowlMovesAsTheNetworkDoes) {
    const double times[] = {0.25};
    const SpringNetwork network(hanging_bowl(SolverMethod::explicit_steps, 1), 0);
    const ReferenceRun reference = run_symplectic(network, times, {.cfl = 0.1});
    ASSERT_LE(reference.worst_error(), 1e-5);
    const double moved = position_rms(reference.states[0].position, network.rest_position);
    const double line[] = {hanging_error(SolverMethod::line, 10, reference),
                           hanging_error(SolverMethod::line, 40, reference)},
                 relax = hanging_error(SolverMethod::relax, 320, reference),
                 micro_steps = hanging_error(SolverMethod::explicit_steps, 80, reference);
    std::printf(
        "[ measured ] bowl moved by %.2e m; error of line %.2e and %.2e (10, 40 substeps), relax %.2e (320), explicit "
        "%.2e m (80)\n",
        moved, line[0], line[1], relax, micro_steps);
    EXPECT_LE(line[0], 0.1 * moved);
    EXPECT_LE(line[1], 0.5 * line[0]);
    EXPECT_LE(relax, 0.1 * moved);
    EXPECT_LE(micro_steps, 0.01 * moved);
}

}  // namespace
}  // namespace drape
