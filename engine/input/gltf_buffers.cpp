#include "input/gltf_buffers.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include "input/file_source.h"
#include "input/mesh_data.h"

namespace drape::input {

namespace {

/// Returns the bytes of base64 text; nothing where it is none.
std::vector<std::uint8_t> base64_bytes(std::string_view text, bool& is_right) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    while (text.ends_with('=')) text.remove_suffix(1);
    std::vector<std::uint8_t> bytes;
    std::uint32_t held = 0;
    int bits = 0;
    for (const char c : text) {
        const std::size_t digit = digits.find(c);
        if (digit == digits.npos) {
            is_right = false;
            return {};
        }
        held = held << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::uint8_t>(held >> bits));
    }
    is_right = true;
    return bytes;
}

/// Returns a relative URI as a path, "%20" as a blank.
std::string decoded(std::string_view uri) {
    std::string path;
    for (std::size_t k = 0; k < uri.size(); ++k) {
        const auto digit = [&](std::size_t at) {
            return std::string_view("0123456789abcdef").find(static_cast<char>(uri[at] | 0x20));
        };
        const bool is_code = uri[k] == '%' && k + 2 < uri.size() && digit(k + 1) < 16 && digit(k + 2) < 16;
        path += is_code ? static_cast<char>(16 * digit(k + 1) + digit(k + 2)) : uri[k];
        if (is_code) k += 2;
    }
    return path;
}

std::uint64_t component_bytes(int component) {
    switch (component) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

}  // namespace

void GltfFile::fail(const std::string& place, const std::string& what) const {
    throw unreadable(name_, place.empty() ? what : fmt::format("{}: {}", place, what));
}

GltfFile::GltfFile(const std::filesystem::path& path) : name_(path.string()) {
    FileSource file(path);
    const std::vector<std::uint8_t> bytes = file.rest();
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0)
        read_glb(bytes);
    else
        parse(bytes);
    if (!json_.isObject()) fail("", "it is no glTF: expected a JSON object");
    const Json::Value& asset = json_["asset"];
    if (!asset.isObject() || !asset["version"].isString() || !asset["version"].asString().starts_with("2."))
        fail("/asset/version", "expected glTF 2");
    const Json::Value& required = json_["extensionsRequired"];
    if (!required.isNull() && !required.isArray()) fail("/extensionsRequired", "expected a list");
    // Extensions of looks change no shape; every other one may.
    for (const Json::Value& each : required)
        if (!each.isString() || !(each.asString().starts_with("KHR_materials_") || each == "KHR_texture_transform"))
            fail("/extensionsRequired",
                 fmt::format("the extension {} is not read", each.isString() ? each.asString().substr(0, 60) : "?"));
    read_buffers(path.parent_path());
}

void GltfFile::parse(std::span<const std::uint8_t> text) {
    if (text.size() >= 3 && std::memcmp(text.data(), "\xEF\xBB\xBF", 3) == 0) text = text.subspan(3);
    // The library takes some 150 bytes for a value, which two of the text can be.
    constexpr std::ptrdiff_t most_values = 2'000'000;
    if (std::ranges::count_if(text, [](std::uint8_t c) { return c == ',' || c == '[' || c == '{'; }) > most_values)
        fail("", fmt::format("expected JSON of at most {} values", most_values));
    const char* const begin = reinterpret_cast<const char*>(text.data());
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    std::string errors;
    try {
        if (reader->parse(begin, begin + text.size(), &json_, &errors)) return;
    } catch (const Json::Exception& error) {  // nested too deeply
        errors = error.what();
    }
    std::ranges::replace(errors, '\n', ' ');
    fail("", fmt::format("it is no glTF: {}", errors.substr(0, 160)));
}

void GltfFile::read_glb(const std::vector<std::uint8_t>& bytes) {
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        if (at + 4 > bytes.size()) fail(fmt::format("byte {}", at), "the file ends too early");
        std::memcpy(&value, &bytes[at], sizeof value);
        return value;
    };
    constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
    if (word(4) != 2) fail("byte 4", "expected version 2 of GLB");
    bool has_json = false;
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::uint32_t length = word(at), type = word(at + 4);
        at += 8;
        if (length > bytes.size() - at) fail(fmt::format("byte {}", at - 8), "a chunk is longer than the file");
        const std::span<const std::uint8_t> chunk = std::span(bytes).subspan(at, length);
        if (!has_json) {
            if (type != json_chunk) fail("byte 12", "the first chunk must be JSON");
            parse(chunk);
            has_json = true;
        } else if (type == binary_chunk && glb_buffer_.empty()) {
            glb_buffer_.assign(chunk.begin(), chunk.end());
        }
        at += length + (4 - length % 4) % 4;
    }
    if (!has_json) fail("", "it has no JSON");
}

