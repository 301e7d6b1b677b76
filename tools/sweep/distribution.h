// A value of the scene follows one of these distributions over the runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace drape::sweep {

struct Uniform {
    double low, high;  ///< high excluded
};
struct LogUniform {
    double low, high;  ///< above 0; the logarithm is uniform
};
struct Normal {
    double mean, deviation;
    double low, high;  ///< drawn again until within
};
struct WholeNumber {
    std::int64_t low, high;  ///< both included, each as likely
};
struct Choice {
    std::vector<std::string> values;  ///< JSON, each as likely
};
/// Every combination of all grids is run, whatever the seed.
struct GridValues {
    std::vector<std::string> values;  ///< JSON
};

using Distribution = std::variant<Uniform, LogUniform, Normal, WholeNumber, Choice, GridValues>;

/// Returns the value of a random parameter in one run, as JSON. It is a pure function of the arguments, by Philox with
/// the seed as key and (index, attempt, hash of the pointer) as counter, so that other parameters and other runs do not
/// matter. Throws std::runtime_error when a normal distribution's limits are so far out that 10,000 draws miss them.
std::string drawn(const Distribution& distribution, std::uint64_t seed, std::uint32_t index,
                  const std::string& pointer);

}  // namespace drape::sweep
