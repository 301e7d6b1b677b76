// Makes mutants of inputs, without what a fuzzer learns from the code that they reach: as text and as binary files have
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace drape::fuzz {

class Mutator {
  public:
    /// The inputs must outlive it; there is one at least.
    Mutator(const std::vector<std::vector<std::uint8_t>>& inputs, std::uint64_t seed) : inputs_(inputs), state_(seed) {}

    /// Returns one of the inputs with one to eight changes.
    std::vector<std::uint8_t> next();

  private:
    std::uint64_t below(std::uint64_t count);
    std::size_t place(std::size_t size) { return static_cast<std::size_t>(below(size + 1)); }
    void change(std::vector<std::uint8_t>& bytes);
    void change_bytes(std::vector<std::uint8_t>& bytes);
    void change_number(std::vector<std::uint8_t>& bytes);
    void change_block(std::vector<std::uint8_t>& bytes);

    const std::vector<std::vector<std::uint8_t>>& inputs_;
    std::uint64_t state_;
};

}  // namespace drape::fuzz
