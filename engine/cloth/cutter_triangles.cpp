#include <array>

#include "cloth/cut_topology.h"
#include "cloth/texels.h"
#include "world/collider_pose.h"
#include "world/motion.h"

namespace drape {

namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_at(const Cutter& cutter, double time) {
    const RigidTransform motion = motion_at(cutter.path, time);
    Vec3 centroid{};
    for (const Vec3& corner : cutter.triangle)
        for (std::size_t k = 0; k < 3; ++k) centroid[k] += corner[k] / 3;
    Corners corners;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        Vec3 arm;
        for (std::size_t k = 0; k < 3; ++k) arm[k] = cutter.triangle[corner][k] - centroid[k];
        const Vec3 turned = rotate(motion.rotation, arm);
        for (std::size_t k = 0; k < 3; ++k) corners[corner][k] = centroid[k] + turned[k] + motion.translation[k];
    }
    return corners;
}

glsl::CutterTriangle active(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {texel(a, 1), texel(b, 0), texel(c, 0)};
}

bool overlaps(const Cutter& cutter, double frame_start, double frame_end) {
    return cutter.begin <= frame_end && cutter.end >= frame_start;
}

}  // namespace

bool cutters_active(const std::vector<Cutter>& cutters, double frame_start, double frame_end) {
    for (const Cutter& cutter : cutters)
        if (overlaps(cutter, frame_start, frame_end)) return true;
    return false;
}

std::vector<glsl::CutterTriangle> cutter_triangles(const std::vector<Cutter>& cutters, double frame_start,
                                                   double frame_end) {
    std::vector<glsl::CutterTriangle> all;
    for (const Cutter& cutter : cutters) {
        if (!overlaps(cutter, frame_start, frame_end)) continue;
        // The cutter acts only within its active interval.
        const Corners from = corners_at(cutter, std::max(frame_start, cutter.begin));
        const Corners to = corners_at(cutter, std::min(frame_end, cutter.end));
        all.push_back(active(to[0], to[1], to[2]));
        if (from == to) continue;
        all.push_back(active(from[0], from[1], from[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            all.push_back(active(from[k], from[next], to[next]));
            all.push_back(active(from[k], to[next], to[k]));
        }
    }
    all.resize(cutters.size() * glsl::cutter_triangle_count);
    return all;
}

}  // namespace drape
