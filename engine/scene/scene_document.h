// Parses the JSON of a scene, applies its overrides, and knows the place in the text of every value.
#pragma once

#include <json/value.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/scene_reader.h"
#include "scene/scene_text.h"

namespace drape {

/// An error and the offset that it is sorted by.
struct PlacedError {
    std::size_t offset;
    SceneError error;
};

/// Values keep their offset into one text: the file followed by the value of every override. That makes the
/// place of a value independent of how it came into the tree.
class SceneDocument {
  public:
    SceneDocument(std::string_view text, std::string file_name);

    /// Applies `/json/pointer=value`. Call only while there are no errors.
    void apply_override(const std::string& override_text);

    /// Returns the errors that keep the text from being read.
    const std::vector<PlacedError>& errors() const { return errors_; }
    /// Returns the superfluous commas, which keep nothing from being read but are errors.
    const std::vector<std::size_t>& trailing_commas() const { return trailing_commas_; }
    static constexpr const char* comma_message = "expected no comma after the last member";
    const Json::Value& root() const { return root_; }

    PlacedError place(std::size_t offset, std::string pointer, std::string message) const;
    /// Returns where the value that a pointer leads to is written, or the last on the way to it that is there.
    std::size_t offset_of(const std::string& pointer) const;
    /// Returns the text that a value was written as.
    std::string_view written(const Json::Value& value) const;
    /// Returns where the key of `value`, a member of `object`, is written, or the value's own place when it has no key
    /// in the text (it came from an override).
    std::size_t key_offset(const Json::Value& object, const std::string& key, const Json::Value& value);

  private:
    struct Source {
        std::size_t begin;
        std::string name;
    };

    void parse(std::string_view text);
    void fail(std::size_t offset, std::string pointer, std::string message);
    Json::Value* find_target(const std::string& pointer, std::size_t offset);
    Json::Value* find_element(Json::Value& array, const std::string& token, const std::string& pointer,
                              std::size_t offset);

    std::string text_;
    LineTable lines_;  ///< lines of the file, without overrides
    std::vector<Source> sources_;
    Json::Value root_;
    std::vector<PlacedError> errors_;
    std::vector<std::size_t> trailing_commas_;
    std::map<const Json::Value*, std::map<std::string, std::size_t>> keys_;  ///< filled on demand
};

/// Returns the errors of a scene that was read from a file's text, each that has no line with the place of its pointer
/// there: what only a simulation finds.
SceneResult with_places(SceneResult result, std::string_view text, const std::string& file_name,
                        std::span<const std::string> overrides);

}  // namespace drape
