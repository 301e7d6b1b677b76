// Double-precision references of the benchmark's problems, kept on disk and in memory.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>

#include "reference/reference_cache.h"
#include "reference/spring_network.h"

namespace drape::bench {

class References {
  public:
    /// `say` is told what is being computed (a line each), since a reference may take minutes; `progress` its
    /// fraction, and may throw to stop.
    References(const std::filesystem::path& folder, std::function<void(const std::string&)> say,
               ReferenceProgress progress);

    /// Converged motion at `times` (s), by symplectic Verlet.
    const ReferenceRun& motion(const SpringNetwork& network, std::span<const double> times);
    /// Static equilibrium, one state, its error estimate the last Newton step. Throws std::runtime_error when
    /// Newton's method does not converge.
    const ReferenceRun& equilibrium(const SpringNetwork& network);

    /// Returns a reference whose run says itself what it is doing.
    const ReferenceRun& refined(const std::string& key, const std::function<ReferenceRun()>& compute);

    std::size_t computed_count() const { return computed_count_; }  ///< not found on disk

  private:
    const ReferenceRun& get(const std::string& key, const std::string& what,
                            const std::function<ReferenceRun()>& compute);

    ReferenceCache cache_;
    std::function<void(const std::string&)> say_;
    ReferenceProgress progress_;
    std::map<std::string, ReferenceRun> runs_;
    std::size_t computed_count_ = 0;
};

}  // namespace drape::bench
