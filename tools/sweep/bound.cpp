#include "sweep/bound.h"

#include <fmt/format.h>
#include <sys/resource.h>

namespace drape::sweep {

namespace {

/// Returns the processor time, s, of children that have ended.
double used_by_children() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

Occupancy::Occupancy(unsigned cores) : cores_(cores), used_(used_by_children()) {}

std::string Occupancy::text() const {
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    constexpr double long_enough = 10;
    return passed < long_enough ? "" : bound_text(used_by_children() - used_, passed, cores_);
}

std::string bound_text(double used, double passed, unsigned cores) {
    constexpr double busy = 0.8;
    const double share = used / (passed * cores);
    const std::string cores_text = cores == 1 ? "the core was" : fmt::format("{} cores were", cores);
    return fmt::format(
        "{} {:.0f} % busy: {}", cores_text, 100 * share,
        share >= busy ? "the processors bounded the time" : "the device, other programs or the disk bounded the time");
}

}  // namespace drape::sweep
