#include "mutant.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "world/random.h"

namespace drape::fuzz {

namespace {

constexpr std::size_t most_bytes = 65536;

using Bytes = std::vector<std::uint8_t>;

auto at(Bytes& bytes, std::size_t place) { return bytes.begin() + static_cast<std::ptrdiff_t>(place); }

}  // namespace

std::uint64_t Mutator::below(std::uint64_t count) {
    state_ += splitmix64_step;
    return splitmix64(state_) % count;
}

/// Single bits and bytes: turned over, drawn, taken out, put in.
void Mutator::change_bytes(Bytes& bytes) {
    const std::size_t where = place(bytes.size() - 1);
    switch (below(4)) {
        case 0:
            bytes[where] ^= static_cast<std::uint8_t>(1u << below(8));
            break;
        case 1:
            bytes[where] = static_cast<std::uint8_t>(below(256));
            break;
        case 2:
            bytes.erase(at(bytes, where));
            break;
        case 3:
            bytes.insert(at(bytes, where), static_cast<std::uint8_t>(below(256)));
            break;
    }
}

/// A number in the text becomes an extreme one, and so do two, four or eight bytes.
void Mutator::change_number(Bytes& bytes) {
    constexpr std::string_view words[] = {"0",          "-1",   "1",     "255", "65536",       "2147483647",
                                          "4294967295", "1e30", "1e999", "nan", "-2147483648", "18446744073709551615",
                                          "",           ".",    "1e-320"};
    constexpr std::uint64_t values[] = {0,
                                        1,
                                        2,
                                        127,
                                        128,
                                        255,
                                        65535,
                                        0x7fffffff,
                                        0x80000000,
                                        0xffffffff,
                                        0x7fffffffffffffff,
                                        0xffffffffffffffff,
                                        0x7f800000,
                                        0x7fc00000};
    std::size_t where = place(bytes.size() - 1);
    if (below(2) == 0) {
        const auto is_number = [](std::uint8_t c) { return std::isdigit(c) || c == '-' || c == '.' || c == 'e'; };
        while (where < bytes.size() && !std::isdigit(bytes[where])) ++where;
        std::size_t end = where;
        while (end < bytes.size() && is_number(bytes[end])) ++end;
        const std::string_view word = words[below(std::size(words))];
        bytes.erase(at(bytes, where), at(bytes, end));
        bytes.insert(at(bytes, where), word.begin(), word.end());
        return;
    }
    const std::uint64_t value = values[below(std::size(values))];
    const bool is_big = below(2) == 0;
    const std::size_t size = std::min<std::size_t>(std::size_t{1} << below(4), bytes.size() - where);
    for (std::size_t k = 0; k < size; ++k)
        bytes[where + k] = static_cast<std::uint8_t>(value >> 8 * (is_big ? size - 1 - k : k));
}

/// A block is taken out, put in again elsewhere, or comes from another input, and the end is cut off.
void Mutator::change_block(Bytes& bytes) {
    const bool is_own = below(2) == 0;
    const Bytes& from = is_own ? Bytes(bytes) : inputs_[below(inputs_.size())];
    const std::size_t begin = place(from.size()), size = std::min<std::size_t>(from.size() - begin, 1 + below(64));
    const Bytes block(from.begin() + static_cast<std::ptrdiff_t>(begin),
                      from.begin() + static_cast<std::ptrdiff_t>(begin + size));
    const std::size_t where = place(bytes.size());
    switch (below(4)) {
        case 0:
            bytes.insert(at(bytes, where), block.begin(), block.end());
            break;
        case 1:
            std::copy_n(block.begin(), std::min(size, bytes.size() - where), at(bytes, where));
            break;
        case 2:
            bytes.erase(at(bytes, where), at(bytes, where + std::min(size, bytes.size() - where)));
            break;
        case 3:
            bytes.resize(where);
            break;
    }
}

void Mutator::change(Bytes& bytes) {
    if (bytes.empty()) {
        bytes.push_back(static_cast<std::uint8_t>(below(256)));
        return;
    }
    switch (below(3)) {
        case 0:
            change_bytes(bytes);
            break;
        case 1:
            change_number(bytes);
            break;
        case 2:
            change_block(bytes);
            break;
    }
}

Bytes Mutator::next() {
    Bytes bytes = inputs_[below(inputs_.size())];
    for (std::uint64_t changes = 1 + below(8); changes > 0; --changes) change(bytes);
    if (bytes.size() > most_bytes) bytes.resize(most_bytes);
    bytes.shrink_to_fit();
    return bytes;
}

}  // namespace drape::fuzz
