#include "picture/textures.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace drape {
namespace {

constexpr std::uint32_t most_side = 2048;

/// A picture of linear colours.
struct Light {
    std::uint32_t width, height;
    std::vector<std::array<double, 3>> at;
};

Light linear_light(const TextureImage& image) {
    std::array<double, 256> linear{};
    for (std::size_t level = 0; level < linear.size(); ++level) {
        const double shown = static_cast<double>(level) / 255;
        linear[level] = shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
    }
    Light light{image.width, image.height, {}};
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
        light.at.push_back({linear[image.rgb[i]], linear[image.rgb[i + 1]], linear[image.rgb[i + 2]]});
    return light;
}

/// Returns the picture with so many columns and its rows as columns: twice, it has another size.
Light resampled_and_turned(const Light& from, std::uint32_t columns) {
    Light to{from.height, columns, {}};
    to.at.resize(std::size_t{columns} * from.height);
    const double step = static_cast<double>(from.width) / columns;
    for (std::uint32_t column = 0; column < columns; ++column)
        for (std::uint32_t row = 0; row < from.height; ++row) {
            const double begin = column * step, end = begin + step;
            std::array<double, 3>& mean = to.at[std::size_t{column} * from.height + row];
            for (auto x = static_cast<std::uint32_t>(begin); x < std::min<double>(end, from.width); ++x) {
                const double share = (std::min(end, x + 1.0) - std::max<double>(begin, x)) / step;
                for (std::size_t k = 0; k < 3; ++k) mean[k] += share * from.at[std::size_t{row} * from.width + x][k];
            }
        }
    return to;
}

Light resampled(const Light& from, std::uint32_t width, std::uint32_t height) {
    return resampled_and_turned(resampled_and_turned(from, width), height);
}

void append(const Light& light, std::vector<glsl::uint>& halves) {
    for (const std::array<double, 3>& color : light.at) {
        halves.push_back(half_float(color[0]) | std::uint32_t{half_float(color[1])} << 16);
        halves.push_back(half_float(color[2]));
    }
}

}  // namespace

std::uint16_t half_float(double value) {
    if (value < std::ldexp(1, -14)) return static_cast<std::uint16_t>(std::lround(std::ldexp(value, 24)));
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);  // 0.5 .. 1
    // What is rounded up to the next power of two carries into the exponent.
    return static_cast<std::uint16_t>(((exponent + 14) << 10) + std::lround(std::ldexp(mantissa, 11)) - 1024);
}

Textures::Textures(const std::vector<Cloth>& cloths) {
    for (const Cloth& cloth : cloths)
        if (cloth.appearance.image &&
            std::ranges::find(stored_, cloth.appearance.image, &Stored::image) == stored_.end())
            store(cloth.appearance.image);
}

void Textures::store(SharedTexture image) {
    const auto side = [](std::uint32_t pixels) { return std::min(std::bit_ceil(pixels), most_side); };
    const std::uint32_t width = side(image->width), height = side(image->height);
    Light level = resampled(linear_light(*image), width, height);
    stored_.push_back({std::move(image), {static_cast<std::uint32_t>(halves_.size() / 2), width, height, 0}});
    append(level, halves_);
    while (level.width > 1 && level.height > 1) {
        level = resampled(level, level.width / 2, level.height / 2);
        append(level, halves_);
    }
}

glsl::uvec4 Textures::place(const RasterCloth& cloth) const {
    const auto found = std::ranges::find(stored_, cloth.appearance.image, &Stored::image);
    if (!cloth.appearance.image || found == stored_.end()) return {};
    glsl::uvec4 place = found->place;
    place.w = cloth.appearance.back ? 0 : 1;
    return place;
}

}  // namespace drape
