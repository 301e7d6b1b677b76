// A double-precision reference hands over states at the times asked for, each with its own error estimate.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/spring_network.h"

namespace drape {

struct ReferenceRun {
    std::string method;                ///< name of the integrator, for reports
    double step = 0;                   ///< s, longest step of the finest run (whose states these are)
    std::vector<double> times;         ///< s
    std::vector<NetworkState> states;  ///< per time
    /// Per time the RMS over particles of the position error (m), estimated from runs at the double and fourfold step
    /// by their difference from the finest, over 2^p - 1 with the order p that they show (between 0.5 and 2).
    std::vector<double> error_estimate;
    /// Per time the order p, log2 of the ratio of the two differences; 0 where both are rounding.
    std::vector<double> observed_order;

    double worst_error() const;
};

/// RMS over particles of |a - b|, m.
double position_rms(std::span<const Vec3> a, std::span<const Vec3> b);

/// The callback gets the fraction done (0..1), on the calling thread only. It may throw to stop the run.
using ReferenceProgress = std::function<void(double)>;

/// Returns states at given times, integrated with steps of at most `step` seconds. It is called from several threads at
/// once.
using StatesAtStep = std::function<std::vector<NetworkState>(double step, const ReferenceProgress& progress)>;

/// Runs at 4, 2 and 1 times `step`, the coarse ones on a second thread, and estimates the finest run's error from the
/// differences. `progress` follows the finest run.
ReferenceRun refine(std::string_view method, double step, std::span<const double> times, const StatesAtStep& states_at,
                    const ReferenceProgress& progress);

/// Throws std::invalid_argument unless times are finite, >= 0 and strictly increasing.
void check_times(std::span<const double> times);

/// Times at which the free set changes or a state is asked for: `times` and the network's releases before the last.
struct TimeSpanEnd {
    double time;
    bool wanted;  ///< a state is asked for here
};
std::vector<TimeSpanEnd> span_ends(const SpringNetwork& network, std::span<const double> times);

}  // namespace drape
