#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

// A file of named sections, which ends with a checksum (engine/docs/checkpoint.md).
using Sections = std::map<std::string, std::vector<std::byte>>;

struct SectionFormat {
    std::string_view magic;  // 8 bytes
    std::string_view what;   // such as "checkpoint"
    std::uint32_t version;
};

inline constexpr SectionFormat checkpoint_format{"DRAPECKP", "checkpoint", 1};
inline constexpr SectionFormat reproducer_format{"DRAPEREP", "reproducer", 1};

// A file ends with the XXH3-128, low half first, of everything before it.
using SectionChecksum = std::array<std::byte, 16>;
SectionChecksum section_checksum(std::span<const std::byte> bytes);

std::vector<std::byte> encode_sections(const SectionFormat& format, const Sections& sections);

// Throws OutputError with what is wrong, to be put behind the file's name: "is no checkpoint", "is damaged: its
// checksum does not fit" (also when it was cut short), "is a checkpoint of version 2, and this program reads 1".
Sections decode_sections(const SectionFormat& format, std::span<const std::byte> bytes);

}  // namespace drape