void GltfFile::read_buffers(const std::filesystem::path& folder) {
    const Json::Value& buffers = json_["buffers"];
    if (!buffers.isNull() && !buffers.isArray()) fail("/buffers", "expected a list");
    std::uint64_t sum = 0;
    for (Json::ArrayIndex k = 0; k < buffers.size(); ++k) {
        std::string place;
        const Json::Value& buffer = object("buffers", k, place);
        const std::uint64_t length = whole(buffer, place, "byteLength", 0);
        std::vector<std::uint8_t>& bytes = buffers_.emplace_back();
        const Json::Value& uri = buffer["uri"];
        if (!uri.isNull() && !uri.isString()) fail(place + "/uri", "expected a text");
        const std::string text = uri.isNull() ? "" : uri.asString();
        if (uri.isNull()) {
            if (k == 0) bytes = glb_buffer_;
        } else if (text.starts_with("data:")) {
            const std::size_t comma = text.find(";base64,");
            bool is_right = comma != text.npos;
            if (is_right) bytes = base64_bytes(std::string_view(text).substr(comma + 8), is_right);
            if (!is_right) fail(place + "/uri", "expected base64");
        } else {
            FileSource file(folder / decoded(text));
            sum += file.size();
            if (sum > mesh_file_byte_limit)
                fail(place, fmt::format("expected buffers of at most {} bytes, together", mesh_file_byte_limit));
            bytes = file.rest();
        }
        if (bytes.size() < length) fail(place, fmt::format("expected {} bytes, got {}", length, bytes.size()));
    }
}

const Json::Value& GltfFile::object(const char* list, const Json::Value& index, std::string& place) const {
    place = fmt::format("/{}", list);
    const Json::Value& all = json_[list];
    if (!all.isArray()) fail(place, "expected a list");
    if (!index.isUInt() || index.asUInt() >= all.size())
        fail(place, fmt::format("something is named that is not among these {}", all.size()));
    place += fmt::format("/{}", index.asUInt());
    const Json::Value& found = all[index.asUInt()];
    if (!found.isObject()) fail(place, "expected an object");
    return found;
}

std::uint64_t GltfFile::whole(const Json::Value& object, const std::string& place, const char* key,
                              std::uint64_t otherwise) const {
    const Json::Value& value = object[key];
    if (value.isNull()) return otherwise;
    if (!value.isUInt64() || value.asUInt64() > (std::uint64_t{1} << 53))
        fail(fmt::format("{}/{}", place, key), "expected a whole number from 0 on");
    return value.asUInt64();
}

GltfFile::Elements GltfFile::elements(const Json::Value& index) const {
    Elements elements{};
    const Json::Value& accessor = object("accessors", index, elements.place);
    const std::string& place = elements.place;
    elements.count = whole(accessor, place, "count", 0);
    elements.component = static_cast<int>(std::min<std::uint64_t>(whole(accessor, place, "componentType", 0), 9999));
    elements.type = accessor["type"].isString() ? accessor["type"].asString() : "";
    if (!accessor["sparse"].isNull()) fail(place + "/sparse", "sparse accessors are not read");
    const std::uint64_t size = component_bytes(elements.component) * (elements.type == "VEC3" ? 3 : 1);
    if (size == 0 || (elements.type != "VEC3" && elements.type != "SCALAR"))
        fail(place, "expected numbers or vectors of three of a known type");
    std::string view_place;
    const Json::Value& view = object("bufferViews", accessor["bufferView"], view_place);
    std::string buffer_place;
    object("buffers", view["buffer"], buffer_place);
    const std::span<const std::uint8_t> buffer = buffers_[view["buffer"].asUInt()];
    const std::uint64_t begin = whole(view, view_place, "byteOffset", 0);
    const std::uint64_t length = whole(view, view_place, "byteLength", 0);
    if (begin > buffer.size() || length > buffer.size() - begin)
        fail(view_place, fmt::format("it lies outside of its buffer, which has {} bytes", buffer.size()));
    elements.stride = whole(view, view_place, "byteStride", size);
    const std::uint64_t offset = whole(accessor, place, "byteOffset", 0);
    if (elements.stride < size) fail(view_place + "/byteStride", "elements overlap");
    const bool fits = elements.count == 0 || (offset <= length && size <= length - offset &&
                                              elements.count - 1 <= (length - offset - size) / elements.stride);
    if (!fits) fail(place, fmt::format("{} elements are more than its view of {} bytes has", elements.count, length));
    elements.bytes = buffer.subspan(begin, length).subspan(elements.count == 0 ? 0 : offset);
    return elements;
}

}  // namespace drape::input
