// Functions that framing and fixtures share.
#pragma once

#include <optional>
#include <vector>

#include "drape/scene.h"

namespace drape {

inline Vec3 sum(const Vec3& a, const Vec3& b, double scale = 1) {
    return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}

/// Returns the height of the highest level floor that is not above `height`, m; nothing without one. `up` is the
/// coordinate that is the height.
inline std::optional<double> floor_below(const std::vector<Collider>& colliders, double height, std::size_t up) {
    std::optional<double> found;
    for (const Collider& collider : colliders) {
        const Plane* plane = special(collider.shape).plane;
        if (!plane || plane->normal[up] < 0.99 || collider.rotate != Vec3{0, 0, 0}) continue;
        const double level = plane->offset / plane->normal[up];
        if (level <= height && (!found || level > *found)) found = level;
    }
    return found;
}

}  // namespace drape
