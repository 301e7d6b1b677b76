// A 64-bit hash for keys on disk: it is the same on every machine and in every version.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace drape {

/// Words are mixed one by one with the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
class StableHash {
  public:
    void add(std::uint64_t word) {
        state_ = (state_ ^ word) + 0x9e3779b97f4a7c15u;
        state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9u;
        state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111ebu;
        state_ ^= state_ >> 31;
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    /// Adds the length and the bytes.
    void add(std::string_view bytes) {
        add(std::uint64_t{bytes.size()});
        std::uint64_t word = 0;
        int filled = 0;
        for (const char c : bytes) {
            word |= std::uint64_t{static_cast<unsigned char>(c)} << (8 * filled);
            if (++filled < 8) continue;
            add(word);
            word = 0;
            filled = 0;
        }
        if (filled > 0) add(word);
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0;
};

}  // namespace drape
