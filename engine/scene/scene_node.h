// A cursor over the document reads a value into a field and reports, with its place, what does not fit.
#pragma once

#include <json/value.h>

#include <array>
#include <cfloat>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/scene_document.h"
#include "scene/scene_format.h"

namespace drape {

/// Keeps the first errors or warnings of a text, in its order, and counts the rest.
class ErrorList {
  public:
    static constexpr std::size_t most = 100;
    void add(const SceneDocument& document, std::size_t offset, const std::string& pointer, std::string message);
    /// Counts an error at `offset` or after if it will not be told, and returns whether that is so.
    bool counts_only(std::size_t offset) {
        const bool told = first_.size() < most || offset < first_.front().error.offset;
        if (!told) ++count_;
        return !told;
    }
    bool empty() const { return count_ == 0; }
    /// Returns them in the order of the text; the last one, without a place, counts those that are not told.
    std::vector<SceneError> told() const;

  private:
    struct Found {
        std::size_t order;  ///< errors of one place are told as they were found
        PlacedError error;
    };
    static bool earlier(const Found& a, const Found& b);

    std::vector<Found> first_;  ///< a heap with the last of them in front
    std::size_t count_ = 0;
};

/// Returns the errors in order as far as they are told: beyond ErrorList::most, one without a place counts all `count`.
std::vector<SceneError> first_errors(std::vector<SceneError> errors, std::size_t count);

/// A missing key that has a published default.
struct MissingKey {
    std::string object;  ///< JSON pointer
    std::string key;
    std::string default_value;  ///< JSON
};

struct SceneReport {
    SceneDocument& document;
    ErrorList errors;
    ErrorList warnings;
    std::vector<MissingKey>* missing = nullptr;  ///< null where they are not wanted
    Up up = Up::y;                               ///< the scene's, in whose world defaults are
    std::string folder = {};                     ///< files that the scene names are looked for here
    std::vector<std::string> files = {};         ///< those that were named
};

/// The numbers that a field may have. The kernels work in single precision, so "finite" means finite there.
struct Range {
    double low = -FLT_MAX;
    double high = FLT_MAX;
    bool above_low = false;  ///< `low` itself is excluded

    bool contains(double x) const;
    /// Returns what an error says was expected.
    std::string text() const;
    /// Return the members of its JSON Schema, and what the document says.
    std::string schema() const;
    std::string words() const;
};
inline constexpr Range any_number{};
inline constexpr Range not_negative{0.0, FLT_MAX, false};
inline constexpr Range positive{0.0, FLT_MAX, true};
inline constexpr Range unit_interval{0.0, 1.0, false};

/// A place where a value may be. Every `read` leaves the field alone when the value is absent, reports a value that
/// does not fit, and returns whether the field can be relied on.
class SceneNode {
  public:
    SceneNode(SceneReport& report, const Json::Value& root);

    explicit operator bool() const { return value_ != nullptr; }
    const std::string& pointer() const { return pointer_; }
    const Json::Value* value() const { return value_; }
    bool is_number() const { return value_ != nullptr && value_->isNumeric(); }

    /// Returns whether an object is here; reports anything else that is here and every key that it may not have.
    bool open_object(const Definition& definition) const;
    /// Tells the report which of the object's keys with a default are missing, where that is wanted.
    void note_missing(const Definition& definition) const;
    /// Tells the report that a missing key has this default (JSON) here, instead of the published one.
    void note_default(const std::string& key, std::string value) const;
    /// The same for the missing key that this is.
    void note_own_default(std::string value) const;
    Up up() const { return report_->up; }
    /// Returns a member of an object, which is absent where there is none.
    SceneNode member(std::string_view key) const;

    /// Returns whether an array of `least` to `most` elements is here; reports anything else that is here.
    bool open_array(std::string_view what, std::size_t least, std::size_t most) const;
    SceneNode element(std::size_t index) const;
    std::size_t size() const { return value_->size(); }

    bool read(double& field, const Range& range) const;
    bool read(std::uint32_t& field, std::uint32_t low, std::uint32_t high) const;
    bool read(std::span<double> field, std::string_view what, const Range& range) const;
    bool read(Vec3& field, const Range& range = any_number) const;
    /// Reads a vector that is not zero; the field becomes its unit vector.
    bool read_direction(Vec3& field) const;
    bool read(bool& field) const;
    bool read(std::string& field) const;

    template <class T>
    bool read_choice(T& field, std::span<const Spelling<T>> spellings) const;

    /// Returns where the file is that the scene names here, and notes that it does.
    std::filesystem::path file(const std::string& name) const;

    /// Reports "expected <what>, got <what is here>".
    bool fail_expected(std::string_view what) const;
    bool fail(std::string message) const;
    void warn(std::string message) const;

  private:
    SceneNode(SceneReport& report, const Json::Value* value, std::size_t offset, std::string pointer);
    SceneNode child(const Json::Value* value, std::string_view token) const;
    std::string describe() const;

    SceneReport* report_;
    const Json::Value* value_;  ///< null when absent
    std::size_t offset_;        ///< place of the value, or of the nearest object around it
    std::string pointer_;
};

template <class T>
bool SceneNode::read_choice(T& field, std::span<const Spelling<T>> spellings) const {
    if (value_ == nullptr) return true;
    std::string what;
    for (const Spelling<T>& spelling : spellings) {
        if (value_->isString() && value_->asString() == spelling.name) {
            field = spelling.value;
            return true;
        }
        what += (what.empty() ? "\"" : " or \"") + std::string(spelling.name) + "\"";
    }
    return fail_expected(what);
}

/// Reads the whole scene by the table (scene_format.cpp).
bool read_scene_object(const SceneNode& root, SceneDescription& scene);

}  // namespace drape
