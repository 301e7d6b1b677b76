// Makes a scene of a sewing pattern: its panels become cloths with outlines, its stitches seams.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/scene_reader.h"

namespace drape {

struct PatternOptions {
    double spacing = 0.015;           ///< m: between particles, about
    double close = 1;                 ///< s: in which the seams are drawn together
    std::string fabric = "cotton";    ///< one that scenes know
    std::vector<std::string> bodies;  ///< mesh files that the clothes are for, in metres, as the scene is to name them
};

struct PatternResult {
    std::string scene;               ///< JSON; empty exactly when there are errors
    std::vector<SceneError> errors;  ///< in the order of the text
    std::size_t panels = 0, seams = 0;
    std::optional<double> metres_per_unit;  ///< of a mesh: how large a unit of its texture is
    bool unreadable = false;                ///< the file could not be read at all
};

/// Makes a scene of a pattern in GarmentCode's JSON (Korosteleva and Sorkine-Hornung 2023, "GarmentCode: Programming
/// Parametric Sewing Patterns"): `pattern` has `panels` by name, each with `translation`, `rotation` (degrees, about x,
/// then y, then z), `vertices` and a loop of `edges`, straight or with a `curvature` (quadratic, cubic, circle), and
/// `stitches`, pairs of a panel's edges; `properties` have `units_in_meter` and whether `curvature_coords` are relative
/// to an edge or absolute. What else the file says is not looked at. Never throws for anything in the text.
PatternResult read_sewing_pattern_text(std::string_view text, const std::string& file_name,
                                       const PatternOptions& options);
/// Makes a scene of a mesh in OBJ's format whose texture vertices lay it out flat: every island of the texture becomes
/// a panel, and rims of islands that are one on the mesh are sewn. The areas of mesh and islands say how large a unit
/// of the texture is; a panel starts where its flat shape is nearest to the mesh. Throws OutputError where the file
/// cannot be read.
PatternResult read_uv_pattern(const std::string& path, const PatternOptions& options);

/// Makes a scene of a file, as these do: of a mesh where its name ends in .obj, else of GarmentCode's JSON.
PatternResult read_sewing_pattern(const std::string& path, const PatternOptions& options);

}  // namespace drape
