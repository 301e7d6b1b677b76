#include "sweep/distribution.h"

#include <Random123/philox.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "output/atomic_file.h"

namespace drape::sweep {

namespace {

/// Draws the numbers of one parameter in one run.
class Numbers {
  public:
    Numbers(std::uint64_t seed, std::uint32_t index, const std::string& pointer)
        : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}, index_(index) {
        const std::string hash = xxh3_128_hex(pointer);
        for (std::size_t i = 0; i < 2; ++i)
            pointer_[i] = static_cast<std::uint32_t>(std::stoull(hash.substr(8 * i, 8), nullptr, 16));
    }

    /// Returns two numbers in [0, 1), of 53 bits each.
    std::array<double, 2> pair() {
        const r123::Philox4x32::ctr_type words =
            r123::Philox4x32{}({{index_, attempt_++, pointer_[0], pointer_[1]}}, {{key_[0], key_[1]}});
        return {fraction(words[0], words[1]), fraction(words[2], words[3])};
    }

  private:
    static double fraction(std::uint32_t high, std::uint32_t low) {
        return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1p-53;
    }

    std::array<std::uint32_t, 2> key_, pointer_{};
    std::uint32_t index_, attempt_ = 0;
};

/// Writes the fewest digits that read back as the same number.
std::string written(double value) { return fmt::format("{}", value); }

/// Draws a normal number by G. Box and M. Muller, 1958.
double normal_number(const Normal& normal, Numbers& numbers) {
    for (int attempt = 0; attempt < 10'000; ++attempt) {
        const auto [a, b] = numbers.pair();
        const double value =
            normal.mean + normal.deviation * std::sqrt(-2 * std::log(1 - a)) * std::cos(2 * std::numbers::pi * b);
        if (value >= normal.low && value <= normal.high) return value;
    }
    throw std::runtime_error("10,000 draws of a normal distribution were not within its limits");
}

std::size_t position(std::size_t count, Numbers& numbers) {
    return static_cast<std::size_t>(numbers.pair()[0] * static_cast<double>(count));
}

}  // namespace

std::string drawn(const Distribution& distribution, std::uint64_t seed, std::uint32_t index,
                  const std::string& pointer) {
    Numbers numbers(seed, index, pointer);
    struct Draw {
        Numbers& numbers;
        std::string operator()(const Uniform& range) const {
            return written(range.low + numbers.pair()[0] * (range.high - range.low));
        }
        std::string operator()(const LogUniform& range) const {
            const double low = std::log(range.low);
            return written(std::exp(low + numbers.pair()[0] * (std::log(range.high) - low)));
        }
        std::string operator()(const Normal& normal) const { return written(normal_number(normal, numbers)); }
        std::string operator()(const WholeNumber& range) const {
            const auto count = static_cast<std::size_t>(range.high - range.low + 1);
            return fmt::format("{}", range.low + static_cast<std::int64_t>(position(count, numbers)));
        }
        std::string operator()(const Choice& choice) const {
            return choice.values[position(choice.values.size(), numbers)];
        }
        std::string operator()(const GridValues&) const { throw std::logic_error("a grid is not drawn"); }
    };
    return std::visit(Draw{numbers}, distribution);
}

}  // namespace drape::sweep
