// The sweeps of work of every solver: how coarse, how fine, in what steps.
#pragma once

#include <initializer_list>
#include <vector>

#include "bench/problem.h"
#include "cloth/method.h"

namespace drape::bench {

/// One iteration per substep.
std::vector<Setting> substep_settings(SolverMethod method, std::initializer_list<std::uint32_t> substeps);
/// 1 substep x many iterations.
std::vector<Setting> slides_settings(std::initializer_list<std::uint32_t> iterations);
/// Explicit micro-steps, `per_link` times the number of links per frame; from 2.61 on nothing is softened at
/// wave speed 100 m/s and 60 frames/s.
std::vector<Setting> explicit_settings(std::uint32_t links, std::initializer_list<double> per_link);

/// The method's own sweep (cloth/method.h) for `links` links along the cloth.
std::vector<Setting> sweep_settings(const Method& method, std::uint32_t links, bool quick);

/// Of every method and `auto`, for `links` links over 1 m. Relaxation needs very many substeps for the position error
/// that the others reach: those cases take longest and have a priority of their own.
std::vector<Sweep> work_sweeps(std::uint32_t links, int priority, int finest_relax_priority);
/// The same in a few settings.
std::vector<Sweep> short_sweeps(std::uint32_t links, int priority);

}  // namespace drape::bench
