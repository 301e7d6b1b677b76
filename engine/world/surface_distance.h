// Computes signed distances in double precision, by methods other than the shaders': to judge where cloth starts, and
// as the oracle of contact tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"
#include "drape/scene.h"
#include "mesh/mesh_shape.h"
#include "world/collider_pose.h"

namespace drape::exact {

inline Vec3 to_local(const ColliderPose& pose, const Vec3& world) {
    const Vec3 r = minus(world, pose.center);
    Vec3 local{};
    for (std::size_t k = 0; k < 3; ++k)
        local[k] = pose.rotation[k] * r[0] + pose.rotation[3 + k] * r[1] + pose.rotation[6 + k] * r[2];
    return local;
}

/// Returns the closest point of an ellipsoid, by bisection of Eberly's equation in double precision.
inline Vec3 ellipsoid_foot(const Vec3& point, const Vec3& radii) {
    const double smallest = *std::ranges::min_element(radii);
    Vec3 y = point;
    for (std::size_t k = 0; k < 3; ++k) y[k] = std::max(std::abs(y[k]), 1e-15 * radii[k]);
    double low = -smallest * smallest, high = 0;
    for (std::size_t k = 0; k < 3; ++k) high += radii[k] * radii[k] * y[k] * y[k];
    high = std::sqrt(high);  // F(high) <= 0
    const auto value = [&](double t) {
        double sum = -1;
        for (std::size_t k = 0; k < 3; ++k) {
            const double term = radii[k] * y[k] / (t + radii[k] * radii[k]);
            sum += term * term;
        }
        return sum;
    };
    for (int step = 0; step < 200; ++step) {
        const double middle = 0.5 * (low + high);
        (value(middle) > 0 ? low : high) = middle;
    }
    Vec3 foot;
    for (std::size_t k = 0; k < 3; ++k)
        foot[k] = std::copysign(radii[k] * radii[k] * y[k] / (high + radii[k] * radii[k]), point[k]);
    return foot;
}

// `local` is a point in the shape's own frame, about its centre.
inline double shape_distance(const Plane& plane, const Vec3& local) { return dot(local, plane.normal); }

inline double shape_distance(const Sphere& sphere, const Vec3& local) { return length(local) - sphere.radius; }

inline double shape_distance(const Box& box, const Vec3& local) {
    Vec3 outside{};
    double inside = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
        const double beyond = std::abs(local[k]) - box.half_extents[k];
        outside[k] = std::max(beyond, 0.0);
        inside = std::max(inside, beyond);
    }
    return inside > 0 ? length(outside) : inside;
}

inline double shape_distance(const Ellipsoid& ellipsoid, const Vec3& local) {
    const double gap = length(minus(local, ellipsoid_foot(local, ellipsoid.radii)));
    double level = -1;
    for (std::size_t k = 0; k < 3; ++k) level += std::pow(local[k] / ellipsoid.radii[k], 2);
    return level < 0 ? -gap : gap;
}

/// Finds the ball of the capsule whose surface is nearest: the distance is convex along the segment.
inline double capsule_sweep(const Capsule& capsule, const Vec3& local, Vec3* foot = nullptr) {
    const double half = 0.5 * length(minus(capsule.to, capsule.from));
    const auto radius = [&](double t) { return capsule.radii[0] + t * (capsule.radii[1] - capsule.radii[0]); };
    const auto from_center = [&](double t) { return Vec3{local[0], local[1] + half - 2 * half * t, local[2]}; };
    const auto distance = [&](double t) { return length(from_center(t)) - radius(t); };
    double low = 0, high = 1;
    for (int step = 0; step < 200; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    double best = 0.5 * (low + high);
    for (const double end : {0.0, 1.0})
        if (distance(end) <= distance(best)) best = end;
    if (foot) {
        const Vec3 out = from_center(best);
        for (std::size_t k = 0; k < 3; ++k)
            (*foot)[k] = local[k] - out[k] + radius(best) * out[k] / std::max(length(out), 1e-300);
    }
    return distance(best);
}

inline double shape_distance(const Capsule& capsule, const Vec3& local) { return capsule_sweep(capsule, local); }

inline double shape_distance(const Mesh& mesh, const Vec3& local) { return mesh.shape->distance(local) - mesh.grown; }

inline double surface_distance(const Collider& collider, const ColliderPose& pose, const Vec3& x) {
    const Vec3 local = to_local(pose, x);
    return std::visit([&](const auto& shape) { return shape_distance(shape, local); }, collider.shape);
}

/// A mesh that deforms has its form at that time.
inline double surface_distance(const Collider& collider, double time, const Vec3& x) {
    return surface_distance(formed(collider, time), collider_pose(collider, time), x);
}

inline double surface_distance(const std::vector<Collider>& colliders, double time, const Vec3& x) {
    double least = 1e300;
    for (const Collider& collider : colliders) least = std::min(least, surface_distance(collider, time, x));
    return least;
}

}  // namespace drape::exact
