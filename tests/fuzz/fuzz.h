// The fuzz targets share this header. A target is a source of this folder with one DRAPE_FUZZ_ENTRY, and its row in
// targets.tsv; `tools/fuzz` builds and runs it alone, fuzz_test replays the committed inputs through all of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "world/random.h"

/// Names the function that takes an input. libFuzzer knows one name alone; a program with all of them needs one for
/// each.
#ifdef DRAPE_FUZZ_ALONE
#define DRAPE_FUZZ_ENTRY(name) LLVMFuzzerTestOneInput
#else
#define DRAPE_FUZZ_ENTRY(name) fuzz_##name
#endif

namespace drape::fuzz {

/// A fault that was found. Nobody catches it: the fuzzer sees a crash, the replay a failed test.
class Finding : public std::logic_error {
    using std::logic_error::logic_error;
};

inline void require(bool holds, const char* what) {
    if (!holds) throw Finding(what);
}
inline void require(bool holds, const std::string& what) {
    if (!holds) throw Finding(what);
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Draws numbers from an input. Past its end they go on with a sequence that the whole input seeds, so that a few bytes
/// make a whole scene, and every further one changes a decision of it. No call draws twice in its arguments: their
/// order would be the compiler's.
class Dice {
  public:
    explicit Dice(std::span<const std::uint8_t> input) : input_(input) {
        for (const std::uint8_t byte : input) state_ = splitmix64(state_ ^ byte);
    }

    std::uint8_t byte() {
        if (input_.empty()) {
            state_ += splitmix64_step;
            return static_cast<std::uint8_t>(splitmix64(state_) >> 56);
        }
        const std::uint8_t first = input_.front();
        input_ = input_.subspan(1);
        return first;
    }
    std::uint64_t bits(int bytes) {
        std::uint64_t value = 0;
        for (int k = 0; k < bytes; ++k) value = value << 8 | byte();
        return value;
    }
    bool has_input() const { return !input_.empty(); }
    /// Returns a number from 0 to count-1, count at most 65536.
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(bits(count > 256 ? 2 : 1)) % count; }
    bool chance(double probability) { return static_cast<double>(byte()) < 256 * probability; }
    double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(bits(2)) / 65535); }
    double log_uniform(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }

  private:
    std::span<const std::uint8_t> input_;
    std::uint64_t state_ = 0;
};

}  // namespace drape::fuzz
