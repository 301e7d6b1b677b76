// Reads a scene file into a SceneDescription, or tells every error of the file at once, each with its place.
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

/// A thing that is wrong with a scene or, as a warning, worth saying about it.
struct SceneError {
    std::string file;          ///< the file's name, or `--set '/pointer=value'` for an override
    std::uint32_t line = 0;    ///< from 1; 0 = the place has no line (an override, an unreadable file)
    std::uint32_t column = 0;  ///< from 1, in bytes
    std::string pointer;       ///< JSON pointer; empty for the document itself and for syntax errors
    std::string message;

    /// Returns `file:line:column: /json/pointer: message` on one line, without the parts that are not known.
    std::string text() const;
    bool operator==(const SceneError&) const = default;
};

struct SceneResult {
    std::optional<SceneDescription> scene;  ///< present exactly when `errors` is empty
    std::vector<SceneError> errors;         ///< in the order of the text, those of overrides last
    std::vector<SceneError> warnings;
    std::string text;                  ///< the file's text as read, without overrides: what is read is what is hashed
    std::vector<std::string> files{};  ///< those that the scene takes shapes and maps from, as it names them
    bool unreadable = false;           ///< the file could not be read at all: an I/O error, not a scene error
};

/// Thrown for a scene that cannot be run; holds all its errors.
class SceneFailure : public Error {
  public:
    explicit SceneFailure(SceneResult result);
    const SceneResult& result() const { return result_; }

  private:
    SceneResult result_;
};

inline constexpr std::size_t scene_file_byte_limit = std::size_t{16} << 20;
/// All cloths of a scene together have at most this many particles.
inline constexpr std::uint64_t scene_particle_limit = 16'000'000;

/// Reads a scene file. `overrides` are `/json/pointer=value` strings, applied in order before anything is
/// checked: the value is JSON, or a plain word, which is taken as a string. A pointer may name a missing
/// member, whose missing parent objects are then made; an index must be within its array. Never throws for
/// anything in the file or in an override.
SceneResult read_scene(const std::string& path, std::span<const std::string> overrides = {});

/// Reads a scene's text that is already in memory; `file_name` only says where errors are. Files that the scene names
/// are looked for in `folder`; empty: the working directory.
SceneResult read_scene_text(std::string_view text, const std::string& file_name,
                            std::span<const std::string> overrides = {}, const std::string& folder = {});

/// Returns the folder in which a scene file looks for files that it names: its own; that of a pipe is the working
/// directory's, "".
std::string scene_folder(const std::string& path);

/// Reads a mesh's files. Throws an Error without a place.
void read_file(Mesh& mesh);
/// Reads an appearance's texture. Throws an Error without a place.
void read_file(Appearance& appearance);

/// Return what `read_scene` or `read_scene_text` reads, or throw SceneFailure.
SceneDescription load_scene(const std::string& path, std::span<const std::string> overrides = {});
SceneDescription parse_scene(std::string_view text);

/// Returns the JSON of a scene that can be read, with its overrides applied and every missing key that has a published
/// default written out, so that it says the same when defaults change. Throws SceneFailure.
std::string resolved_scene(std::string_view text, std::span<const std::string> overrides = {},
                           const std::string& folder = {});

/// Returns the JSON of a scene as `resolved_scene` does, with these actions and with frames 0 to `last`: what was
/// told for later ones has not been followed yet and is left out. Throws SceneFailure.
std::string scene_with_actions(std::string_view text, const SceneActions& actions, std::uint32_t last,
                               std::span<const std::string> overrides = {}, const std::string& folder = {});

/// Returns the published JSON Schema (draft-07), committed as engine/scene/scene.schema.json.
std::string scene_schema();

/// Returns the format as a Markdown document, committed as engine/docs/scene_format.md.
std::string scene_format_markdown();

}  // namespace drape
