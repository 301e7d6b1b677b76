#include "bench/bench_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace drape::bench {

std::string setting_name(const Setting& setting) {
    if (setting.method == SolverMethod::automatic) return "chosen";
    return setting.iterations == 1 ? fmt::format("{}", setting.substeps)
                                   : fmt::format("{}x{}", setting.substeps, setting.iterations);
}

std::string family_name(SolverMethod asked, std::uint32_t substeps, std::uint32_t iterations) {
    const std::string method(named(asked).name);
    if (iterations == 1) return method;
    return substeps == 1 ? method + ", 1 substep x iterations" : fmt::format("{}, {} iterations", method, iterations);
}

Timing timing_of(std::vector<double> repetitions) {
    std::ranges::sort(repetitions);
    const std::size_t half = repetitions.size() / 2;
    const double middle =
        repetitions.size() % 2 == 1 ? repetitions[half] : 0.5 * (repetitions[half - 1] + repetitions[half]);
    return {middle, repetitions.front(), middle > 0 ? (repetitions.back() - repetitions.front()) / middle : 0};
}

const Timing& case_time(const CaseResult& result) {
    if (result.wall.median == 0) return result.device;
    const bool is_whole = result.method != SolverMethod::automatic;
    const bool is_possible = result.device.median > 0 && result.device.median <= result.wall.median;
    return is_whole && is_possible ? result.device : result.wall;
}

}  // namespace drape::bench
