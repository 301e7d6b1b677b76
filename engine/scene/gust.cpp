#include "scene/gust.h"

#include <cmath>
#include <numbers>

namespace drape {
namespace {

// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
std::uint64_t splitmix64(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

}  // namespace

std::array<double, 3> gust_phases(std::uint32_t seed) {
    std::array<double, 3> phases;
    for (std::uint64_t k = 1; k <= 3; ++k) {
        const auto bits = static_cast<double>(splitmix64(seed + k) >> 11);
        phases[k - 1] = 2 * std::numbers::pi * (bits * 0x1p-53);
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
    if (!wind.blows()) return {0, 0, 0};
    const Vec3& v = wind.velocity;
    const double factor = gust_speed(wind.gust, time) / std::hypot(v[0], v[1], v[2]);
    return {v[0] + factor * v[0], v[1] + factor * v[1], v[2] + factor * v[2]};
}

}  // namespace drape
