#include "world/gust.h"

#include <cmath>
#include <numbers>

#include "world/random.h"
#include "world/weather.h"

namespace drape {

std::array<double, 3> gust_phases(std::uint32_t seed) {
    std::array<double, 3> phases;
    for (std::uint64_t k = 1; k <= 3; ++k) {
        phases[k - 1] = 2 * std::numbers::pi * unit_interval_of(splitmix64(seed + k));
    }
    return phases;
}

double gust_speed(const Gust& gust, double time) {
    if (gust.amplitude == 0.0) return 0.0;
    constexpr std::array<double, 3> frequency{1.0, 2.3, 5.1};
    constexpr std::array<double, 3> weight{1.0, 0.5, 0.25};
    const std::array<double, 3> phase = gust_phases(gust.seed);
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += weight[k] * std::sin(2 * std::numbers::pi * frequency[k] * time / gust.period + phase[k]);
    return gust.amplitude * sum / 1.75;
}

Vec3 wind_velocity(const Wind& wind, double time) {
    const Vec3 v = value_at(wind.keys, wind.velocity, time);
    if (v == Vec3{0, 0, 0}) return v;
    const double factor = gust_speed(wind.gust, time) / std::hypot(v[0], v[1], v[2]);
    return {v[0] + factor * v[0], v[1] + factor * v[1], v[2] + factor * v[2]};
}

}  // namespace drape
