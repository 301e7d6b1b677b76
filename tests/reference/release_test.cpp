// The centre of mass of cloth that is let go falls as the closed form says, to second order in the substep.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double damping = 12, settled = 3;  // 1/s, s: hangs still to 1e-8

/// Height (m) of the centre of mass.
double height(const SimulationModel& model, const Twin& twin) {
    double moment = 0, mass = 0;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
        const double m = 1 / double(model.cloths[0].free_weight[i]);
        mass += m;
        moment += m * double(twin.cloth(0)[Field::position][i].y);
    }
    return moment / mass;
}

/// Returns by how much (m) a hanging cloth falls too far, let go `late` seconds after frame 180, 30 frames on.
double fall_error(SceneDescription scene, SolverMethod method, std::uint32_t substeps, double late) {
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    scene.time.frame_count = 211;
    scene.cloths[0].damping = damping;
    scene.cloths[0].pins[0].release = settled + late;
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 180; ++frame) twin.run_frame(frame);
    const double start = height(model, twin);
    for (std::uint32_t frame = 181; frame <= 210; ++frame) twin.run_frame(frame);
    const double time = 0.5 - late, terminal = 9.81 / damping;
    return start - height(model, twin) - (terminal * time + terminal * std::expm1(-damping * time) / damping);
}

SceneDescription hanging(std::uint32_t columns, std::uint32_t rows) {
    SceneDescription scene = test::sheet(columns, rows, 0.1 * (columns - 1), 0.1 * (rows - 1), 1);
    scene.cloths[0].stiffness = {false, 200, 20, 0};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    return scene;
}

constexpr SolverMethod every_method[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

std::vector<double> errors(const SceneDescription& scene, SolverMethod method, double late) {
    std::vector<double> all;
    std::string line;
    for (const std::uint32_t substeps : {1u, 2u, 4u, 8u, 16u}) {
        all.push_back(fall_error(scene, method, substeps, late));
        line += std::to_string(1e6 * all.back()) + " ";
    }
    std::printf("[ measured ] %ux%u, %s, let go %.4f s after a frame: falls too far by %sum\n", scene.cloths[0].grid[0],
                scene.cloths[0].grid[1], std::string(named(method).name).c_str(), late, line.c_str());
    return all;
}

TEST(ReleaseTest, AHangingClothThatIsLetGoFallsToSecondOrder) {
    for (const auto& [columns, rows] : {std::pair{5u, 9u}, {2u, 9u}})
        for (const SolverMethod method : every_method) {
            const std::vector<double> error = errors(hanging(columns, rows), method, 0);
            for (std::size_t k = 1; k < error.size(); ++k)
                EXPECT_LE(std::abs(error[k]), std::abs(error[k - 1]) / 3.5 + 2e-6);
            EXPECT_LE(std::abs(error[0]), 2e-3);  // half a substep would be 6.8e-3
        }
}

TEST(ReleaseTest, BetweenSubstepsToo) {
    for (const SolverMethod method : every_method) {
        const std::vector<double> error = errors(hanging(5, 9), method, 0.4 / 60);
        for (std::size_t k = 0; k < error.size(); ++k) {
            const double substeps = std::exp2(k);
            EXPECT_LE(std::abs(error[k]), 5e-3 / (substeps * substeps) + 2e-6);
        }
    }
}

}  // namespace
}  // namespace drape
