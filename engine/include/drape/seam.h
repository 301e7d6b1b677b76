// What sews the cloths of a scene together.
#pragma once

#include <string>

#include "drape/spelling.h"

namespace drape {

/// A border of a cloth's grid: left is column 0, top is row 0.
enum class SeamEdge { left, right, top, bottom };
inline constexpr Spelling<SeamEdge> seam_edge_spellings[] = {
    {"left", SeamEdge::left}, {"right", SeamEdge::right}, {"top", SeamEdge::top}, {"bottom", SeamEdge::bottom}};

/// One side of a seam.
struct SeamSide {
    std::string cloth;  ///< its name
    SeamEdge edge = SeamEdge::left;
    bool operator==(const SeamSide&) const = default;
};

/// Two borders that are one from the start on (engine/docs/physics.md 12). They have as many particles, which start in
/// pairs at one place each (world/seams.h).
struct Seam {
    SeamSide a, b;
    bool operator==(const Seam&) const = default;
};

}  // namespace drape
