// Writes values one after another as little-endian bytes and reads them back, as checkpoints keep objects. A function
// that hands its members to an archive, `archive(a, b, ...)`, serves both ways.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "drape/error.h"

namespace drape {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

template <class T>
concept PlainNumber = std::is_arithmetic_v<T> && !std::same_as<T, bool>;
/// std::vector, std::deque and std::string are sequences.
template <class T>
concept Sequence = requires(T sequence) {
    sequence.push_back(sequence.front());
    sequence.size();
};

class ByteWriter {
  public:
    template <class... Values>
    void operator()(const Values&... values) {
        (put(values), ...);
    }
    std::vector<std::byte> take() { return std::move(bytes_); }
    std::size_t size() const { return bytes_.size(); }

    void put_bytes(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

  private:
    template <PlainNumber T>
    void put(T value) {
        put_bytes(std::as_bytes(std::span(&value, 1)));
    }
    void put(bool value) { put(std::uint8_t{value}); }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value) put(*value);
    }
    template <Sequence T>
    void put(const T& values) {
        put(std::uint64_t{values.size()});
        for (const auto& value : values) put(value);
    }

    std::vector<std::byte> bytes_;
};

/// Throws Error where fewer bytes are left than asked for.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class... Values>
    void operator()(Values&... values) {
        (get(values), ...);
    }
    std::size_t left() const { return bytes_.size(); }
    std::span<const std::byte> get_bytes(std::uint64_t count) {
        if (count > bytes_.size()) throw Error("it ends too early");
        const auto taken = bytes_.first(static_cast<std::size_t>(count));
        bytes_ = bytes_.subspan(taken.size());
        return taken;
    }

  private:
    template <PlainNumber T>
    void get(T& value) {
        std::memcpy(&value, get_bytes(sizeof value).data(), sizeof value);
    }
    void get(bool& value) {
        std::uint8_t byte = 0;
        get(byte);
        value = byte != 0;
    }
    template <class T>
    void get(std::optional<T>& value) {
        bool has_value = false;
        get(has_value);
        value.reset();
        if (has_value) get(value.emplace());
    }
    template <Sequence T>
    void get(T& values) {
        std::uint64_t count = 0;
        get(count);
        if (count > bytes_.size()) throw Error("it ends too early");  // an element has a byte at least
        values.clear();
        for (; count > 0; --count) {
            typename T::value_type value{};
            get(value);
            values.push_back(value);
        }
    }

    std::span<const std::byte> bytes_;
};

}  // namespace drape
