// Reads pictures.
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

// Throws OutputError when the bytes are no PNG, are damaged, exceed 16384 pixels a side, or say that they are a picture
// that cannot be in so few, or not in memory.
Picture decode_png(std::span<const std::uint8_t> png);
// Reads a picture from a file, which the error names.
Picture read_png(const std::filesystem::path& file);

// A picture of numbers from 0, black, to 1, white, row by row from the top.
struct GreyPicture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> values;
};

// Decodes a grey PNG of up to 16 bits, or one of colours that are all grey: samples over the largest one, as they are,
// without gamma. Throws OutputError as `decode_png`, and for colours.
GreyPicture decode_grey_png(std::span<const std::uint8_t> png);

}  // namespace drape
