// Files of parts with a checksum are tried as they are, and with a valid beginning and end, to reach what is between.
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "fuzz.h"
#include "output/section_file.h"

namespace drape::fuzz {

inline std::vector<std::byte> bytes_of(const std::uint8_t* data, std::size_t size) {
    const auto all = std::as_bytes(std::span(data, size));
    return {all.begin(), all.end()};
}

/// Repairs magic, version and checksum, hurdles that only luck would take.
inline void repair(const SectionFormat& format, std::vector<std::byte>& file) {
    const std::size_t head = format.magic.size() + sizeof format.version;
    if (file.size() < head + std::tuple_size_v<SectionChecksum>) return;
    std::memcpy(file.data(), format.magic.data(), format.magic.size());
    std::memcpy(file.data() + format.magic.size(), &format.version, sizeof format.version);
    const std::size_t content = file.size() - std::tuple_size_v<SectionChecksum>;
    std::ranges::copy(section_checksum(std::span(file).first(content)),
                      file.begin() + static_cast<std::ptrdiff_t>(content));
}

}  // namespace drape::fuzz
