#include "input/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/array_file.h"
#include "input/file_source.h"

namespace drape::input {

namespace {

constexpr std::uint64_t most_side = 16384;

GreyPicture array_map(const std::filesystem::path& path) {
    double largest = 1;
    const Array array = load_array(path, "", [&](const Array& head) -> std::uint64_t {
        largest = head.type == "|u1" ? 255 : head.type == "<u2" ? 65535 : 1;
        const bool has_values = largest > 1 || head.type == "|b1" || head.type == "<f4" || head.type == "<f8";
        const bool has_sides = head.shape.size() == 2 && std::min(head.shape[0], head.shape[1]) > 0 &&
                               std::max(head.shape[0], head.shape[1]) <= most_side;
        if (!has_values || !has_sides)
            throw unreadable(path.string(), fmt::format("a map is uint8, uint16, bool, float32 or float64 (rows, "
                                                        "columns), of 1 to {}, and it has {}",
                                                        most_side, head.text()));
        return head.count();
    });
    GreyPicture map{static_cast<std::uint32_t>(array.shape[1]), static_cast<std::uint32_t>(array.shape[0]), {}};
    map.values.reserve(array.count());
    for (std::size_t i = 0; i < array.count(); ++i) {
        const double value = array.value(i) / largest;
        if (!(value >= 0 && value <= 1))
            throw unreadable(path.string(), fmt::format("a map's values are from 0 to 1, and at {} is {}",
                                                        array.place(i), array.value(i)));
        map.values.push_back(static_cast<float>(value));
    }
    return map;
}

}  // namespace

GreyPicture read_map(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (extension == ".npy") return array_map(path);
    if (extension != ".png") throw unreadable(path.string(), "maps are read from .png and .npy");
    FileSource file(path);
    try {
        return decode_grey_png(file.rest());
    } catch (const OutputError& error) {
        throw unreadable(file.name(), error.what());
    }
}

double sampled(const GreyPicture& map, double across, double down) {
    const auto place = [](double at, std::uint32_t count) {
        const double x = std::clamp(at * count - 0.5, 0.0, static_cast<double>(count - 1)), middle = std::round(x);
        return std::abs(x - middle) < 1e-9 ? middle : x;  // what rounding did to the middle of a pixel
    };
    const double x = place(across, map.width), y = place(down, map.height);
    const auto left = static_cast<std::uint32_t>(x), top = static_cast<std::uint32_t>(y);
    const std::uint32_t right = std::min(left + 1, map.width - 1), bottom = std::min(top + 1, map.height - 1);
    const auto value = [&](std::uint32_t column, std::uint32_t row) {
        return static_cast<double>(map.values[std::size_t{row} * map.width + column]);
    };
    const double share = x - left, lower = y - top;
    return (1 - lower) * ((1 - share) * value(left, top) + share * value(right, top)) +
           lower * ((1 - share) * value(left, bottom) + share * value(right, bottom));
}

}  // namespace drape::input
