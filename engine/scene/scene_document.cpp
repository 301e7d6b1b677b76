#include "scene/scene_document.h"

#include <fmt/format.h>
#include <json/reader.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>

#include "scene/scene_node.h"

namespace drape {
namespace {

std::unique_ptr<Json::CharReader> strict_reader() {
    Json::CharReaderBuilder builder;
    Json::CharReaderBuilder::strictMode(&builder.settings_);
    builder["allowComments"] = true;
    builder["collectComments"] = false;
    builder["skipBom"] = false;  // skipping it would shift the offsets; the caller has removed it
    return std::unique_ptr<Json::CharReader>(builder.newCharReader());
}

struct SyntaxError {
    LineColumn place;
    std::string message;
};

// The library reports as text only: "* Line 3, Column 5", then the message indented by two spaces, then
// perhaps "See Line ..." lines.
std::vector<SyntaxError> split_report(const std::string& report) {
    std::vector<SyntaxError> errors;
    std::istringstream lines(report);
    for (std::string line; std::getline(lines, line);) {
        unsigned row = 0;
        unsigned column = 0;
        if (std::sscanf(line.c_str(), "* Line %u, Column %u", &row, &column) == 2) {
            errors.push_back({{row, column}, ""});
        } else if (!errors.empty() && errors.back().message.empty() && line.starts_with("  ")) {
            errors.back().message = line.substr(2);
            if (line.ends_with('.')) errors.back().message.pop_back();
        }
    }
    // After a first error these two only say that the rest was not read.
    const auto is_consequence = [](const SyntaxError& error) {
        return error.message.starts_with("Extra non-whitespace") || error.message.starts_with("A valid JSON document");
    };
    if (!errors.empty()) errors.erase(std::remove_if(errors.begin() + 1, errors.end(), is_consequence), errors.end());
    return errors;
}

void shift_offsets(Json::Value& value, std::ptrdiff_t shift) {
    value.setOffsetStart(value.getOffsetStart() + shift);
    value.setOffsetLimit(value.getOffsetLimit() + shift);
    for (Json::Value& member : value) shift_offsets(member, shift);
}

// Parses "[value]"; returns nothing when that is not JSON of exactly one value.
std::optional<Json::Value> parse_single(const std::string& bracketed) {
    if (find_text_fault(bracketed)) return std::nullopt;
    Json::Value list;
    try {
        const std::string finite = with_finite_numbers(bracketed);
        if (!strict_reader()->parse(finite.data(), finite.data() + finite.size(), &list, nullptr)) return std::nullopt;
    } catch (const Json::Exception&) {
        return std::nullopt;
    }
    if (list.size() != 1) return std::nullopt;
    return list[0];
}

std::optional<Json::ArrayIndex> parse_index(const std::string& token) {
    Json::ArrayIndex index = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
    if (error != std::errc{} || end != token.data() + token.size()) return std::nullopt;
    if (token.size() > 1 && token.front() == '0') return std::nullopt;
    return index;
}

/// Returns an empty array or object at a place of the text.
Json::Value made(Json::ValueType type, std::size_t offset) {
    Json::Value value(type);
    value.setOffsetStart(static_cast<std::ptrdiff_t>(offset));
    value.setOffsetLimit(static_cast<std::ptrdiff_t>(offset));
    return value;
}

std::string unescaped_token(std::string token) {
    for (std::size_t i = token.find('~'); i != std::string::npos; i = token.find('~', i + 1)) {
        if (i + 1 == token.size()) break;
        if (token[i + 1] == '1') token.replace(i, 2, 1, '/');
        if (token[i + 1] == '0') token.replace(i, 2, 1, '~');
    }
    return token;
}

}  // namespace

SceneDocument::SceneDocument(std::string_view text, std::string file_name)
    : text_(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text), lines_(text_) {
    sources_.push_back({0, std::move(file_name)});
    parse(text_);
}

void SceneDocument::parse(std::string_view text) {
    if (const auto fault = find_text_fault(text)) return fail(fault->offset, "", fault->message);
    std::string report;
    try {
        std::string readable = with_finite_numbers(text);
        trailing_commas_ = drape::trailing_commas(text);
        for (const std::size_t comma : trailing_commas_) readable[comma] = ' ';
        if (strict_reader()->parse(readable.data(), readable.data() + readable.size(), &root_, &report)) return;
    } catch (const Json::Exception& exception) {
        return fail(0, "", exception.what());
    }
    for (const SyntaxError& error : split_report(report)) fail(lines_.offset_of(error.place), "", error.message);
    if (errors_.empty()) fail(0, "", "expected a JSON document");
    for (std::size_t i = 0; i < std::min(trailing_commas_.size(), ErrorList::most); ++i)
        fail(trailing_commas_[i], "", comma_message);
}

void SceneDocument::fail(std::size_t offset, std::string pointer, std::string message) {
    errors_.push_back(place(offset, std::move(pointer), std::move(message)));
}

PlacedError SceneDocument::place(std::size_t offset, std::string pointer, std::string message) const {
    const auto after = std::upper_bound(sources_.begin(), sources_.end(), offset,
                                        [](std::size_t o, const Source& source) { return o < source.begin; });
    // Two sources begin at one offset only when the file is empty; the file is then meant.
    const Source& source = after == sources_.begin() ? sources_.front() : after[-1];
    SceneError error{source.name, 0, 0, std::move(pointer), std::move(message)};
    if (&source == &sources_.front()) {
        const LineColumn at = lines_.at(offset);
        error.line = at.line;
        error.column = at.column;
    }
    return {offset, std::move(error)};
}

std::string_view SceneDocument::written(const Json::Value& value) const {
    const auto begin = static_cast<std::size_t>(value.getOffsetStart());
    const auto end = static_cast<std::size_t>(value.getOffsetLimit());
    return std::string_view(text_).substr(begin, end - begin);
}

std::size_t SceneDocument::key_offset(const Json::Value& object, const std::string& key, const Json::Value& value) {
    const auto begin = static_cast<std::size_t>(object.getOffsetStart());
    auto [entry, is_new] = keys_.try_emplace(&object);
    if (is_new && text_[begin] == '{') entry->second = key_offsets(std::string_view(text_).substr(begin));
    const auto found = entry->second.find(key);
    return found != entry->second.end() ? begin + found->second : static_cast<std::size_t>(value.getOffsetStart());
}

void SceneDocument::apply_override(const std::string& override_text) {
    // A separator keeps the end of the file and the begin of the override apart.
    text_ += '\n';
    const std::size_t begin = text_.size();
    sources_.push_back({begin, fmt::format("--set '{}'", shortened(override_text, 80))});
    const std::size_t equals = override_text.find('=');
    if (equals == std::string::npos || override_text.front() != '/') {
        text_ += '[';
        return fail(begin, "", "expected /json/pointer=value");
    }
    const std::string bracketed = fmt::format("[{}\n]", override_text.substr(equals + 1));
    text_ += bracketed;
    const std::string pointer = override_text.substr(0, equals);
    Json::Value* target = find_target(pointer, begin);
    if (target == nullptr) return;
    if (auto parsed = parse_single(bracketed)) {
        shift_offsets(*parsed, static_cast<std::ptrdiff_t>(begin));
        *target = std::move(*parsed);
        return;
    }
    const std::string word = override_text.substr(equals + 1);
    if (const auto fault = find_text_fault(bracketed); fault && fault->message.find("UTF-8") != std::string::npos)
        return fail(begin, pointer, fault->message);
    *target = word;
    target->setOffsetStart(static_cast<std::ptrdiff_t>(begin + 1));
    target->setOffsetLimit(static_cast<std::ptrdiff_t>(begin + 1 + word.size()));
}

/// Finds an element by its index; "-" or the number of elements makes a new one behind the last.
Json::Value* SceneDocument::find_element(Json::Value& array, const std::string& token, const std::string& pointer,
                                         std::size_t offset) {
    const auto index = token == "-" ? array.size() : parse_index(token);
    if (!index || *index > array.size()) {
        fail(offset, pointer,
             fmt::format("expected an index into the {} elements of {}, or - for a new one, got \"{}\"", array.size(),
                         pointer.substr(0, pointer.rfind('/')), token));
        return nullptr;
    }
    if (*index == array.size()) array.append(made(Json::objectValue, offset));
    return &array[*index];
}

Json::Value* SceneDocument::find_target(const std::string& pointer, std::size_t offset) {
    Json::Value* value = &root_;
    for (std::size_t begin = 1; begin <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
        const std::string token = unescaped_token(pointer.substr(begin, end - begin));
        const std::string parent = pointer.substr(0, begin - 1);
        if (value->isArray()) {
            value = find_element(*value, token, pointer.substr(0, end), offset);
            if (value == nullptr) return nullptr;
        } else if (value->isObject()) {
            const bool is_new = !value->isMember(token);
            value = &(*value)[token];
            const bool is_array = std::string_view(pointer).substr(end).starts_with("/-");
            if (is_new) *value = made(is_array ? Json::arrayValue : Json::objectValue, offset);
        } else {
            fail(offset, pointer.substr(0, end),
                 fmt::format("expected {} to be an object or an array", parent.empty() ? "the scene" : parent));
            return nullptr;
        }
        begin = end + 1;
    }
    return value;
}

std::size_t SceneDocument::offset_of(const std::string& pointer) const {
    const Json::Value* value = &root_;
    for (std::size_t begin = 1; begin < pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
        const std::string token = unescaped_token(pointer.substr(begin, end - begin));
        begin = end + 1;
        const auto index = parse_index(token);
        const bool is_element = value->isArray() && index && *index < value->size();
        if (!is_element && !(value->isObject() && value->isMember(token))) break;
        value = is_element ? &(*value)[*index] : &(*value)[token];
    }
    return static_cast<std::size_t>(value->getOffsetStart());
}

SceneResult with_places(SceneResult result, std::string_view text, const std::string& file_name,
                        std::span<const std::string> overrides) {
    SceneDocument document(text, file_name);
    for (const std::string& each : overrides) document.apply_override(each);
    for (SceneError& error : result.errors)
        if (error.line == 0)
            error = document.place(document.offset_of(error.pointer), error.pointer, error.message).error;
    return result;
}

}  // namespace drape
