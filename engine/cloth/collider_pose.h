// Where a collider is at a time: its rest pose with its key-framed motion on top. One definition for the
// simulation and the pictures.
#pragma once

#include <array>

#include "scene/scene_description.h"

namespace drape {

/// x_world = center + rotation * x_local, metres.
struct ColliderPose {
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row major
    Vec3 center{0, 0, 0};
    bool operator==(const ColliderPose&) const = default;
};

/// The path's rotation turns the rest pose about the collider's own centre; its translation is added.
ColliderPose collider_pose(const SphereCollider& sphere, double time);
ColliderPose collider_pose(const BoxCollider& box, double time);
ColliderPose collider_pose(const EllipsoidCollider& ellipsoid, double time);
/// A plane's centre is its foot point normal * offset, carried along by the path; its world normal is
/// `rotate(pose.rotation, plane.normal)`.
ColliderPose collider_pose(const PlaneCollider& plane, double time);

/// rotation * v.
Vec3 rotate(const std::array<double, 9>& rotation, const Vec3& v);

}  // namespace drape
