// Tests build these scenes in code: one sheet of given size, no camera.
#pragma once

#include <cmath>
#include <vector>

#include "reference/model_scenes.h"

namespace drape::test {

using model_scenes::pin_box;
using model_scenes::pin_top;
using model_scenes::sheet;

/// Rolls a sheet in the xy plane without stretch about an axis in that plane through the origin, with a curvature (1/m)
/// along the direction `angle` (radians from x).
inline std::vector<Vec3> rolled(std::vector<Vec3> flat, double angle, double curvature) {
    for (Vec3& at : flat) {
        const double along = at[0] * std::cos(angle) + at[1] * std::sin(angle);
        const double shift = std::sin(curvature * along) / curvature - along;
        at = {at[0] + shift * std::cos(angle), at[1] + shift * std::sin(angle),
              (1 - std::cos(curvature * along)) / curvature};
    }
    return flat;
}

}  // namespace drape::test
