// Generates numbers from a seed, the same on every machine.
#pragma once

#include <cstdint>

namespace drape {

inline constexpr std::uint64_t splitmix64_step = 0x9e3779b97f4a7c15u;

/// Returns the generator's number for a state (Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014). The states of a sequence are `splitmix64_step` apart.
constexpr std::uint64_t splitmix64(std::uint64_t state) {
    std::uint64_t x = state + splitmix64_step;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Maps the top 53 bits to [0, 1).
constexpr double unit_interval_of(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace drape
