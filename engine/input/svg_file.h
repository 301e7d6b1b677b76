// Reads the shapes of an SVG file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "input/svg_path.h"

namespace drape::input {

/// Which of a drawing's shapes count, and how large they are.
struct SvgChoice {
    std::string element;         ///< the id of a shape or a group; empty: all shapes but those that are only defined
    std::optional<double> unit;  ///< m of a user unit; nothing: by the drawing's width and viewBox, a pixel 1/96 inch
    double tolerance = 1e-5;     ///< m: how far pieces of curves may be away from them
};

/// Returns the curves, in m, of the path, rect, circle, ellipse, polygon and polyline elements of an SVG file, each
/// closed, with the transforms of theirs and of the groups around them (SVG 1.1, 7 to 9): x to the right, y down.
/// Throws OutputError where the file cannot be read or is no XML, and std::invalid_argument whose text says what was
/// expected of which shape.
std::vector<PathCurve> read_svg(const std::filesystem::path& path, const SvgChoice& choice);

}  // namespace drape::input
