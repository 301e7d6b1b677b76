#include "bench/bench_case.h"

#include <fmt/format.h>

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

}  // namespace drape::bench
