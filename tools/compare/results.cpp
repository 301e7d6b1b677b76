#include "compare/results.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "base/printable_text.h"
#include "input/array_file.h"
#include "input/png_picture.h"
#include "output/atomic_file.h"
#include "output/json_file.h"
#include "output/json_text.h"

namespace drape::compare {

namespace {

namespace fs = std::filesystem;
using input::Array;

/// Largest and RMS difference, and where the largest is. What is NaN on one side alone is infinitely far away.
class Differences {
  public:
    void see(double a, double b, std::size_t index) {
        ++count_;
        if (a == b || (std::isnan(a) && std::isnan(b))) return;
        ++differing_;
        const double difference =
            std::isnan(a - b) ? std::numeric_limits<double>::infinity() : std::abs(a - b);  // also inf - inf
        squares_ += difference * difference;
        if (difference <= largest_) return;
        largest_ = difference;
        where_ = index;
    }
    double largest() const { return largest_; }
    double rms() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0; }
    std::size_t count() const { return count_; }
    std::size_t differing() const { return differing_; }
    std::size_t where() const { return where_; }

  private:
    std::size_t count_ = 0, differing_ = 0, where_ = 0;
    double squares_ = 0, largest_ = 0;
};

bool above(const std::optional<double>& limit, double value) { return limit && !(value <= *limit); }

/// The frames of arrays, as the manifest beside them tells.
struct Frames {
    std::size_t count = 0;  ///< 0: there is no manifest
    std::size_t exact = 0;  ///< those before positions are sensitive: equally exact runs part from there on
    /// Returns whether the array has a row for each of them.
    bool are_of(const Array& array) const { return count > 0 && !array.shape.empty() && array.shape[0] == count; }
};

Frames frames_of(const fs::path& file) {
    const fs::path manifest = file.parent_path() / manifest_file_name;
    std::error_code ignored;
    const auto json = fs::exists(manifest, ignored) ? parse_json(read_file(manifest)) : std::nullopt;
    if (!json || !json->isObject() || !(*json)["statistics"].isArray()) return {};
    const Json::Value& list = (*json)["statistics"];
    const auto first = std::find_if(list.begin(), list.end(), [](const Json::Value& frame) {
        return frame.isObject() && frame.isMember("sensitive");
    });
    return {list.size(), static_cast<std::size_t>(std::distance(list.begin(), first))};
}

/// Returns those that both have.
Frames frames_of(const fs::path& a, const fs::path& b) {
    const Frames before = frames_of(a), after = frames_of(b);
    if (before.count != after.count) return {};
    return {before.count, std::min(before.exact, after.exact)};
}

/// Returns how far apart means are, over all but an array's first axis and one of components, from a frame on.
double furthest_mean(const Array& a, const Array& b, std::size_t from) {
    const std::size_t components = a.shape.size() > 2 && a.shape.back() <= 4 ? a.shape.back() : 1;
    const std::size_t of_a_frame = a.count() / a.shape[0], rows = of_a_frame / components;
    double furthest = 0;
    for (std::size_t frame = from; frame < a.shape[0]; ++frame)
        for (std::size_t component = 0; component < components; ++component) {
            double sum = 0;
            for (std::size_t row = 0; row < rows; ++row) {
                const std::size_t index = frame * of_a_frame + row * components + component;
                sum += a.value(index) - b.value(index);
            }
            const double mean = sum / static_cast<double>(rows);
            // A NaN is no result, and is far from all.
            furthest = std::isnan(mean) ? std::numeric_limits<double>::infinity() : std::max(furthest, std::abs(mean));
        }
    return furthest;
}

/// Returns the text that an array of strings of no dimension has, or nothing.
std::optional<std::string> text_of(const Array& array) {
    if (!array.type.starts_with("<U") || !array.shape.empty()) return std::nullopt;
    std::string text;
    for (std::size_t at = 0; at + 4 <= array.bytes.size(); at += 4)
        if (array.bytes[at] != std::byte{}) text += static_cast<char>(array.bytes[at]);
    return text;
}

/// Returns what a run chose, without the names of the device that it ran on and of the kernels that it took there.
Json::Value choices_of(const Array& parameters) {
    const auto text = text_of(parameters);
    Json::Value choices = text ? parse_json(*text).value_or(Json::Value()) : Json::Value();
    if (choices.isObject())
        for (const char* name : {"device", "driver", "kernels"}) choices.removeMember(name);
    return choices;
}

/// Two devices differ by name, and that is no difference of results.
Row compare_parameters(const std::string& name, const Array& a, const Array& b) {
    Row row{name, {}, false, {}, {}, {}};
    if (a.bytes == b.bytes) {
        row.text = "equal";
        return row;
    }
    const Json::Value before = choices_of(a), after = choices_of(b);
    row.over = before != after || !before.isObject();
    row.text = row.over ? "other choices" : "equal but for the device and its kernels";
    return row;
}

Row compare_arrays(const std::string& name, const Array& a, const Array& b, const Limits& limits,
                   const Frames& frames) {
    Row row{name, {}, false, {}, {}, {}};
    if (a.shape != b.shape || a.has_numbers() != b.has_numbers() || (!a.has_numbers() && a.type != b.type)) {
        row.text = fmt::format("{} and {}", a.text(), b.text());
        row.over = true;
        return row;
    }
    if (!a.has_numbers()) {
        row.over = a.bytes != b.bytes;
        row.text = fmt::format("{}: {}", a.text(), row.over ? "another text" : "equal");
        return row;
    }
    const bool judged = limits.largest || limits.rms;
    const bool sensitive = judged && frames.are_of(a) && frames.exact < frames.count;
    Differences differences;
    const std::size_t compared = sensitive ? a.count() / frames.count * frames.exact : a.count();
    for (std::size_t i = 0; i < compared; ++i) differences.see(a.value(i), b.value(i), i);
    row.largest = differences.largest();
    row.rms = differences.rms();
    row.over =
        judged ? above(limits.largest, *row.largest) || above(limits.rms, *row.rms) : differences.differing() > 0;
    row.text = a.text() + (a.type == b.type ? "" : " and " + b.text()) + ": ";
    row.text += differences.differing() == 0
                    ? "equal"
                    : fmt::format("largest difference {:.3g} at {}, RMS {:.3g}, {} of {} values differ", *row.largest,
                                  a.place(differences.where()), *row.rms, differences.differing(), differences.count());
    if (sensitive)
        row.text += fmt::format(
            " (of the first {} frames: from there on the motion is sensitive, and no position is "
            "right; means are at most {:.3g} apart there)",
            frames.exact, furthest_mean(a, b, frames.exact));
    return row;
}

Row compare_pictures(const fs::path& a, const fs::path& b, const Limits& limits) {
    const Picture before = read_png(a), after = read_png(b);
    Row row{a.filename().string(), {}, false, {}, {}, {}};
    const auto size = [](const Picture& picture) { return fmt::format("{}x{}", picture.width, picture.height); };
    if (before.width != after.width || before.height != after.height) {
        row.text = fmt::format("{} and {} pixels", size(before), size(after));
        row.over = true;
        return row;
    }
    Differences differences;
    for (std::size_t i = 0; i < before.rgb.size(); ++i) differences.see(before.rgb[i], after.rgb[i], i);
    row.largest = differences.largest();
    row.rms = differences.rms();
    const bool equal = differences.differing() == 0;
    if (!equal) row.psnr = 20 * std::log10(255 / *row.rms);
    const double psnr = row.psnr.value_or(std::numeric_limits<double>::infinity());
    row.over = limits.psnr || limits.channel
                   ? above(limits.channel, *row.largest) || (limits.psnr && !(psnr >= *limits.psnr))
                   : !equal;
    const std::size_t pixel = differences.where() / 3;
    row.text = fmt::format("{} pixels: ", size(before)) +
               (equal ? "equal"
                      : fmt::format("PSNR {:.2f} dB, largest difference {:.0f} of 255 at column {}, row {}", psnr,
                                    *row.largest, pixel % before.width, pixel / before.width));
    return row;
}

Row only_in(const std::string& name, const fs::path& where) {
    return {name, fmt::format("only in {}", where.string()), true, {}, {}, {}};
}

std::vector<Row> compare_array_files(const fs::path& a, const fs::path& b, const Limits& limits) {
    const std::vector<Array> before = input::load_arrays(a), after = input::load_arrays(b);
    const std::string file = a.filename().string();
    const Frames frames = frames_of(a, b);
    std::vector<Row> rows;
    for (const Array& array : before) {
        const std::string name = array.name.empty() ? file : file + "/" + array.name;
        const auto other = std::ranges::find(after, array.name, &Array::name);
        if (other == after.end())
            rows.push_back(only_in(name, a));
        else if (array.name == "parameters")
            rows.push_back(compare_parameters(name, array, *other));
        else
            rows.push_back(compare_arrays(name, array, *other, limits, frames));
    }
    for (const Array& array : after)
        if (std::ranges::find(before, array.name, &Array::name) == before.end())
            rows.push_back(only_in(file + "/" + array.name, b));
    return rows;
}

/// Returns whether a file tells how long something took, which is never the same: a manifest, and what a sweep notes
/// of its runs.
bool tells_times(const fs::path& name) {
    return name.filename() == manifest_file_name || name.filename() == "results.csv" || *name.begin() == "jobs";
}

/// Returns the paths, from the folder on, of the files in it and in the folders in it.
std::set<std::string> files_in(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const fs::path name = at->path().lexically_relative(folder);
        if (at->is_regular_file() && !tells_times(name)) names.insert(name.generic_string());
    }
    if (error) throw OutputError(fmt::format("cannot read '{}': {}", folder.string(), error.message()));
    return names;
}

}  // namespace

