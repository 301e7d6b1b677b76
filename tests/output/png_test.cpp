#include "output/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <random>
#include <stdexcept>
#include <string>

#include "base/output_error.h"
#include "input/png_picture.h"
#include "temporary_folder.h"

namespace drape {
namespace {

std::vector<std::uint8_t> random_rgba(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(width * 7919 + height);
    std::vector<std::uint8_t> rgba(size_t{width} * height * 4);
    for (auto& byte : rgba) byte = static_cast<std::uint8_t>(random());
    return rgba;
}

std::vector<std::uint8_t> without_alpha(const std::vector<std::uint8_t>& rgba) {
    std::vector<std::uint8_t> rgb;
    for (size_t i = 0; i < rgba.size(); ++i) {
        if (i % 4 != 3) rgb.push_back(rgba[i]);
    }
    return rgb;
}

std::vector<std::uint8_t> decode_with_libpng(const std::vector<std::uint8_t>& png) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&image, png.data(), png.size())) throw std::runtime_error(image.message);
    EXPECT_EQ(image.format, PNG_FORMAT_RGB);
    EXPECT_EQ(image.flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB, 0u);
    std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
    if (!png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr)) throw std::runtime_error(image.message);
    return rgb;
}

TEST(Png, TwoDecodersGiveThePixelsBack) {
    std::vector<std::uint8_t> png;
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 9u}, {640u, 360u}, {3u, 2u}, {257u, 1u}}) {
        const auto rgba = random_rgba(width, height);
        encode_png(width, height, rgba, png);
        EXPECT_EQ(decode_with_libpng(png), without_alpha(rgba)) << width << "x" << height;
        const Picture picture = decode_png(png);
        EXPECT_EQ(picture.width, width);
        EXPECT_EQ(picture.height, height);
        EXPECT_EQ(picture.rgb, without_alpha(rgba)) << width << "x" << height;
    }
}

/// Returns the 16-bit values of a PNG as another decoder reads them.
std::vector<std::uint16_t> decode16_with_libpng(const std::vector<std::uint8_t>& png) {
    struct Reader {
        const std::vector<std::uint8_t>& png;
        size_t at = 0;
    } reader{png};
    png_structp context = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(context);
    png_set_read_fn(context, &reader, [](png_structp from, png_bytep to, size_t count) {
        Reader& bytes = *static_cast<Reader*>(png_get_io_ptr(from));
        std::memcpy(to, bytes.png.data() + bytes.at, count);
        bytes.at += count;
    });
    png_read_png(context, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
    EXPECT_EQ(png_get_bit_depth(context, info), 16);
    std::vector<std::uint16_t> values;
    const size_t bytes = png_get_rowbytes(context, info);
    for (std::uint32_t row = 0; row < png_get_image_height(context, info); ++row) {
        const size_t from = values.size();
        values.resize(from + bytes / 2);
        std::memcpy(&values[from], png_get_rows(context, info)[row], bytes);
    }
    png_destroy_read_struct(&context, &info, nullptr);
    return values;
}

TEST(Png, NumbersOfSixteenBitsComeBack) {
    std::mt19937 random(5);
    for (const std::uint32_t channels : {1u, 3u})
        for (const auto& [width, height] : {std::pair{1u, 1u}, {37u, 20u}}) {
            std::vector<std::uint16_t> values(size_t{width} * height * channels);
            for (auto& value : values) value = static_cast<std::uint16_t>(random());
            const std::vector<std::uint8_t> png = encode_png16(width, height, channels, values);
            EXPECT_EQ(decode16_with_libpng(png), values);
            EXPECT_EQ(std::string(png.begin(), png.end()).find("sRGB"), std::string::npos);
        }
    EXPECT_THROW(encode_png16(2, 2, 1, std::vector<std::uint16_t>(3)), std::invalid_argument);
    EXPECT_THROW(encode_png16(0, 2, 1, {}), std::invalid_argument);
}

TEST(Png, SaysThatItIsSrgb) {
    std::vector<std::uint8_t> png;
    encode_png(2, 2, random_rgba(2, 2), png);
    const std::string text(png.begin(), png.end());
    EXPECT_THAT(text, testing::StartsWith("\x89PNG\r\n\x1a\n"));
    EXPECT_THAT(text, testing::HasSubstr(std::string("sRGB\0", 5)));
    EXPECT_THAT(text, testing::HasSubstr("IEND"));
}

TEST(Png, CarriesAText) {
    const auto rgba = random_rgba(9, 4);
    std::vector<std::uint8_t> png, plain;
    const std::string text = "0123456789abcdef0123456789abcdef frame 7";
    encode_png(9, 4, rgba, png, text);
    encode_png(9, 4, rgba, plain);
    EXPECT_EQ(decode_png(png).text, text);
    EXPECT_EQ(decode_png(plain).text, "");
    EXPECT_EQ(decode_with_libpng(png), without_alpha(rgba));
    // The text adds a length, type, keyword, 0, itself and a checksum, and nothing else is different.
    EXPECT_EQ(png.size(), plain.size() + 12 + 6 + text.size());
    const std::string bytes(png.begin(), png.end());
    EXPECT_THAT(bytes, testing::HasSubstr(std::string("tEXtdrape\0", 10) + text));
    const std::size_t at = bytes.find("frame 7");
    png[at] ^= 1;  // its checksum no longer fits, and no text is better than a wrong one
    EXPECT_EQ(decode_png(png).text, "");
}

TEST(Png, CompressesAFlatPicture) {
    std::vector<std::uint8_t> png;
    encode_png(640, 360, std::vector<std::uint8_t>(640 * 360 * 4, 128), png);
    EXPECT_LT(png.size(), 640u * 360 * 3 / 50);
}

TEST(Png, RefusesSizesThatDoNotFit) {
    std::vector<std::uint8_t> png;
    EXPECT_THROW(encode_png(2, 2, std::vector<std::uint8_t>(15), png), std::invalid_argument);
    EXPECT_THROW(encode_png(0, 2, {}, png), std::invalid_argument);
    EXPECT_THROW(encode_png(1, 100000, std::vector<std::uint8_t>(400000), png), std::invalid_argument);
}

TEST(Png, RefusesDamagedFiles) {
    std::vector<std::uint8_t> png;
    encode_png(16, 16, random_rgba(16, 16), png);
    EXPECT_THAT(error_text<OutputError>([&] { decode_png(std::span(png).first(png.size() / 2)); }),
                testing::StartsWith("PNG: cannot decode"));
    EXPECT_THROW(decode_png({}), OutputError);
    png[png.size() / 2] ^= 0x10;  // in the compressed pixels: the chunk's checksum no longer fits
    EXPECT_THROW(decode_png(png), OutputError);
    png[1] = 'J';
    EXPECT_THROW(decode_png(png), OutputError);
}

}  // namespace
}  // namespace drape
