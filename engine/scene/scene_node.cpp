#include "scene/scene_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/nearest_word.h"
#include "scene/scene_guesses.h"

namespace drape {
namespace {

std::string escaped(std::string_view token) {
    std::string out;
    for (const char c : token) {
        if (c == '~') {
            out += "~0";
        } else if (c == '/') {
            out += "~1";
        } else {
            out.push_back(c);
        }
    }
    return out;
}

std::string key_hint(const Definition& object, const std::string& misspelt) {
    if (const std::string_view meant = guessed_key(object.name, misspelt); !meant.empty())
        return fmt::format("expected {}", meant);
    const std::string_view nearest = object.nearest_key(misspelt);
    if (!nearest.empty()) return fmt::format("expected \"{}\"", nearest);
    std::string keys;
    for (const KeyText& key : object.keys) keys += (keys.empty() ? "" : ", ") + std::string(key.name);
    return "expected one of " + keys;
}

}  // namespace

bool Definition::has_key(std::string_view key) const {
    return std::ranges::find(keys, key, &KeyText::name) != keys.end();
}

std::string_view Definition::nearest_key(std::string_view misspelt) const {
    std::vector<std::string_view> names;
    for (const KeyText& key : keys) names.push_back(key.name);
    return nearest_word(misspelt, names);
}

bool Range::contains(double x) const {
    const bool is_above = above_low ? x > low && (low != 0.0 || static_cast<float>(x) > 0.0f) : x >= low;
    return is_above && x <= high;
}

std::string Range::text() const {
    if (low == -FLT_MAX && high == FLT_MAX) return "a number of at most 3.4e38 in magnitude";
    if (high == FLT_MAX) return fmt::format("a number {} {} (single precision)", above_low ? ">" : ">=", low);
    return fmt::format("a number in {}{}, {}]", above_low ? '(' : '[', low, high);
}

std::string Range::schema() const {
    std::string members = "\"type\": \"number\"";
    if (low != -FLT_MAX) members += fmt::format(", \"{}\": {}", above_low ? "exclusiveMinimum" : "minimum", low);
    if (high != FLT_MAX) members += fmt::format(", \"maximum\": {}", high);
    return members;
}

std::string Range::words() const {
    if (low == -FLT_MAX && high == FLT_MAX) return "number";
    if (high == FLT_MAX) return fmt::format("number {} {}", above_low ? ">" : ">=", low);
    return fmt::format("number in {}{}, {}]", above_low ? '(' : '[', low, high);
}

bool ErrorList::earlier(const Found& a, const Found& b) {
    return a.error.offset != b.error.offset ? a.error.offset < b.error.offset : a.order < b.order;
}

void ErrorList::add(const SceneDocument& document, std::size_t offset, const std::string& pointer,
                    std::string message) {
    if (counts_only(offset)) return;  // its place is not looked up: there may be a million
    const std::size_t order = count_++;
    const bool full = first_.size() == most;
    first_.push_back({order, document.place(offset, pointer, std::move(message))});
    std::ranges::push_heap(first_, earlier);
    if (!full) return;
    std::ranges::pop_heap(first_, earlier);
    first_.pop_back();
}

std::vector<SceneError> ErrorList::told() const {
    std::vector<Found> sorted = first_;
    std::ranges::sort(sorted, earlier);
    std::vector<SceneError> errors;
    for (Found& found : sorted) errors.push_back(std::move(found.error.error));
    return first_errors(std::move(errors), count_);
}

std::vector<SceneError> first_errors(std::vector<SceneError> errors, std::size_t count) {
    if (count <= ErrorList::most) return errors;
    errors.erase(errors.begin() + ErrorList::most, errors.end());
    errors.push_back({errors.front().file, 0, 0, "", fmt::format("and {} more", count - ErrorList::most)});
    return errors;
}

SceneNode::SceneNode(SceneReport& report, const Json::Value& root)
    : SceneNode(report, &root, static_cast<std::size_t>(root.getOffsetStart()), "") {
    const SceneNode up = member("up");
    if (up && up.value_->isString() && up.value_->asString() == "z") report.up = Up::z;  // its key reports any other
}

SceneNode::SceneNode(SceneReport& report, const Json::Value* value, std::size_t offset, std::string pointer)
    : report_(&report), value_(value), offset_(offset), pointer_(std::move(pointer)) {}

SceneNode SceneNode::child(const Json::Value* value, std::string_view token) const {
    const std::size_t offset = value != nullptr ? static_cast<std::size_t>(value->getOffsetStart()) : offset_;
    return {*report_, value, offset, pointer_ + "/" + escaped(token)};
}

bool SceneNode::open_object(const Definition& definition) const {
    if (value_ == nullptr) return false;
    if (!value_->isObject()) return fail_expected("an object");
    if (!definition.other_keys.empty()) return true;
    for (auto it = value_->begin(); it != value_->end(); ++it) {
        const std::string key = it.name();
        if (definition.has_key(key)) continue;
        // No error lies between a key and its value.
        if (report_->errors.counts_only(static_cast<std::size_t>(it->getOffsetStart()))) continue;
        SceneDocument& document = report_->document;
        report_->errors.add(document, document.key_offset(*value_, key, *it),
                            pointer_ + "/" + escaped(shortened(key, 80)),
                            fmt::format("{}, got the unknown key \"{}\"", key_hint(definition, key), shortened(key)));
    }
    return true;
}

void SceneNode::note_missing(const Definition& definition) const {
    if (report_->missing == nullptr) return;
    for (const KeyText& key : definition.keys)
        if (!key.default_value.empty() && !value_->isMember(std::string(key.name)))
            report_->missing->push_back({pointer_, std::string(key.name), key.default_value});
}

void SceneNode::note_default(const std::string& key, std::string value) const {
    if (report_->missing == nullptr || value_->isMember(key)) return;
    report_->missing->insert(report_->missing->begin(), {pointer_, key, std::move(value)});
}

void SceneNode::note_own_default(std::string value) const {
    if (report_->missing == nullptr) return;
    const std::size_t slash = pointer_.rfind('/');
    report_->missing->insert(report_->missing->begin(),
                             {pointer_.substr(0, slash), pointer_.substr(slash + 1), std::move(value)});
}

SceneNode SceneNode::member(std::string_view key) const {
    const bool is_object = value_ != nullptr && value_->isObject();
    return child(is_object ? value_->find(key.data(), key.data() + key.size()) : nullptr, key);
}

bool SceneNode::open_array(std::string_view what, std::size_t least, std::size_t most) const {
    if (value_ == nullptr) return false;
    if (value_->isArray() && value_->size() >= least && value_->size() <= most) return true;
    fail_expected(what);
    return false;
}

SceneNode SceneNode::element(std::size_t index) const {
    return child(&(*value_)[static_cast<Json::ArrayIndex>(index)], std::to_string(index));
}

bool SceneNode::read(double& field, const Range& range) const {
    if (value_ == nullptr) return true;
    if (!value_->isNumeric() || !range.contains(value_->asDouble())) return fail_expected(range.text());
    field = value_->asDouble();
    return true;
}

bool SceneNode::read(std::uint32_t& field, std::uint32_t low, std::uint32_t high) const {
    if (value_ == nullptr) return true;
    const double number = value_->isNumeric() ? value_->asDouble() : -1.0;
    if (!(number >= low && number <= high) || number != std::floor(number))
        return fail_expected(fmt::format("an integer from {} to {}", low, high));
    field = static_cast<std::uint32_t>(number);
    return true;
}

bool SceneNode::read(std::span<double> field, std::string_view what, const Range& range) const {
    if (value_ == nullptr) return true;
    if (!open_array(what, field.size(), field.size())) return false;
    bool fits = true;
    for (std::size_t i = 0; i < field.size(); ++i) fits = element(i).read(field[i], range) && fits;
    return fits;
}

bool SceneNode::read(Vec3& field, const Range& range) const {
    return read(std::span<double>(field), "an array of 3 numbers", range);
}

bool SceneNode::read_direction(Vec3& field) const {
    Vec3 direction = field;
    if (!read(direction)) return false;
    const double largest = std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
    if (largest == 0.0) return fail_expected("a vector that is not zero");
    for (double& x : direction) x /= largest;  // otherwise the squares of tiny components would vanish
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (std::size_t i = 0; i < 3; ++i) field[i] = direction[i] / length;
    return true;
}

bool SceneNode::read(bool& field) const {
    if (value_ == nullptr) return true;
    if (!value_->isBool()) return fail_expected("true or false");
    field = value_->asBool();
    return true;
}

bool SceneNode::read(std::string& field) const {
    if (value_ == nullptr) return true;
    if (!value_->isString()) return fail_expected("a string");
    field = value_->asString();
    return true;
}

std::filesystem::path SceneNode::file(const std::string& name) const {
    report_->files.push_back(name);
    return std::filesystem::path(report_->folder) / name;
}

bool SceneNode::fail_expected(std::string_view what) const {
    if (report_->errors.counts_only(offset_)) return false;
    return fail(fmt::format("expected {}, got {}", what, describe()));
}

bool SceneNode::fail(std::string message) const {
    report_->errors.add(report_->document, offset_, pointer_, std::move(message));
    return false;
}

void SceneNode::warn(std::string message) const {
    report_->warnings.add(report_->document, offset_, pointer_, std::move(message));
}

std::string SceneNode::describe() const {
    if (value_ == nullptr) return "nothing";
    if (value_->isNull()) return "null";
    if (value_->isBool()) return value_->asBool() ? "true" : "false";
    if (value_->isString()) return fmt::format("\"{}\"", shortened(value_->asString()));
    if (value_->isObject()) return value_->empty() ? "an empty object" : "an object";
    if (value_->isNumeric()) return shortened(report_->document.written(*value_));
    const std::string_view written = report_->document.written(*value_);
    if (written.size() <= 40 && written.find('\n') == std::string_view::npos) return std::string(written);
    return fmt::format("an array of {}", value_->size());
}

}  // namespace drape
