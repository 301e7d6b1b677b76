#include "picture/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/vectors.h"
#include "picture/picture_places.h"
#include "world/collider_pose.h"
#include "world/start.h"
#include "world/up.h"
#include "world/weather.h"

namespace drape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A particle and where it starts, m.
struct ClothPoint {
    Vec3 at;
    std::uint32_t column, row;
};

struct Bounds {
    Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    bool empty() const { return !(low[0] <= high[0]); }
    void add(const Vec3& center, double radius) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], center[i] - radius);
            high[i] = std::max(high[i], center[i] + radius);
        }
    }
    void add(const Vec3& center, double radius, const MotionPath& path) {
        if (path.keys.empty()) add(center, radius);
        for (const MotionKey& key : path.keys) add(sum(center, key.translate), radius);
    }
};

/// Returns the cloth's corners, of a given shape more of its particles.
std::vector<ClothPoint> outline(const Cloth& cloth) {
    const std::uint32_t parts = cloth.start.empty() ? 1 : 16;
    std::vector<ClothPoint> result;
    for (std::uint32_t j = 0; j <= parts; ++j)
        for (std::uint32_t i = 0; i <= parts; ++i) {
            const std::uint32_t column = i * (cloth.grid[0] - 1) / parts, row = j * (cloth.grid[1] - 1) / parts;
            result.push_back({start_place(cloth, column, row), column, row});
        }
    return result;
}

Vec3 landed(const Vec3& point, const Plane& plane) {
    return sum(point, plane.normal, plane.offset - dot(point, plane.normal));
}

void add_cloth(const Cloth& cloth, const std::vector<Collider>& colliders, Bounds& bounds) {
    const double swing = 0.25 * 0.5 * std::hypot(cloth.size[0], cloth.size[1]);
    for (const auto& [point, column, row] : outline(cloth)) {
        bounds.add(point, swing);
        for (const Pin& pin : cloth.pins) bounds.add(point, 0, pin.path);
        for (const Collider& collider : colliders)
            if (const Plane* plane = special(collider.shape).plane) bounds.add(landed(point, *plane), swing);
    }
}

Vec3 unit(const Vec3& v) {
    const double size = length(v);
    return size > 0 ? Vec3{v[0] / size, v[1] / size, v[2] / size} : Vec3{0, 0, 0};
}

/// Returns how far two particles are from each other on the cloth: as placed, or with a given shape spread out.
double apart(const Cloth& cloth, const ClothPoint& a, const ClothPoint& b) {
    if (cloth.start.empty()) return length(sum(a.at, b.at, -1));
    const double across = cloth.size[0] * (double(a.column) - b.column) / (cloth.grid[0] - 1);
    return std::hypot(across, cloth.size[1] * (double(a.row) - b.row) / (cloth.grid[1] - 1));
}

/// Returns where `point` of a cloth comes to hang straight below the nearest of its pins.
std::optional<Vec3> hanging(const Cloth& cloth, const ClothPoint& point, const Vec3& down) {
    std::optional<Vec3> place;
    double nearest = infinity;
    for (const Pin& pin : cloth.pins)
        for (const bool last_column : {false, true})
            for (const bool last_row : {false, true}) {
                const std::uint32_t column = (last_column ? pin.particles.last : pin.particles.first)[0];
                const std::uint32_t row = (last_row ? pin.particles.last : pin.particles.first)[1];
                const Vec3 held = start_place(cloth, column, row);
                const double distance = apart(cloth, point, {held, column, row});
                if (pin.release || distance >= nearest) continue;
                nearest = distance;
                place = sum(held, down, distance);
            }
    return place;
}

/// Returns points that the picture should hold.
std::vector<Vec3> subject(const SceneDescription& scene) {
    std::vector<Vec3> points;
    const std::size_t up = up_axis(scene.up);
    const Vec3 down = unit(gravity_at(scene, 0));
    const auto at_height = [up](Vec3 point, double height) {
        point[up] = height;
        return point;
    };
    const bool lands_on_bodies =
        std::ranges::any_of(scene.colliders, [](const Collider& collider) { return !special(collider.shape).plane; });
    for (const Cloth& cloth : scene.cloths) {
        for (const ClothPoint& each : outline(cloth)) {
            const Vec3& corner = each.at;
            points.push_back(corner);
            for (const Pin& pin : cloth.pins)
                for (const MotionKey& key : pin.path.keys) points.push_back(sum(corner, key.translate));
            const std::optional<Vec3> hung = hanging(cloth, each, down);
            const std::optional<double> floor = floor_below(scene.colliders, corner[up], up);
            // Wind keeps a flag up; cloth that nothing holds comes down, and draws together on bodies that it meets.
            if (hung && !scene.wind.blows())
                points.push_back(at_height(*hung, std::max((*hung)[up], floor.value_or(-infinity))));
            if (!hung && floor) {
                const Vec3 middle = start_place(cloth, cloth.grid[0] / 2, cloth.grid[1] / 2);
                const Vec3 end = sum(middle, sum(corner, middle, -1), lands_on_bodies ? 0.5 : 1);
                points.push_back(at_height(end, *floor));
            }
        }
    }
    for (const Collider& collider : scene.colliders) {
        const ShapeGeometry shape = shape_geometry(collider.shape);
        if (!(shape.reach < infinity)) continue;
        Bounds bounds;
        bounds.add(shape.center, shape.reach / std::numbers::sqrt3, collider.path);
        for (int i = 0; i < 8; ++i)
            points.push_back({(i & 1 ? bounds.high : bounds.low)[0], (i & 2 ? bounds.high : bounds.low)[1],
                              (i & 4 ? bounds.high : bounds.low)[2]});
    }
    return points;
}

