#include "cloth/collider_pose.h"

#include <cstddef>

#include "scene/motion.h"

namespace drape {
namespace {

std::array<double, 9> product(const std::array<double, 9>& a, const std::array<double, 9>& b) {
    std::array<double, 9> result{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            for (std::size_t k = 0; k < 3; ++k) result[3 * row + column] += a[3 * row + k] * b[3 * k + column];
    return result;
}

ColliderPose pose_about(const Vec3& center, const ColliderCommon& collider, double time) {
    const RigidTransform motion = motion_at(collider.path, time);
    ColliderPose pose{product(motion.rotation, rotation_matrix(collider.rotate)), center};
    for (std::size_t axis = 0; axis < 3; ++axis) pose.center[axis] += motion.translation[axis];
    return pose;
}

}  // namespace

Vec3 rotate(const std::array<double, 9>& rotation, const Vec3& v) {
    Vec3 result{0, 0, 0};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t k = 0; k < 3; ++k) result[row] += rotation[3 * row + k] * v[k];
    return result;
}

ColliderPose collider_pose(const SphereCollider& sphere, double time) {
    return pose_about(sphere.center, sphere, time);
}
ColliderPose collider_pose(const BoxCollider& box, double time) { return pose_about(box.center, box, time); }
ColliderPose collider_pose(const EllipsoidCollider& ellipsoid, double time) {
    return pose_about(ellipsoid.center, ellipsoid, time);
}
ColliderPose collider_pose(const PlaneCollider& plane, double time) {
    const Vec3 foot{plane.normal[0] * plane.offset, plane.normal[1] * plane.offset, plane.normal[2] * plane.offset};
    return pose_about(foot, plane, time);
}

}  // namespace drape
