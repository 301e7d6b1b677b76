// Panels and the seams between them, as the readers of sewing patterns find them, and the scene that they make.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "drape/scene.h"
#include "scene/sewing_pattern.h"

namespace drape {

using PatternPoint = std::array<double, 2>;  ///< m, on the flat panel

/// A piece of a panel's rim.
struct PatternEdge {
    PatternPoint from{}, to{};
    std::string segment;  ///< of SVG path data: what leads from one to the other
    double length = 0;    ///< m
};

struct PatternPanel {
    std::string name;
    std::vector<std::vector<PatternEdge>> loops;  ///< closed; cloth is what an odd number of them goes around
    Placement placement;
};

/// Consecutive edges of a loop of a panel; `step` is 1, or -1 where they are gone through against the loop.
struct PatternSide {
    std::size_t panel = 0, loop = 0, first = 0, count = 1;
    int step = 1;
};

struct PatternSeam {
    PatternSide a, b;
};

/// Returns a point as path data has it.
std::string path_point(const PatternPoint& p);

/// Sets the result's scene and counts.
void write_pattern_scene(const std::vector<PatternPanel>& panels, const std::vector<PatternSeam>& seams,
                         const PatternOptions& options, PatternResult& result);

}  // namespace drape
