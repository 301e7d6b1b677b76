#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace drape {

// An 8-bit RGB picture, rows tightly packed from the top.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgb;
};

// Encodes RGBA8 (sRGB-encoded, rows tightly packed from the top) as an RGB PNG with an sRGB chunk; alpha is
// dropped. `png` is replaced; its memory is reused. The bytes depend on the pixels alone (and on the zlib
// that is linked). Throws std::invalid_argument when the sizes do not fit, OutputError when the encoder
// fails.
void encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                std::vector<std::uint8_t>& png);

// Throws OutputError when the bytes are no PNG, are damaged, or exceed 16384 pixels a side.
Picture decode_png(std::span<const std::uint8_t> png);

}  // namespace drape
