#include "output/png.h"

#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>

#include "input/png_context.h"

namespace drape {

using namespace png;

namespace {

int append_bytes(spng_ctx*, void* user, void* source, size_t length) noexcept {
    auto& png = *static_cast<std::vector<std::uint8_t>*>(user);
    const auto* bytes = static_cast<const std::uint8_t*>(source);
    try {
        png.insert(png.end(), bytes, bytes + length);
    } catch (const std::bad_alloc&) {  // it must not unwind through C
        return SPNG_EMEM;
    }
    return 0;
}

// The encoder keeps the pointer: `text` must live until the picture is encoded.
void set_text(spng_ctx* context, std::string& text) {
    if (text.empty()) return;
    spng_text chunk{};
    std::strcpy(chunk.keyword, text_keyword);
    chunk.type = SPNG_TEXT;
    chunk.length = text.size();
    chunk.text = text.data();
    check(spng_set_text(context, &chunk, 1), "set the text chunk");
}

// Throws std::invalid_argument where `count` is not that of a picture's values.
void check_size(std::uint32_t width, std::uint32_t height, size_t expected, size_t count) {
    if (width == 0 || height == 0 || width > side_limit || height > side_limit) {
        throw std::invalid_argument(fmt::format("PNG: size {}x{} is not in 1..{}", width, height, side_limit));
    }
    if (count != expected)
        throw std::invalid_argument(
            fmt::format("PNG: {}x{} pixels need {} bytes, got {}", width, height, expected, count));
}

// Begins an encoder to a vector of bytes, which must outlive it.
Context new_encoder(std::uint32_t width, std::uint32_t height, spng_color_type type, std::uint8_t bits,
                    std::vector<std::uint8_t>& png) {
    Context context = new_context(SPNG_CTX_ENCODER);
    spng_ihdr header{};
    header.width = width;
    header.height = height;
    header.bit_depth = bits;
    header.color_type = static_cast<std::uint8_t>(type);
    check(spng_set_png_stream(context.get(), append_bytes, &png), "set the stream");
    check(spng_set_ihdr(context.get(), &header), "set the header");
    return context;
}

// `take(target)` makes the next row.
template <class Value>
void encode_rows(spng_ctx* context, std::uint32_t height, size_t row_values,
                 const std::function<void(Value* target)>& take) {
    // Measured at 1080p on smooth, checkered and unevenly lit pictures, level 1 without filters takes 15 to 23 ms for
    // 300 to 600 KB; with the sub or up filter 25 to 40 ms for 370 to 860 KB; level 6 with sub 81 ms. Pictures without
    // noise repeat pixels exactly, which a filter hides from level 1's short search.
    check(spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, 1), "set the level");
    check(spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_NONE), "set the filter");
    check(spng_encode_image(context, nullptr, 0, SPNG_FMT_PNG, SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE),
          "begin");
    std::vector<Value> row(row_values);
    for (std::uint32_t y = 0; y < height; ++y) {
        take(row.data());
        const int result = spng_encode_row(context, row.data(), row.size() * sizeof(Value));
        if (result != SPNG_EOI || y + 1 != height) check(result, "encode a row");
    }
}

}  // namespace

void encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                std::vector<std::uint8_t>& png, const std::string& text, PngAlpha alpha) {
    check_size(width, height, size_t{width} * height * 4, rgba.size());
    png.clear();
    const bool kept = alpha == PngAlpha::kept;
    const Context context =
        new_encoder(width, height, kept ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR, 8, png);
    check(spng_set_srgb(context.get(), 0), "set the sRGB chunk");
    std::string kept_text = text;  // the encoder's structure wants it not const
    set_text(context.get(), kept_text);
    const size_t channels = kept ? 4 : 3;
    const std::uint8_t* from = rgba.data();
    encode_rows<std::uint8_t>(context.get(), height, width * channels, [&](std::uint8_t* target) {
        for (std::uint32_t x = 0; x < width; ++x, from += 4, target += channels) std::copy_n(from, channels, target);
    });
}

std::vector<std::uint8_t> encode_png16(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                                       std::span<const std::uint16_t> values) {
    const size_t row = size_t{width} * channels;
    check_size(width, height, row * height * sizeof values[0], values.size_bytes());
    std::vector<std::uint8_t> png;
    const Context context =
        new_encoder(width, height, channels == 1 ? SPNG_COLOR_TYPE_GRAYSCALE : SPNG_COLOR_TYPE_TRUECOLOR, 16, png);
    const std::uint16_t* from = values.data();
    encode_rows<std::uint16_t>(context.get(), height, row, [&](std::uint16_t* target) {
        std::copy_n(from, row, target);
        from += row;
    });
    return png;
}

}  // namespace drape
