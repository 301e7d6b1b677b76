#include "picture/camera.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "world/key_value.h"

namespace drape {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Eigen::Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

Matrix4 array(const RowMajor4& matrix) {
    Matrix4 result;
    Eigen::Map<RowMajor4>(result.data()) = matrix;
    return result;
}

double target_distance(const Camera& camera) {
    const double distance = (vector(camera.target) - vector(camera.position)).norm();
    return distance > 0 ? distance : 1.0;
}

RowMajor4 view(const Camera& camera) {
    const Eigen::Vector3d eye = vector(camera.position);
    Eigen::Vector3d forward = vector(camera.target) - eye;
    if (!(forward.norm() > 0)) forward = -Eigen::Vector3d::UnitZ();
    forward.normalize();
    Eigen::Vector3d right = forward.cross(vector(camera.up));
    // Straight up or down no horizon is left to keep level.
    if (right.norm() < 1e-9) right = Eigen::Vector3d::UnitX();
    right.normalize();
    RowMajor4 matrix = RowMajor4::Identity();
    matrix.block<1, 3>(0, 0) = right;
    matrix.block<1, 3>(1, 0) = right.cross(forward);
    matrix.block<1, 3>(2, 0) = -forward;
    matrix.block<3, 1>(0, 3) = -matrix.block<3, 3>(0, 0) * eye;
    return matrix;
}

RowMajor4 projection(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const double distance = target_distance(camera);
    const double near = distance / 100;
    const double far = distance * 1000;
    const double focal = 1 / std::tan(camera.fov * std::numbers::pi / 360);
    RowMajor4 matrix = RowMajor4::Zero();
    matrix(0, 0) = focal * height / width;
    matrix(1, 1) = -focal;
    matrix(2, 2) = far / (near - far);
    matrix(2, 3) = near * far / (near - far);
    matrix(3, 2) = -1;
    return matrix;
}

}  // namespace

Matrix4 view_matrix(const Camera& camera) { return array(view(camera)); }

Matrix4 projection_matrix(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    return array(projection(camera, width, height));
}

Matrix4 view_projection_matrix(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    return array(projection(camera, width, height) * view(camera));
}

PixelPosition project(const Camera& camera, std::uint32_t width, std::uint32_t height, const Vec3& point) {
    const Eigen::Vector4d clip = projection(camera, width, height) * (view(camera) * vector(point).homogeneous());
    if (!(clip.w() > 0)) return {0, 0, std::numeric_limits<double>::infinity()};
    return {(clip.x() / clip.w() + 1) * 0.5 * width, (clip.y() / clip.w() + 1) * 0.5 * height, clip.z() / clip.w()};
}

Camera camera_at(const Camera& camera, double time) {
    Camera still = camera;
    still.keys.clear();
    if (camera.keys.empty()) return still;
    still.position = keyed_value(camera.keys, &CameraKey::position, time);
    still.target = keyed_value(camera.keys, &CameraKey::target, time);
    return still;
}

}  // namespace drape
