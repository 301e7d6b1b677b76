// Motion blur is the mean, in linear light, of what is seen while the shutter is open.
#include "picture/motion_blur.h"

#include <gtest/gtest.h>

#include <cmath>

#include "raster_picture.h"

namespace drape {
namespace {

TEST(PictureMean, OfEqualPicturesIsEachOfThem) {
    std::vector<std::uint8_t> picture;
    for (int level = 0; level < 256; ++level)
        for (const int alpha : {255, 128, 1})
            for (const int part : {level, 255 - level, level / 2, alpha})
                picture.push_back(static_cast<std::uint8_t>(part));
    PictureMean mean;
    for (const int count : {1, 2, 7, 256}) {
        mean.clear();
        for (int i = 0; i < count; ++i) mean.add(picture);
        EXPECT_TRUE(std::ranges::equal(mean.mean(), picture)) << count;
    }
}

TEST(PictureMean, IsOfLinearLightByWhatCoversIt) {
    PictureMean mean;
    // White and black; red that covers the pixel and blue that covers a third of it; half nothing.
    mean.add(std::vector<std::uint8_t>{255, 255, 255, 255, 255, 0, 0, 255, 90, 0, 0, 255});
    mean.add(std::vector<std::uint8_t>{0, 0, 0, 255, 0, 0, 255, 85, 200, 200, 200, 0});
    const auto level = [](double share) {
        return std::lround(srgb_byte(0) + 255 * (1.055 * std::pow(share, 1 / 2.4) - 0.055));
    };
    const std::vector<std::uint8_t> found(mean.mean().begin(), mean.mean().end());
    for (const std::size_t k : {0, 1, 2}) EXPECT_EQ(found[k], level(0.5));
    EXPECT_EQ(found[3], 255);
    EXPECT_EQ(found[4], level(0.75));
    EXPECT_EQ(found[6], level(0.25));
    EXPECT_EQ(found[7], 170);
    EXPECT_EQ(found[8], 90);
    EXPECT_EQ(found[11], 128);
}

TEST(MotionBlur, BodiesWereWhereTheyCameFrom) {
    BodyState body;
    body.position = {1, 2, 3};
    body.velocity = {0, 4, -2};
    body.angular_velocity = {0, 0, 2};
    const BodyState before = bodies_before({body}, 0.25).front();
    EXPECT_EQ(before.position, (Vec3{1, 1, 3.5}));
    EXPECT_NEAR(before.turn[2], -std::sin(0.25), 1e-15);
    EXPECT_NEAR(before.turn[3], std::cos(0.25), 1e-15);
}

}  // namespace
}  // namespace drape
