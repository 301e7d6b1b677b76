#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace drape {

// An 8-bit RGB picture, rows tightly packed from the top.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgb;
    std::string text;  // content of the tEXt chunk with the keyword "drape"; empty when there is none
};

// Encodes RGBA8 (sRGB-encoded, rows tightly packed from the top) as an RGB PNG with an sRGB chunk; alpha is dropped.
// `png` is replaced; its memory is reused. `text`, unless empty, becomes a tEXt chunk with the keyword "drape": Latin-1
// without control characters. The bytes depend on the pixels and the text alone (and on the zlib that is linked).
// Throws std::invalid_argument when the sizes do not fit, OutputError when the encoder fails.
void encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                std::vector<std::uint8_t>& png, const std::string& text = {});

// Throws OutputError when the bytes are no PNG, are damaged, exceed 16384 pixels a side, or say that they are a picture
// that cannot be in so few, or not in memory.
Picture decode_png(std::span<const std::uint8_t> png);
// Reads a picture from a file, which the error names.
Picture read_png(const std::filesystem::path& file);

}  // namespace drape
