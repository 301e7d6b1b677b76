// Turns the camera of a scene into matrices, and finds where a point of the world lands in the picture. Coordinates are
// right-handed; the eye looks along -z of view space. Clip space is Vulkan's: y down, depth 0 (near plane) to 1
// (far plane). The planes follow the distance d from eye to target (d/100 and 1000 d), so that a scene in millimetres
// and one in kilometres are drawn alike.
#pragma once

#include <array>
#include <cstdint>

#include "drape/scene.h"

namespace drape {

/// A matrix is row major: clip = matrix * (x, y, z, 1).
using Matrix4 = std::array<double, 16>;

/// Returns view space from world space. The camera's `up` points up in the picture; when it looks straight up or down,
/// the world's x points to the right.
Matrix4 view_matrix(const Camera& camera);
/// Returns clip space from view space; `fov` is vertical, pixels are square.
Matrix4 projection_matrix(const Camera& camera, std::uint32_t width, std::uint32_t height);
/// Returns clip space from world space.
Matrix4 view_projection_matrix(const Camera& camera, std::uint32_t width, std::uint32_t height);

/// Pixels count from the picture's top left corner, y down: the centre of the first pixel is (0.5, 0.5), so the pixel
/// that shows the point is (floor x, floor y). `depth` is what the depth buffer holds; infinity (and x, y meaningless)
/// for a point that is not in front of the eye.
struct PixelPosition {
    double x = 0, y = 0, depth = 0;
};
PixelPosition project(const Camera& camera, std::uint32_t width, std::uint32_t height, const Vec3& point);

/// Returns the camera as it stands at `time` (s), without keys.
Camera camera_at(const Camera& camera, double time);

}  // namespace drape
