#include "output/kept_frames.h"

#include <fmt/format.h>

#include "input/png_picture.h"
#include "output/json_file.h"
#include "output/json_text.h"
#include "output/png_sequence.h"

namespace drape {

namespace {

constexpr std::string_view remedy = "use --overwrite to replace an earlier run's files, or choose another folder";

// Numbers are compared as text: one may have more digits than any integer type.
std::string_view without_zeros(std::string_view digits) {
    const size_t first = digits.find_first_not_of('0');
    return first == std::string_view::npos ? "0" : digits.substr(first);
}

std::string_view number_in(std::string_view file_name) {
    const size_t begin = std::string_view("frame_").size();
    return without_zeros(file_name.substr(begin, file_name.rfind('.') - begin));
}

void check_text(const std::string& path, std::string_view name, const std::string& text, const std::string& key) {
    const std::string expected = fmt::format("{} frame {}", key, number_in(name));
    if (text == expected || text.starts_with(expected + " ")) return;
    if (text.starts_with(key + " ")) {
        throw OutputError(fmt::format("cannot resume: '{}' holds {}: give it its own name back, or remove it", path,
                                      text.substr(key.size() + 1, text.find(" {") - key.size() - 1)));
    }
    throw OutputError(fmt::format(
        "cannot resume: '{}' {}: {}", path,
        text.empty() ? "does not say which run drew it"
                     : "was drawn by another run (other scene, size, samples, view, program version, device or driver)",
        remedy));
}

// Returns the values behind the frame's number.
FrameValues values_in(const std::string& text) {
    FrameValues values;
    const size_t begin = text.find('{');
    if (begin == std::string::npos) return values;
    const std::optional<Json::Value> root = parse_json(std::string_view(text).substr(begin));
    if (!root || !root->isObject()) throw OutputError("its values are no JSON object");
    for (auto value = root->begin(); value != root->end(); ++value) {
        if (!value->isNumeric()) throw OutputError("a value is no number");
        values[value.name()] = value->asDouble();
    }
    return values;
}

KeptFrame check_frame(const OutputFolder& folder, const std::string& name, const std::string& key) {
    const std::vector<std::uint8_t> bytes = folder.read_file(name);
    std::string text;
    FrameValues values;
    try {
        text = decode_png(bytes).text;
        values = values_in(text);
    } catch (const OutputError& error) {
        throw OutputError(fmt::format("cannot resume: '{}' is damaged ({}): remove it to have it drawn again",
                                      folder.path_of(name), error.what()));
    }
    check_text(folder.path_of(name), name, text, key);
    return {{name, bytes.size(), xxh3_128_hex(std::as_bytes(std::span(bytes)))}, std::move(values)};
}

void check_manifest(const OutputFolder& folder, const std::string& key) {
    const std::string name(manifest_file_name);
    if (!folder.has_file(name)) return;
    const std::vector<std::uint8_t> bytes = folder.read_file(name);
    const std::optional<Json::Value> root = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    // The folder has already refused a manifest that is not this program's.
    if (!root || (*root)["run_key"] != Json::Value(key)) {
        throw OutputError(
            fmt::format("cannot resume: '{}' is that of another run (other command, scene, size, samples, view, "
                        "program version, "
                        "device or driver): {}",
                        folder.path_of(name), remedy));
    }
}

}  // namespace

std::string run_key(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += fmt::format("{}:{}\n", part.size(), part);
    return xxh3_128_hex(text);
}

std::string frame_text(std::string_view run_key, std::uint64_t frame, const FrameValues& values) {
    std::string text = fmt::format("{} frame {}", run_key, frame);
    if (values.empty()) return text;
    Json::Value json(Json::objectValue);
    for (const auto& [name, value] : values) json[name] = value;
    return fmt::format("{} {}", text, json_line(json));
}

std::map<std::string, KeptFrame> kept_frames(const OutputFolder& folder, const std::string& run_key) {
    check_manifest(folder, run_key);
    std::map<std::string, KeptFrame> kept;
    for (const std::string& name : folder.file_names())
        if (is_frame_file_name(name)) kept.emplace(name, check_frame(folder, name, run_key));
    return kept;
}

}  // namespace drape