bool is_result_file(const fs::path& path) {
    return path.extension() == ".npy" || path.extension() == ".npz" || path.extension() == ".png";
}

std::vector<Row> compare_files(const fs::path& a, const fs::path& b, const Limits& limits) {
    if (a.extension() != ".png") return compare_array_files(a, b, limits);
    return {compare_pictures(a, b, limits)};
}

std::vector<Row> compare_folders(const fs::path& a, const fs::path& b, const Limits& limits) {
    const std::set<std::string> before = files_in(a), after = files_in(b);
    std::vector<Row> rows;
    for (const std::string& name : before) {
        if (!after.contains(name)) {
            rows.push_back(only_in(name, a));
        } else if (is_result_file(name)) {
            const std::string inside = fs::path(name).parent_path().generic_string();
            for (Row& row : compare_files(a / name, b / name, limits)) {
                if (!inside.empty()) row.name = inside + "/" + row.name;
                rows.push_back(std::move(row));
            }
        } else {
            const bool equal = read_file(a / name) == read_file(b / name);
            rows.push_back({name, equal ? "equal bytes" : "other bytes", !equal, {}, {}, {}});
        }
    }
    for (const std::string& name : after)
        if (!before.contains(name)) rows.push_back(only_in(name, b));
    return rows;
}

std::string rows_text(const std::vector<Row>& rows) {
    std::string text;
    for (const Row& row : rows)
        text += fmt::format("{}  {}: {}\n", row.over ? "OVER" : "ok  ", printable(row.name), printable(row.text));
    const auto over = std::ranges::count(rows, true, &Row::over);
    return text + fmt::format("{} compared, {} over {} limit\n", rows.size(), over, over == 1 ? "its" : "their");
}

std::string rows_json(const std::vector<Row>& rows) {
    Json::Value list(Json::arrayValue);
    const auto put = [](Json::Value& value, const char* key, const std::optional<double>& number) {
        if (number && std::isfinite(*number)) value[key] = *number;  // JSON has no infinity
    };
    for (const Row& row : rows) {
        Json::Value& value = list.append(Json::Value(Json::objectValue));
        value["name"] = row.name;
        value["text"] = row.text;
        value["over"] = row.over;
        put(value, "largest", row.largest);
        put(value, "rms", row.rms);
        put(value, "psnr_db", row.psnr);
    }
    return json_text(list);
}

}  // namespace drape::compare
