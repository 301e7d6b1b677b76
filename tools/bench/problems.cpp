#include "bench/problem.h"

namespace drape::bench {

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
