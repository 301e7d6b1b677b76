#include "world/body_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vectors.h"
#include "world/collider_pose.h"

namespace drape {

std::array<double, 4> quaternion_of(const std::array<double, 9>& r) {
    // The largest of the four, found first, divides the others (Shepperd 1978).
    const std::array<double, 4> squares{1 + r[0] - r[4] - r[8], 1 - r[0] + r[4] - r[8], 1 - r[0] - r[4] + r[8],
                                        1 + r[0] + r[4] + r[8]};
    const auto largest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
    const double twice = std::sqrt(squares[largest]);
    const std::array<double, 3> skew{r[7] - r[5], r[2] - r[6], r[3] - r[1]};
    std::array<double, 4> found{};
    found[largest] = 0.5 * twice;
    for (std::size_t k = 0; k < 4; ++k) {
        if (k == largest) continue;
        const std::size_t a = std::min(k, largest), b = std::max(k, largest);
        found[k] = (b == 3 ? skew[a] : r[3 * a + b] + r[3 * b + a]) / (2 * twice);
    }
    return found;
}

std::array<double, 9> rotation_of(const std::array<double, 4>& q) {
    const auto [x, y, z, w] = q;
    const double s = 2 / (x * x + y * y + z * z + w * w);
    return {1 - s * (y * y + z * z), s * (x * y - z * w),     s * (x * z + y * w),
            s * (x * y + z * w),     1 - s * (x * x + z * z), s * (y * z - x * w),
            s * (x * z - y * w),     s * (y * z + x * w),     1 - s * (x * x + y * y)};
}

namespace {

/// Returns the angles about x, then y, then z, degrees, of a rotation (world/motion.h).
Vec3 angles_of(const std::array<double, 9>& r) {
    constexpr double degrees = 180 / std::numbers::pi;
    const double across = std::hypot(r[0], r[3]);
    if (across < 1e-12) return {degrees * std::atan2(-r[5], r[4]), degrees * std::atan2(-r[6], across), 0};
    return {degrees * std::atan2(r[7], r[8]), degrees * std::atan2(-r[6], across), degrees * std::atan2(r[3], r[0])};
}

}  // namespace

Collider placed(const Collider& body, const BodyState& state) {
    Collider now = body;
    now.mass.reset();
    now.rotate = {};
    now.path.keys.clear();
    // What its shape alone has of a pose comes first.
    const ColliderPose own = collider_pose(now, 0);
    const std::array<double, 9> turn = rotation_of(state.turn);
    std::array<double, 9> path{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) path[3 * i + j] += turn[3 * i + k] * own.rotation[3 * j + k];
    now.path.keys = {{0, minus(state.position, own.center), angles_of(path)}};
    return now;
}

std::vector<Collider> placed(const std::vector<Collider>& colliders, std::span<const BodyState> bodies) {
    std::vector<Collider> all = colliders;
    for (const BodyState& body : bodies) all[body.collider] = placed(all[body.collider], body);
    return all;
}

}  // namespace drape
