#include "input/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spng.h>

#include "../support/given_files.h"
#include "base/output_error.h"

namespace drape::testing {
namespace {

using ::testing::HasSubstr;

class MapFile : public ::testing::Test {
  protected:
    GreyPicture written(const std::string& name, const std::string& bytes) const {
        write_text(folder_ / name, bytes);
        return input::read_map(folder_ / name);
    }
    std::string error(const std::string& name, const std::string& bytes) const {
        return error_text<OutputError>([&] { written(name, bytes); });
    }
    TemporaryFolder folder_;
};

/// Returns a grey PNG of one row, of 1, 8 or 16 bits.
template <class Sample>
std::string grey_row(std::uint8_t bits, const std::vector<Sample>& samples, std::uint32_t width) {
    spng_ctx* const context = spng_ctx_new(SPNG_CTX_ENCODER);
    spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
    spng_ihdr header{};
    header.width = width;
    header.height = 1;
    header.bit_depth = bits;
    header.color_type = SPNG_COLOR_TYPE_GRAYSCALE;
    spng_set_ihdr(context, &header);
    spng_encode_image(context, samples.data(), samples.size() * sizeof(Sample), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    std::size_t size = 0;
    int code = 0;
    char* const bytes = static_cast<char*>(spng_get_png_buffer(context, &size, &code));
    std::string png(bytes, size);
    std::free(bytes);
    spng_ctx_free(context);
    return png;
}

TEST_F(MapFile, GreyPicturesOfAllDepths) {
    EXPECT_EQ(written("a.png", grey_row<std::uint16_t>(16, {0, 65535, 13107}, 3)).values,
              (std::vector<float>{0, 1, 0.2f}));
    EXPECT_EQ(written("a.png", grey_row<std::uint8_t>(8, {0, 255, 51}, 3)).values, (std::vector<float>{0, 1, 0.2f}));
    EXPECT_EQ(written("a.png", grey_row<std::uint8_t>(1, {0b10100000}, 3)).values, (std::vector<float>{1, 0, 1}));
    const GreyPicture grey = written("a.PNG", grey_png(2, {0, 255, 51, 102}));
    EXPECT_EQ(grey.width, 2u);
    EXPECT_EQ(grey.height, 2u);
    EXPECT_EQ(grey.values, (std::vector<float>{0, 1, 0.2f, 0.4f}));
}

TEST_F(MapFile, Arrays) {
    EXPECT_EQ(written("a.npy", npy_of("<f4", "1, 3", std::vector<float>{0, 1, 0.25f})).values,
              (std::vector<float>{0, 1, 0.25f}));
    EXPECT_EQ(written("a.npy", npy_of("<f8", "1, 2", std::vector<double>{0.5, 1})).values,
              (std::vector<float>{0.5f, 1}));
    EXPECT_EQ(written("a.npy", npy_of("|u1", "1, 2", std::vector<std::uint8_t>{255, 51})).values,
              (std::vector<float>{1, 0.2f}));
    EXPECT_EQ(written("a.npy", npy_of("<u2", "2, 1", std::vector<std::uint16_t>{65535, 0})).values,
              (std::vector<float>{1, 0}));
    EXPECT_EQ(written("a.npy", npy_of(">u2", "1, 2", std::vector<std::uint16_t>{0xffff, 0x3333})).values,
              (std::vector<float>{1, 0.2f}));
    EXPECT_EQ(written("a.npy", npy_of(">f4", "1, 2", std::vector<std::uint32_t>{0x803f, 0x803e})).values,
              (std::vector<float>{1, 0.25f}));
    EXPECT_EQ(written("a.npy", npy_of("|b1", "1, 2", std::vector<std::uint8_t>{1, 0})).values,
              (std::vector<float>{1, 0}));
}

TEST_F(MapFile, WhatIsNoMapIsSaid) {
    EXPECT_THAT(error("a.npy", npy_of("<f4", "2", std::vector<float>{0, 1})), HasSubstr("it has float32 (2)"));
    EXPECT_THAT(error("a.npy", npy_of("<i4", "1, 1", std::vector<std::int32_t>{0})), HasSubstr("it has int32 (1, 1)"));
    EXPECT_THAT(error("a.npy", npy_of("<f4", "1, 2", std::vector<float>{0, 1.5f})), HasSubstr("at (0, 1) is 1.5"));
    EXPECT_THAT(error("a.npy", npy_of("<f4", "1, 1", std::vector<float>{NAN})), HasSubstr("at (0, 0) is nan"));
    EXPECT_THAT(error("a.png", "no picture"), HasSubstr("a.png': PNG: cannot"));
    const std::string png = grey_png(2, {0, 255, 51, 102});
    EXPECT_THAT(error("a.png", png.substr(0, png.size() - 20)), HasSubstr("a.png': PNG: cannot"));
    EXPECT_THAT(error("a.jpg", "x"), HasSubstr("maps are read from .png and .npy"));
    std::vector<std::uint8_t> colour;
    encode_png(2, 1, std::vector<std::uint8_t>{7, 7, 7, 255, 7, 8, 7, 255}, colour);
    EXPECT_THAT(error("a.png", {colour.begin(), colour.end()}), HasSubstr("pixel 1, 0 has a colour"));
}

TEST_F(MapFile, IsSampledBetweenTheMiddlesOfItsPixels) {
    const GreyPicture map{2, 2, {0, 1, 0.5f, 0.5f}};
    EXPECT_EQ(input::sampled(map, 0.25, 0.25), 0);
    EXPECT_EQ(input::sampled(map, 0.75, 0.25), 1);
    EXPECT_EQ(input::sampled(map, 0.5, 0.25), 0.5);
    EXPECT_EQ(input::sampled(map, 0.25, 0.5), 0.25);
    EXPECT_EQ(input::sampled(map, 0, 0), 0) << "the outermost pixel goes on to the border";
    EXPECT_EQ(input::sampled(map, 1, 0), 1);
    GreyPicture wide{49, 1, std::vector<float>(49)};
    for (std::size_t i = 0; i < 49; ++i) wide.values[i] = static_cast<float>((i * 31) % 49) / 49;
    for (std::size_t i = 0; i < 49; ++i)
        EXPECT_EQ(input::sampled(wide, (static_cast<double>(i) + 0.5) / 49, 0.5), wide.values[i]) << "a pixel's middle";
}

}  // namespace
}  // namespace drape::testing
