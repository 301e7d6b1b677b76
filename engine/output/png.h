#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace drape {

// Whether a PNG has the alpha channel, of straight alpha, or drops it.
enum class PngAlpha { dropped, kept };

// Encodes RGBA8 (sRGB-encoded, rows tightly packed from the top) as an RGB or RGBA PNG with an sRGB chunk.
// `png` is replaced; its memory is reused. `text`, unless empty, becomes a tEXt chunk with the keyword "drape": Latin-1
// without control characters. The bytes depend on the pixels and the text alone (and on the zlib that is linked).
// Throws std::invalid_argument when the sizes do not fit, OutputError when the encoder fails.
void encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                std::vector<std::uint8_t>& png, const std::string& text = {}, PngAlpha alpha = PngAlpha::dropped);

// Encodes 16-bit values, rows tightly packed from the top, of one channel (grey) or three (RGB), that are numbers and
// no colours. Throws as encode_png does.
std::vector<std::uint8_t> encode_png16(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                                       std::span<const std::uint16_t> values);

}  // namespace drape
