// What the benchmark is to show, checked against its results: the tables of errors, and who is sooner at
// equal error.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/bench_case.h"

namespace drape::bench {

/// An error with the limit that it must not exceed.
struct LimitCheck {
    std::string name;  ///< of the case
    std::string metric;
    double limit = 0;
    double measured = 0;
    bool met() const { return measured <= limit; }
};

/// Errors at equal passes of a double-precision prototype of the same solvers (position errors: at least 5e-5
/// m), and the limits of the closed-form rows. Only of cases that are among the results.
std::vector<LimitCheck> check_limits(std::span<const CaseResult> results);

/// The measured setting of a family that meets a limit with the fewest passes, which decide its time and do not mind
/// what else the machine does; never interpolated.
struct Soonest {
    std::string problem;
    std::uint32_t size = 0;
    std::string metric;
    double limit = 0;
    std::string family;
    std::string name;                     ///< of the case; empty: no measured setting of the family meets the limit
    double milliseconds = 0, passes = 0;  ///< per frame
    double measured = 0;
    /// The best `relax` setting's time and passes over these: above 1, this family is sooner. 0: one of the
    /// two does not meet the limit.
    double time_ratio = 0, passes_ratio = 0;
};

/// Of every family of every problem that has targets, for each. "relax" is the best-tuned substepped relaxation; the
/// slides' form is a family of its own.
std::vector<Soonest> find_soonest(std::span<const CaseResult> results,
                                  const std::map<std::string, std::vector<Target>>& targets);

/// What `auto` took, over the soonest measured setting of any method that keeps its tolerance.
struct AutoRatio {
    std::string problem;
    std::uint32_t size = 0;
    double tolerance = 0;     ///< that auto is to keep: the scene's, or 1 %
    double worst_error = 0;   ///< of auto
    double milliseconds = 0;  ///< of auto, per frame, on the wall's clock, like the soonest's
    std::string best;         ///< the soonest's case; empty: no other setting keeps the tolerance
    double best_milliseconds = 0;
    bool met() const { return worst_error <= tolerance; }
    double ratio() const { return best.empty() ? 0 : milliseconds / best_milliseconds; }
};

/// Of every scene that auto was measured on.
std::vector<AutoRatio> auto_ratios(std::span<const CaseResult> results);

/// ms per frame.
inline double case_milliseconds(const CaseResult& result) { return case_time(result).median; }

/// Names of the cases whose time is not to be trusted: its repetitions are 30 % apart, or another case of the same
/// family took a fifth less for more passes.
std::set<std::string> doubtful_times(std::span<const CaseResult> results);

}  // namespace drape::bench
