// The table of problems, their sweeps, and scenes drawn from a seed.
#include <algorithm>
#include <cmath>

#include "bench/problem.h"
#include "bench/random_scenes.h"

namespace drape::bench {

std::vector<Setting> substep_settings(SolverMethod method, std::initializer_list<std::uint32_t> substeps) {
    std::vector<Setting> settings;
    for (const std::uint32_t count : substeps) settings.push_back({method, count, 1});
    return settings;
}

std::vector<Setting> slides_settings(std::initializer_list<std::uint32_t> iterations) {
    std::vector<Setting> settings;
    for (const std::uint32_t count : iterations) settings.push_back({SolverMethod::relax, 1, count});
    return settings;
}

std::vector<Setting> explicit_settings(std::uint32_t links, std::initializer_list<double> per_link) {
    std::vector<Setting> settings;
    for (const double factor : per_link)
        settings.push_back({SolverMethod::explicit_steps, static_cast<std::uint32_t>(std::lround(links * factor)), 1});
    return settings;
}

std::vector<Setting> sweep_settings(const Method& method, std::uint32_t links, bool quick) {
    std::vector<Setting> settings;
    for (const double count : quick ? method.sweep.quick : method.sweep.full)
        settings.push_back(
            {method.method, static_cast<std::uint32_t>(std::lround(method.sweep.per_link ? links * count : count)), 1});
    return settings;
}

std::vector<Sweep> work_sweeps(std::uint32_t links, int priority, int finest_relax_priority) {
    std::vector<Sweep> sweeps;
    for (const Method& method : methods()) sweeps.push_back({links, sweep_settings(method, links, false), priority});
    sweeps.push_back({links, {{SolverMethod::automatic, 1, 1}}, priority});
    std::vector<Setting> two_iterations;
    for (const std::uint32_t substeps : {8u, 20u, 40u}) two_iterations.push_back({SolverMethod::line, substeps, 2});
    sweeps.push_back({links, two_iterations, priority + 1});
    sweeps.push_back({links, slides_settings({10, 20, 40, 80, 160}), priority});
    sweeps.push_back({links, substep_settings(SolverMethod::relax, {640, 1280}), finest_relax_priority});
    return sweeps;
}

std::vector<Sweep> short_sweeps(std::uint32_t links, int priority) {
    std::vector<Sweep> sweeps;
    for (const Method& method : methods()) sweeps.push_back({links, sweep_settings(method, links, true), priority});
    sweeps.push_back({links, {{SolverMethod::automatic, 1, 1}}, priority});
    sweeps.push_back({links, slides_settings({10, 40}), priority});
    return sweeps;
}

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

/// Scenes for what `auto` chooses: the laws it chooses by were not tuned on them.
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

}  // namespace

std::vector<Problem> all_problems(bool is_short) {
    std::vector<Problem> problems;
    for (auto group :
         {flight_problems(is_short), chain_problems(is_short), sheet_problems(is_short), random_problems(is_short)})
        problems.insert(problems.end(), group.begin(), group.end());
    return problems;
}

std::vector<OrderClaim> order_claims() {
    using enum OrderClaim::Variable;
    using enum OrderClaim::Kind;
    const std::string relax(named(SolverMethod::relax).name), line(named(SolverMethod::line).name),
        explicit_steps(named(SolverMethod::explicit_steps).name);
    std::vector<OrderClaim> claims = {
        {"pendulum", relax, "period_error", substeps, -1, 0.25, 1e-6, 0.05, 1},
        {"pendulum", relax, "energy_lost_per_period", substeps, -1, 0.25, 1e-6, 0.3, 1},
        {"pendulum", explicit_steps, "position_rms", substeps, -2, 0.25, 3e-6, 2e-4, 1},
        {"pendulum", line, "position_rms", substeps, -2, 0.25, 3e-6, 2e-2, 1},
        {"free fall", line, "position_relative", substeps, -2, 0.5, 1e-7, 1, 2},
        {"swing energy", relax, "energy_error", substeps, -1, 0.35, 1e-4, 0.6, 32},
        {"column law", relax, "stretch_mean", substeps, -2, 0.05, 0, 1, 64},
        {"column law", relax, "stretch_mean", size, 2, 0.05, 0, 1},
        {"catenary", explicit_steps, "position_rms", size, -2, 0.25, 1e-6, 1},
        {"cantilever 1", explicit_steps, "ratio", size, -2, 0.25, 0, 1e300, 0, differences},
        {"cantilever 100", explicit_steps, "ratio", size, -2, 0.25, 0, 1e300, 0, differences},
        {"swing", relax, "stretch_error", substeps, -2, 0.3, 3e-4, 0.2, 128},
        // The clamp softens by (P_full/P)^2 - 1: of second order while that is far above 0.
        {"swing", explicit_steps, "stretch_error", substeps, -2, 0.6, 2e-3, 0.2, 128}};
    // The third mode of eight links is no hanging chain's.
    for (const auto& [metric, least] : {std::pair{"frequency_1", 8.0}, {"frequency_2", 8.0}, {"frequency_3", 16.0}})
        claims.push_back({"chain modes", explicit_steps, metric, size, -2, 0.25, 0, 1e300, 0, differences, least});
    return claims;
}

}  // namespace drape::bench
