// Scenes drawn from a seed, for what `auto` chooses: the laws it chooses by were not tuned on them.
#include <algorithm>

#include "bench/problem.h"
#include "bench/random_scenes.h"
#include "bench/sheet_sweeps.h"

namespace drape::bench {

namespace {

constexpr double tolerance = 0.01;

/// The laws of solver_choice.cpp were measured on scenes of seeds 1001 to 1010; these are others.
constexpr std::uint32_t first_seed = 2000;

SceneDescription scene_number(std::uint32_t number) {
    SceneDescription scene = random_scene(first_seed + number);
    scene.solver.tolerance = tolerance;
    return scene;
}

Metrics worst_stretch(const Recording& run, References&) {
    Metrics metrics{{"worst_stretch_error", 0}};
    put_substeps(run.samples, metrics);
    for (const Sample& sample : run.samples)
        metrics["worst_stretch_error"] = std::max(metrics["worst_stretch_error"], sample.statistics.stretch_error_rms);
    return metrics;
}

}  // namespace

std::vector<Problem> random_problems(bool is_short) {
    if (is_short) return {};  // three minutes have no room for twelve settings of a scene
    Problem problem{.name = "random",
                    .title = "Scenes drawn from a seed, tolerance 1 %",
                    .metric = "worst_stretch_error",
                    .unit = "1"};
    problem.strain_damping = SolverSettings{}.strain_damping;
    problem.scene = [](std::uint32_t number, const Setting&) { return scene_number(number); };
    problem.evaluate = worst_stretch;
    problem.targets = {{"worst_stretch_error", tolerance}};
    for (std::uint32_t number = 1; number <= 20; ++number) {
        std::vector<Setting> line, relax;
        for (const std::uint32_t substeps : {2u, 4u, 7u, 12u, 20u}) line.push_back({SolverMethod::line, substeps, 32});
        for (const std::uint32_t substeps : {20u, 40u, 80u}) relax.push_back({SolverMethod::relax, substeps, 1});
        const SceneDescription scene = scene_number(number);
        const std::uint32_t links = std::max(scene.cloths[0].grid[0], scene.cloths[0].grid[1]) - 1;
        problem.sweeps.push_back({number, {{SolverMethod::automatic, 1, 1}}, 5});
        problem.sweeps.push_back({number, line, 5});
        problem.sweeps.push_back({number, relax, 5});
        problem.sweeps.push_back({number, explicit_settings(links, {0.5, 1, 2}), 5});
    }
    return {problem};
}

}  // namespace drape::bench
