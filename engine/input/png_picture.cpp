#include "input/png_picture.h"

#include <cstring>

#include "input/available_memory.h"
#include "input/file_source.h"
#include "input/png_context.h"

namespace drape {

using namespace png;

namespace {

std::string read_text_chunk(spng_ctx* context) {
    std::uint32_t count = 0;
    const int result = spng_get_text(context, nullptr, &count);
    if (result == SPNG_ECHUNKAVAIL) return {};
    check(result, "count the text chunks");
    std::vector<spng_text> chunks(count);
    check(spng_get_text(context, chunks.data(), &count), "read the text chunks");
    for (const spng_text& chunk : chunks)
        if (std::strcmp(chunk.keyword, text_keyword) == 0) return {chunk.text, chunk.length};
    return {};
}

// This check precedes the allocation of memory for what the header claims.
void check_size(const spng_ihdr& header, std::size_t file_bytes) {
    constexpr std::uint64_t channels[] = {1, 0, 3, 1, 2, 0, 4};  // by colour type
    constexpr std::uint64_t most_shrunk = 1032;                  // of deflate: 258 bytes in two bits
    const std::uint64_t row_bits = channels[header.color_type] * header.bit_depth * header.width;
    const std::string what = fmt::format("PNG: a picture of {}x{} pixels", header.width, header.height);
    if (row_bits / 8 * header.height / most_shrunk > file_bytes)
        throw OutputError(fmt::format("{} is not in {} bytes", what, file_bytes));
    expect_memory(what, std::uint64_t{header.width} * header.height * 3);
}

/// Returns the decoder of the picture, whose header has been read.
Context decoder(std::span<const std::uint8_t> png, spng_ihdr& header) {
    Context context = new_context(0);
    check(spng_set_image_limits(context.get(), side_limit, side_limit), "set limits");
    check(spng_set_chunk_limits(context.get(), 1 << 20, 1 << 22), "set limits");
    check(spng_set_png_buffer(context.get(), png.data(), png.size()), "read");
    check(spng_get_ihdr(context.get(), &header), "read the header");
    check_size(header, png.size());
    return context;
}

}  // namespace

Picture decode_png(std::span<const std::uint8_t> png) {
    spng_ihdr header{};
    const Context context = decoder(png, header);
    Picture picture{header.width, header.height, {}, {}};
    picture.rgb.resize(size_t{header.width} * header.height * 3);
    check(spng_decode_image(context.get(), picture.rgb.data(), picture.rgb.size(), SPNG_FMT_RGB8, 0), "decode");
    picture.text = read_text_chunk(context.get());
    return picture;
}

Picture read_png(const std::filesystem::path& file) {
    input::FileSource source(file);
    try {
        return decode_png(source.rest());
    } catch (const OutputError& error) {
        throw input::unreadable(source.name(), error.what());
    }
}

GreyPicture decode_grey_png(std::span<const std::uint8_t> png) {
    spng_ihdr header{};
    const Context context = decoder(png, header);
    const std::size_t count = std::size_t{header.width} * header.height;
    GreyPicture picture{header.width, header.height, std::vector<float>(count)};
    if (header.color_type != SPNG_COLOR_TYPE_GRAYSCALE) {
        const std::vector<std::uint8_t> rgb = decode_png(png).rgb;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t* at = &rgb[3 * i];
            if (at[0] != at[1] || at[0] != at[2])
                throw OutputError(fmt::format("PNG: it is no grey picture: pixel {}, {} has a colour", i % header.width,
                                              i / header.width));
            picture.values[i] = static_cast<float>(at[0]) / 255.0f;
        }
    } else if (header.bit_depth == 16) {
        std::vector<std::uint16_t> samples(count);
        check(spng_decode_image(context.get(), samples.data(), 2 * count, SPNG_FMT_PNG, 0), "decode");
        for (std::size_t i = 0; i < count; ++i) picture.values[i] = static_cast<float>(samples[i]) / 65535.0f;
    } else {
        std::vector<std::uint8_t> samples(count);
        check(spng_decode_image(context.get(), samples.data(), count, SPNG_FMT_G8, 0), "decode");
        for (std::size_t i = 0; i < count; ++i) picture.values[i] = static_cast<float>(samples[i]) / 255.0f;
    }
    return picture;
}

}  // namespace drape
