// Scene file -> SceneDescription, or every error of the file at once, each with its place.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/error.h"
#include "drape/scene.h"

namespace drape {

/// One thing wrong with (or, as a warning, worth saying about) a scene.
struct SceneError {
    std::string file;          ///< the file's name, or `--set '/pointer=value'` for an override
    std::uint32_t line = 0;    ///< from 1; 0 = the place has no line (an override, an unreadable file)
    std::uint32_t column = 0;  ///< from 1, in bytes
    std::string pointer;       ///< JSON pointer; empty for the document itself and for syntax errors
    std::string message;

    /// `file:line:column: /json/pointer: message`, without the parts that are not known; on one line.
    std::string text() const;
    bool operator==(const SceneError&) const = default;
};

struct SceneResult {
    std::optional<SceneDescription> scene;  ///< present exactly when `errors` is empty
    std::vector<SceneError> errors;         ///< in the order of the text, those of overrides last
    std::vector<SceneError> warnings;
    std::string text;         ///< of the file, without overrides: what was read is what is hashed
    bool unreadable = false;  ///< the file could not be read at all: an I/O error, not a scene error
};

/// A scene that cannot be run, with all its errors.
class SceneFailure : public Error {
  public:
    explicit SceneFailure(SceneResult result);
    const SceneResult& result() const { return result_; }

  private:
    SceneResult result_;
};

/// Most bytes a scene file may have.
inline constexpr std::size_t scene_file_byte_limit = std::size_t{16} << 20;
/// Most particles of all cloths of a scene together.
inline constexpr std::uint64_t scene_particle_limit = 16'000'000;

/// Reads a scene file. `overrides` are `/json/pointer=value` strings, applied in order before anything is
/// checked: the value is JSON, or a plain word, which is taken as a string. A pointer may name a missing
/// member, whose missing parent objects are then made; an index must be within its array. Never throws for
/// anything in the file or in an override.
SceneResult read_scene(const std::string& path, std::span<const std::string> overrides = {});

/// The same for text already in memory; `file_name` is only used to say where errors are.
SceneResult read_scene_text(std::string_view text, const std::string& file_name,
                            std::span<const std::string> overrides = {});

/// The scene of `read_scene` or `read_scene_text`. Throws SceneFailure.
SceneDescription load_scene(const std::string& path, std::span<const std::string> overrides = {});
SceneDescription parse_scene(std::string_view text);

/// The JSON of a scene that can be read, with its overrides applied and every missing key that has a published default
/// written out, so that it says the same when defaults change. Throws SceneFailure.
std::string resolved_scene(std::string_view text, std::span<const std::string> overrides = {});

/// The published JSON Schema (draft-07), committed as engine/scene/scene.schema.json.
std::string scene_schema();

/// The format as a Markdown document, committed as engine/docs/scene_format.md.
std::string scene_format_markdown();

}  // namespace drape
