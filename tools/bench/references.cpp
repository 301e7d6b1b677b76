#include "bench/references.h"

#include <fmt/format.h>

#include <stdexcept>

#include "reference/implicit_reference.h"
#include "reference/symplectic_reference.h"

namespace drape::bench {

References::References(const std::filesystem::path& folder, std::function<void(const std::string&)> say,
                       ReferenceProgress progress)
    : cache_(folder), say_(std::move(say)), progress_(std::move(progress)) {}

const ReferenceRun& References::get(const std::string& key, const std::string& what,
                                    const std::function<ReferenceRun()>& compute) {
    if (const auto known = runs_.find(key); known != runs_.end()) return known->second;
    CachedRun result = cache_.get(key, [&] {
        if (!what.empty()) say_(what);
        ++computed_count_;
        return compute();
    });
    if (!result.store_error.empty()) say_(result.store_error);
    return runs_.emplace(key, std::move(result.run)).first->second;
}

const ReferenceRun& References::motion(const SpringNetwork& network, std::span<const double> times) {
    // The second-order error of sheets is far below 1e-5 m; large ones take the longest step that is allowed.
    // Solvers resolve a pendulum far better than its stability needs.
    const std::size_t count = network.particle_count();
    const SymplecticOptions options{count < 100 ? 0.01 : count < 5000 ? 0.2 : 0.24, progress_};
    return get(symplectic_key(network, times, options),
               fmt::format("reference motion of {} particles to {:.3g} s", count, times.back()),
               [&] { return run_symplectic(network, times, options); });
}

const ReferenceRun& References::equilibrium(const SpringNetwork& network) {
    const double times[] = {0.0};
    return get(reference_key("equilibrium 1", network, times, {}),
               fmt::format("reference equilibrium of {} particles", network.particle_count()), [&] {
                   const StaticResult result = find_equilibrium(network);
                   if (!result.converged) throw std::runtime_error("a reference equilibrium was not found");
                   ReferenceRun run{"Newton",           0,    {0.0}, {{result.position, network.start().velocity}},
                                    {result.last_step}, {0.0}};
                   for (Vec3& velocity : run.states[0].velocity) velocity = {};
                   return run;
               });
}

const ReferenceRun& References::refined(const std::string& key, const std::function<ReferenceRun()>& compute) {
    return get(key, {}, compute);
}

}  // namespace drape::bench