/// The extents of points seen from `eye` along `forward` are tangents of the angles to the outermost.
struct Seen {
    double left = infinity, right = -infinity, low = infinity, high = -infinity, nearest = infinity;
};
Seen seen(const std::vector<Vec3>& points, const Vec3& eye, const std::array<Vec3, 3>& axes) {
    Seen result;
    for (const Vec3& point : points) {
        const Vec3 away = sum(point, eye, -1);
        const double depth = dot(away, axes[2]);
        result.nearest = std::min(result.nearest, depth);
        result.left = std::min(result.left, dot(away, axes[0]) / depth);
        result.right = std::max(result.right, dot(away, axes[0]) / depth);
        result.low = std::min(result.low, dot(away, axes[1]) / depth);
        result.high = std::max(result.high, dot(away, axes[1]) / depth);
    }
    return result;
}

Camera automatic_camera(const SceneDescription& scene, double aspect) {
    Camera camera;
    camera.position = in_world(scene.up, camera.position);
    camera.target = in_world(scene.up, camera.target);
    camera.fov = 34;
    std::vector<Vec3> points = subject(scene);
    if (points.empty()) return camera;
    Bounds bounds;
    for (const Vec3& point : points) bounds.add(point, 0);
    const Vec3 diagonal = sum(bounds.high, bounds.low, -1);
    Vec3 target = sum(bounds.low, diagonal, 0.5);
    const double size = std::max(length(diagonal), 1e-6);
    const Vec3 forward = unit(in_world(scene.up, {-0.5, -0.4, -0.85}));
    const Vec3 right = unit(cross(forward, in_world(scene.up, {0, 1, 0})));
    const Vec3 up = cross(right, forward);
    const double half_high = std::tan(camera.fov * std::numbers::pi / 360) * 0.9, half_wide = half_high * aspect;
    // Bisection finds the nearest distance that shows all of it; the middle of what is seen becomes the target.
    double near = 0.5 * size, far = 20 * size;
    for (int round = 0; round < 60; ++round) {
        const double distance = 0.5 * (near + far);
        const Seen view = seen(points, sum(target, forward, -distance), {right, up, forward});
        const bool behind = view.nearest <= 0.02 * size;
        const double wide = 0.5 * (view.right - view.left), high = 0.5 * (view.high - view.low);
        const bool fits = !behind && wide <= half_wide && high <= half_high;
        (fits ? far : near) = distance;
        if (fits && round < 30) {
            target = sum(target, right, 0.5 * (view.left + view.right) * distance);
            target = sum(target, up, 0.5 * (view.low + view.high) * distance);
        }
    }
    camera.position = sum(target, forward, -far);
    camera.target = target;
    return camera;
}

}  // namespace

BoundingSphere scene_extent(const SceneDescription& scene) {
    Bounds bounds;
    for (const Cloth& cloth : scene.cloths) add_cloth(cloth, scene.colliders, bounds);
    for (const Collider& collider : scene.colliders) {
        const ShapeGeometry shape = shape_geometry(collider.shape);
        if (shape.reach < infinity) bounds.add(shape.center, shape.reach, collider.path);
    }
    if (bounds.empty()) return {};
    const Vec3 diagonal = sum(bounds.high, bounds.low, -1);
    return {sum(bounds.low, diagonal, 0.5), std::max(0.5 * length(diagonal), 1e-6)};
}

Camera picture_camera(const SceneDescription& scene, std::uint32_t width, std::uint32_t height) {
    Camera camera = scene.camera ? *scene.camera : automatic_camera(scene, static_cast<double>(width) / height);
    camera.up = in_world(scene.up, {0, 1, 0});
    if (camera.keys.empty()) return camera;
    camera.position = camera.keys.front().position;
    camera.target = camera.keys.front().target;
    return camera;
}

}  // namespace drape
