// Reads the curves of an SVG path.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace drape::input {

/// One closed curve of a path, in straight pieces.
struct PathCurve {
    std::vector<std::array<double, 2>> points;  ///< the last one is joined to the first one
    std::vector<std::size_t> corners;           ///< indices of the points where the curve turns by over 20 degrees
};

/// Returns the curves of path data as SVG 1.1 (8.3) has them: M L H V C S Q T A Z and their small letters, in the
/// path's units. Each is closed, said or not. Pieces of Bezier curves and arcs are at most `tolerance` away from them.
/// Throws std::invalid_argument whose text says what was expected and where, as a count of characters.
std::vector<PathCurve> read_path(std::string_view text, double tolerance);

}  // namespace drape::input
