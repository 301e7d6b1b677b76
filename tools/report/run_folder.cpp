#include "report/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "input/png_picture.h"
#include "output/json_file.h"
#include "output/manifest.h"
#include "output/png.h"
#include "output/png_sequence.h"

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

/// A picture's text is its run's key, "frame", its number, and its statistics as JSON.
Json::Value statistics_in(const Picture& picture, std::uint64_t frame) {
    const std::size_t begin = std::min(picture.text.find('{'), picture.text.size());
    const Json::Value values = parse_json(picture.text.substr(begin)).value_or(Json::Value());
    Json::Value statistics(Json::objectValue);
    for (const std::string& name : values.isObject() ? values.getMemberNames() : Json::Value::Members{})
        if (values[name].isNumeric()) statistics[name] = values[name];
    statistics["frame"] = Json::UInt64{frame};
    return statistics;
}

/// Returns what the pictures of a run without a manifest tell; nothing where there are none.
std::optional<RunFolder> read_unfinished(const fs::path& path) {
    std::map<std::uint64_t, std::string> pictures;
    std::error_code error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (is_frame_file_name(name)) pictures[std::strtoull(name.c_str() + name.find('_') + 1, nullptr, 10)] = name;
    }
    if (pictures.empty()) return std::nullopt;
    RunFolder run{.path = path, .manifest = {}, .files = {}, .pictures = {}, .is_finished = false};
    for (const auto& [frame, name] : pictures) {
        run.manifest["statistics"].append(statistics_in(read_png(path / name), frame));
        run.pictures.push_back(name);
    }
    run.files = run.pictures;
    run.manifest["status"] = "not finished";
    run.manifest["warnings"].append(
        fmt::format("{} is not there: the run goes on, or was killed and goes on with --resume. It has drawn {} "
                    "pictures, frames {} to {}.",
                    manifest_file_name, pictures.size(), pictures.begin()->first, pictures.rbegin()->first));
    run.manifest["frames"]["step"] = 1;
    run.manifest["frames"]["end"] = Json::UInt64{pictures.rbegin()->first};
    return run;
}

}  // namespace

RunFolder read_run_folder(const fs::path& path) {
    if (!fs::exists(path / manifest_file_name)) {
        if (std::optional<RunFolder> run = read_unfinished(path)) return std::move(*run);
        throw OutputError(
            fmt::format("'{}' has no {} and no pictures: no run is there, or none that has drawn anything",
                        path.string(), manifest_file_name));
    }
    RunFolder run{path, read_manifest(path), {}, {}, true};
    for (const Json::Value& entry : run.manifest["files"]) {
        const std::string name = entry["name"].asString();
        if (!is_plain_file_name(name) || !fs::exists(path / name)) continue;
        run.files.push_back(name);
        if (is_frame_file_name(name)) run.pictures.push_back(name);
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

std::vector<std::size_t> evenly_chosen(std::size_t count, std::size_t most) {
    std::vector<std::size_t> numbers;
    const std::size_t wanted = std::min(count, std::max<std::size_t>(most, 1));
    for (std::size_t i = 0; i < wanted; ++i) numbers.push_back(wanted == 1 ? 0 : i * (count - 1) / (wanted - 1));
    return numbers;
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
