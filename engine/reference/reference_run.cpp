#include "reference/reference_run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <future>
#include <stdexcept>

namespace drape {

double ReferenceRun::worst_error() const {
    return error_estimate.empty() ? 0.0 : *std::max_element(error_estimate.begin(), error_estimate.end());
}

double position_rms(std::span<const Vec3> a, std::span<const Vec3> b) {
    if (a.size() != b.size()) throw std::invalid_argument("position_rms: different particle counts");
    double squares = 0;
    for (std::size_t p = 0; p < a.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k) squares += (a[p][k] - b[p][k]) * (a[p][k] - b[p][k]);
    return a.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(a.size()));
}

void check_times(std::span<const double> times) {
    double before = -1;
    for (const double time : times) {
        if (!std::isfinite(time) || time < 0 || time <= before)
            throw std::invalid_argument("reference times must be finite, not negative and increasing");
        before = time;
    }
}

ReferenceRun refine(std::string_view method, double step, std::span<const double> times, const StatesAtStep& states_at,
                    const ReferenceProgress& progress) {
    check_times(times);
    // The two coarse runs together take three quarters of the finest one's time, so they run beside it.
    std::atomic<bool> is_cancelled = false;
    const ReferenceProgress heed_cancel = [&is_cancelled](double) {
        if (is_cancelled) throw std::runtime_error("reference run cancelled");
    };
    std::future<std::array<std::vector<NetworkState>, 2>> coarse_runs = std::async(std::launch::async, [&] {
        return std::array{states_at(4 * step, heed_cancel), states_at(2 * step, heed_cancel)};
    });
    ReferenceRun run{std::string(method), step, {times.begin(), times.end()}, {}, {}, {}};
    try {
        run.states = states_at(step, progress);
    } catch (...) {
        is_cancelled = true;
        coarse_runs.wait();
        throw;
    }
    const auto [coarse, medium] = coarse_runs.get();
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double first = position_rms(coarse[k].position, medium[k].position);
        const double second = position_rms(medium[k].position, run.states[k].position);
        const double order = first > 0 && second > 0 ? std::log2(first / second) : 0.0;
        run.observed_order.push_back(order);
        run.error_estimate.push_back(second / (std::exp2(std::clamp(order, 0.5, 2.0)) - 1));
    }
    return run;
}

std::vector<TimeSpanEnd> span_ends(const SpringNetwork& network, std::span<const double> times) {
    std::vector<TimeSpanEnd> ends;
    for (const double time : times) ends.push_back({time, true});
    for (const double release : network.release_times())
        if (!times.empty() && release < times.back() && std::find(times.begin(), times.end(), release) == times.end())
            ends.push_back({release, false});
    std::sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    return ends;
}

}  // namespace drape
