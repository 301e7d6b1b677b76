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

std::vector<Sweep> work_sweeps(std::uint32_t links, int priority, int finest_relax_priority) {
    std::vector<Setting> two_iterations;
    for (const std::uint32_t substeps : {8u, 20u, 40u}) two_iterations.push_back({SolverMethod::line, substeps, 2});
    return {{links, explicit_settings(links, {0.5, 0.707, 1, 1.414, 2, 2.61, 3.2}), priority},
            {links, substep_settings(SolverMethod::line, {4, 8, 12, 16, 20, 30, 40, 80, 160}), priority},
            {links, two_iterations, priority + 1},
            {links, substep_settings(SolverMethod::relax, {1, 2, 5, 10, 20, 40, 80, 160, 320}), priority},
            {links, slides_settings({10, 20, 40, 80, 160}), priority},
            {links, substep_settings(SolverMethod::relax, {640, 1280}), finest_relax_priority}};
}

std::vector<Sweep> short_sweeps(std::uint32_t links, int priority) {
    return {{links, explicit_settings(links, {0.5, 1, 2.61}), priority},
            {links, substep_settings(SolverMethod::line, {4, 8, 20}), priority},
            {links, substep_settings(SolverMethod::relax, {5, 20, 80}), priority},
            {links, slides_settings({10, 40}), priority}};
}

}  // namespace drape::bench
