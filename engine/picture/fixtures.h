// Poles, rails and knobs that hold a pinned cloth in the picture, and the rims of blades. They are drawn and cast
// shadows, but touch no cloth.
#pragma once

#include <limits>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// A drawn rod, or a ball where both ends are one; it moves as its pin does.
struct Fixture {
    Vec3 from, to;      ///< m, before the pin moves
    double radius = 0;  ///< m
    MotionPath path;
    Vec3 pivot;  ///< m; the path rotates about it
    double begin = -std::numeric_limits<double>::infinity(),
           end = std::numeric_limits<double>::infinity();  ///< s: seen
    Vec3 color{0.30, 0.29, 0.28};                          ///< sRGB
};

/// A pinned row or column, and three or more single particles in a line, hang on a rail with a knob at each end, or on
/// a pole with a knob on top when they stand upright; a single pinned particle hangs on a pole of its own where there
/// is a floor to stand on and the pin does not move, and on a knob otherwise. Nothing is drawn where `image.fixtures`
/// is false or more than 256 pins would need one. A cutter's triangle has a rim of steel while it is active, unless
/// `image.blades` is false.
std::vector<Fixture> fixtures(const SceneDescription& scene);

/// Returns the fixture as a collider for drawing at `time` (s).
Collider posed(const Fixture& fixture, double time);

}  // namespace drape
