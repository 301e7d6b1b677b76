// Measures how deep the drawn surface of a cloth is in colliders, at points all over its triangles, in double
// precision, from positions alone.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "cloth/grid.h"
#include "world/surface_distance.h"

namespace drape::test {

struct DrawnDepth {
    double deepest = -1e300;  ///< m; below zero: outside
    std::size_t points = 0;   ///< number of points looked at
};

/// Visits points of a triangle that has `parts` parts along each edge: corners, points on edges, points inside.
template <class Visit>
void for_points_of(const std::array<Vec3, 3>& corners, int parts, const Visit& visit) {
    for (int i = 0; i <= parts; ++i)
        for (int j = 0; i + j <= parts; ++j) {
            const double b = double(i) / parts, c = double(j) / parts, a = 1 - b - c;
            Vec3 point;
            for (std::size_t k = 0; k < 3; ++k) point[k] = a * corners[0][k] + b * corners[1][k] + c * corners[2][k];
            visit(point);
        }
}

/// Depth of a cloth whose particles are at `positions` in a collider at a time (s). Triangles too far away to reach it
/// are left out.
inline DrawnDepth drawn_depth(const Grid& grid, const std::vector<Vec3>& positions, const Collider& collider,
                              double time, int parts = 8) {
    const ColliderPose pose = collider_pose(collider, time);
    const double reach = shape_geometry(collider.shape).reach;
    DrawnDepth depth;
    const std::vector<std::uint32_t> triangles = grid.triangle_indices();
    for (std::size_t k = 0; k < triangles.size(); k += 3) {
        const std::array<Vec3, 3> corners{positions[triangles[k]], positions[triangles[k + 1]],
                                          positions[triangles[k + 2]]};
        double longest = 0;
        for (std::size_t n = 0; n < 3; ++n)
            longest = std::max(longest, length(minus(corners[n], corners[(n + 1) % 3])));
        if (length(minus(corners[0], pose.center)) > reach + longest) continue;
        const auto distance = [&](const Vec3& point) {
            return std::visit(
                [&](const auto& shape) { return exact::shape_distance(shape, exact::to_local(pose, point)); },
                collider.shape);
        };
        if (distance(corners[0]) > longest) continue;
        for_points_of(corners, parts, [&](const Vec3& point) {
            depth.deepest = std::max(depth.deepest, -distance(point));
            ++depth.points;
        });
    }
    return depth;
}

}  // namespace drape::test
