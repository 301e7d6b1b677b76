// Whole scenes on any device, where bits say nothing: a device's roundings leave the error against a reference in
// double precision as it is, and the statistics are those of the positions.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu_test.h"
#include "reference/symplectic_reference.h"
#include "run/scene_run.h"
#include "solver/kernel_choice.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr std::uint32_t last_frame = 24;

/// A soft sheet falls from the horizontal about its upper edge.
SceneDescription falling(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = model_scenes::swing(16, 8, 90);
    scene.time.frame_count = last_frame + 1;
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    return scene;
}

std::vector<Vec3> points_of(const std::vector<glsl::vec4>& texels) {
    std::vector<Vec3> points;
    for (const glsl::vec4& texel : texels) points.push_back({texel.x, texel.y, texel.z});
    return points;
}

struct EndOfRun {
    std::vector<Vec3> positions;
    ClothStatistics statistics;
};

EndOfRun run_of(const SceneDescription& scene) {
    EndOfRun run;
    const auto keep = [&](const FinishedFrame& frame) { run.statistics = frame.statistics[0]; };
    const verify::SceneRun whole =
        verify::run_frames(test::gpu().device, scene, SimulationModel(scene), {.last = last_frame, .frame = keep});
    run.positions = points_of(whole.frames.back()[0]);
    return run;
}

class WholeScene : public testing::TestWithParam<std::pair<SolverMethod, std::uint32_t>> {
  protected:
    const SceneDescription scene = falling(GetParam().first, GetParam().second);
    const SpringNetwork network{scene, 0};
};

TEST_P(WholeScene, ErrsAsTheTwinDoes) {
    const double end[] = {last_frame / scene.time.fps};
    const ReferenceRun reference = run_symplectic(network, end);
    const SimulationModel model(scene);
    Twin twin(model, possible_kernels(test::gpu().device, model, Kernels::automatic()));
    for (std::uint32_t frame = 1; frame <= last_frame; ++frame) twin.run_frame(frame);
    const auto error_of = [&](const std::vector<Vec3>& at) { return position_rms(at, reference.states[0].position); };
    const double expected = error_of(points_of(twin.cloth(0)[Field::position])),
                 error = error_of(run_of(scene).positions);
    std::printf("[ measured ] error %.6e m, the twin's %.6e, the reference's %.1e\n", error, expected,
                reference.worst_error());
    EXPECT_LT(reference.worst_error(), 0.1 * expected);
    EXPECT_NEAR(error, expected, 0.01 * expected);
}

/// A position is rounded at a metre, which is a 16th of that of an edge: a strain is uncertain by some 1e-6.
TEST_P(WholeScene, StatisticsAreThoseOfThePositions) {
    const EndOfRun run = run_of(scene);
    const ClothStatistics& found = run.statistics;
    constexpr double strain = 4e-6;
    for (const auto& [family, of] :
         {std::pair{SpringFamily::stretch, found.stretch}, {SpringFamily::shear, found.shear}}) {
        const NetworkStrain expected = network.strain(run.positions, family);
        EXPECT_EQ(of.spring_count, expected.count);
        EXPECT_NEAR(of.rms, expected.rms, strain);
        EXPECT_NEAR(of.largest, expected.max, strain);
        EXPECT_NEAR(of.smallest, expected.min, strain);
    }
    double mass = 0;
    Vec3 sum{};
    for (std::size_t k = 0; k < run.positions.size(); ++k) {
        mass += network.mass[k];
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += network.mass[k] * run.positions[k][axis];
    }
    EXPECT_NEAR(found.mass, mass, 1e-6 * mass);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(found.center_of_mass[axis], sum[axis] / mass, 1e-6);
    EXPECT_NEAR(found.potential_energy, network.gravity_energy(run.positions), 1e-6 * mass * 9.81);
    const double elastic = network.spring_energy(run.positions) + network.bending_energy(run.positions);
    EXPECT_NEAR(found.elastic_energy, elastic, 1e-3 * elastic);
}

INSTANTIATE_TEST_SUITE_P(Of, WholeScene,
                         testing::Values(std::pair{SolverMethod::explicit_steps, 40u},
                                         std::pair{SolverMethod::relax, 40u}, std::pair{SolverMethod::line, 8u}),
                         [](const auto& about) { return "Method" + std::to_string(about.index); });

}  // namespace
}  // namespace drape
