#include "bench/sheet_sweeps.h"

#include <cmath>

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

}  // namespace drape::bench
