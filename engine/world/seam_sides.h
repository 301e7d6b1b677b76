// Finds the particles of a seam's sides.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// The particles of a side from one end to the other.
struct SeamRun {
    std::vector<std::uint32_t> particles;  ///< row * columns + column
    std::vector<double> ways;              ///< of the side's length on the flat cloth, what lies before each: 0 .. 1
    double length = 0;                     ///< m, of that
};

/// Returns the other order of a side.
SeamRun reversed(SeamRun run);

/// What is wrong with a side.
struct SideFault {
    std::string below;  ///< JSON pointer of the culprit, from the side on
    std::string text;   ///< "expected ..."
};
/// Finds out whether a cloth has a side: exactly one of a border and two points is given, the points are within half a
/// cell of particles of one rim, and these are two.
std::optional<SideFault> side_fault(const Cloth& cloth, const SeamSide& side);

/// Returns the particles of a side that has no fault: a border's by rising row or column, or those of a rim between the
/// particles nearest to two points, on the shorter way or the longer one.
SeamRun particles_of(const Cloth& cloth, const SeamSide& side);

}  // namespace drape
