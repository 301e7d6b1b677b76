#include "report/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "input/png_picture.h"
#include "output/manifest.h"
#include "output/png.h"

namespace drape::report {

namespace fs = std::filesystem;

namespace {

double linear(std::uint8_t code) {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < 256; ++i) {
            const double c = static_cast<double>(i) / 255;
            values[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        }
        return values;
    }();
    return table[code];
}

std::uint8_t code_of(double light) {
    const double c = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 1.0) * 255));
}

/// Pixels `begin` to `end` of a row or column of `from` pixels that fall into pixel i of `to`.
std::array<std::uint32_t, 2> covered(std::uint32_t i, std::uint32_t from, std::uint32_t to) {
    const auto begin = static_cast<std::uint32_t>(std::uint64_t{i} * from / to);
    const auto end = static_cast<std::uint32_t>((std::uint64_t{i} + 1) * from / to);
    return {begin, std::max(end, begin + 1)};
}

std::vector<std::uint8_t> shrunk(const Picture& picture, std::uint32_t width, std::uint32_t height) {
    std::vector<std::uint8_t> rgba(std::size_t{width} * height * 4, 255);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const auto rows = covered(y, picture.height, height), columns = covered(x, picture.width, width);
            std::array<double, 3> sum{};
            for (std::uint32_t row = rows[0]; row < rows[1]; ++row)
                for (std::uint32_t column = columns[0]; column < columns[1]; ++column)
                    for (std::size_t k = 0; k < 3; ++k)
                        sum[k] += linear(picture.rgb[(std::size_t{row} * picture.width + column) * 3 + k]);
            const double count = static_cast<double>(rows[1] - rows[0]) * (columns[1] - columns[0]);
            for (std::size_t k = 0; k < 3; ++k) rgba[(std::size_t{y} * width + x) * 4 + k] = code_of(sum[k] / count);
        }
    return rgba;
}

}  // namespace

RunFolder read_run_folder(const fs::path& path) {
    if (!fs::exists(path / manifest_file_name))
        throw OutputError(fmt::format("'{}' has no {}: no finished run is there", path.string(), manifest_file_name));
    RunFolder run{path, read_manifest(path), {}};
    for (const Json::Value& entry : run.manifest["files"]) {
        const std::string name = entry["name"].asString();
        if (is_plain_file_name(name) && name.ends_with(".png") && fs::exists(path / name)) run.pictures.push_back(name);
    }
    return run;
}

std::string small_picture(const fs::path& file, std::uint32_t width) {
    const Picture picture = read_png(file);
    const std::uint32_t columns = std::min(width, picture.width);
    const auto rows =
        static_cast<std::uint32_t>(std::max<std::uint64_t>(1, std::uint64_t{picture.height} * columns / picture.width));
    std::vector<std::uint8_t> png;
    encode_png(columns, rows, shrunk(picture, columns, rows), png);
    return base64(png);
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace drape::report
