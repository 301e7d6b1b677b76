// The benchmark's claims, checked against its results: the tables of errors, and who is sooner at equal error.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/problem.h"

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

/// The soonest setting of every family of every problem, for each of its targets. "relax" is the best-tuned substepped
/// relaxation; the slides' form is a family of its own.
std::vector<Soonest> find_soonest(std::span<const CaseResult> results,
                                  const std::map<std::string, std::vector<Target>>& targets);

/// The time that `auto` took, over that of the soonest measured setting of any method that keeps its tolerance.
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

/// One for every scene that auto was measured on.
std::vector<AutoRatio> auto_ratios(std::span<const CaseResult> results);

/// ms per frame.
inline double case_milliseconds(const CaseResult& result) { return case_time(result).median; }

/// Names of the cases whose time is not to be trusted: its repetitions are 30 % apart, or another case of the same
/// family took a fifth less for more passes.
std::set<std::string> doubtful_times(std::span<const CaseResult> results);

// --- Orders of convergence by least squares, and the fewest substeps that keep a limit, by bisection

/// Slope of the least-squares line through (log x, log y) of points whose x and y are positive; nothing with
/// fewer than two different x.
std::optional<double> log_slope(std::span<const std::array<double, 2>> points);

/// Neighbours' differences of values at growing x: (x_k, |y_k - y_(k+1)|). Where y = limit + c x^p with
/// doubling x, the log slope of these is p.
std::vector<std::array<double, 2>> differences(std::span<const std::array<double, 2>> points);

struct OrderFit {
    OrderClaim claim;
    std::vector<std::array<double, 2>> points;  ///< that the slope goes through: variable, value
    double slope = 0;
    bool met = false;
};

/// Fits every claim that the results have at least three points for (two differences). Sizes are the variable
/// of the cases with the most substeps of each size.
std::vector<OrderFit> fit_orders(std::span<const OrderClaim> claims, std::span<const CaseResult> results);

struct SweepPoint {
    std::uint32_t count;  ///< substeps, or iterations
    bool keeps;           ///< the limit
};

/// The count to measure next: the middle between the first count that keeps the limit and the last one before it that
/// does not (0 never does). Nothing when none keeps it, or when the two are neighbours or within 2 %.
std::optional<std::uint32_t> next_count(std::vector<SweepPoint> points);

}  // namespace drape::bench
