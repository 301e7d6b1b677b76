#include "picture/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/vectors.h"
#include "picture/camera.h"
#include "picture/picture_places.h"
#include "world/body_pose.h"
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

Camera automatic_camera(const SceneDescription& scene, double aspect) {
    Framing framing(scene, aspect);
    for (const Vec3& point : subject(scene)) framing.add(point);
    if (const auto camera = framing.camera()) return *camera;
    Camera camera;  // of an empty scene
    camera.position = in_world(scene.up, camera.position);
    camera.target = in_world(scene.up, camera.target);
    camera.fov = 34;
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

Framing::Framing(const SceneDescription& scene, double aspect) {
    forward_ = unit(in_world(scene.up, {-0.5, -0.4, -0.85}));
    fov_ = 34;
    if (scene.camera) {
        const Camera start = camera_at(*scene.camera, 0);
        forward_ = unit(sum(start.target, start.position, -1));
        fov_ = start.fov;
    }
    right_ = unit(cross(forward_, in_world(scene.up, {0, 1, 0})));
    if (length(right_) == 0) right_ = {1, 0, 0};  // it looks straight up or down
    up_ = cross(right_, forward_);
    half_high_ = std::tan(fov_ * std::numbers::pi / 360) * 0.9;
    half_wide_ = half_high_ * aspect;
    reach_.fill(-infinity);
}

std::array<Vec3, 6> Framing::directions() const {
    return {sum(right_, forward_, -half_wide_),
            sum(sum({0, 0, 0}, right_, -1), forward_, -half_wide_),
            sum(up_, forward_, -half_high_),
            sum(sum({0, 0, 0}, up_, -1), forward_, -half_high_),
            forward_,
            sum({0, 0, 0}, forward_, -1)};
}

void Framing::add(const Vec3& point) {
    const std::array<Vec3, 6> along = directions();
    for (std::size_t k = 0; k < along.size(); ++k) reach_[k] = std::max(reach_[k], dot(point, along[k]));
}

void Framing::add(const Collider& collider, double time) {
    const std::array<Vec3, 6> along = directions();
    for (std::size_t k = 0; k < along.size(); ++k)
        if (const auto reach = reach_along(collider, time, along[k])) reach_[k] = std::max(reach_[k], *reach);
}

void Framing::add(const SceneDescription& scene, const FinishedFrame& frame) {
    for (const std::span<const float> cloth : frame.positions)
        for (std::size_t at = 0; at + 3 < cloth.size(); at += 4) add(Vec3{cloth[at], cloth[at + 1], cloth[at + 2]});
    for (const Collider& collider : placed(scene.colliders, frame.bodies)) add(collider, frame.frame / scene.time.fps);
}

std::optional<Camera> Framing::camera() const {
    const auto& [rightmost, leftmost, highest, lowest, farthest, nearest] = reach_;
    if (!(farthest > -infinity)) return {};
    // A camera at x, y and z along its axes shows all up to its right side if x is at least `rightmost` + half_wide z,
    // and so for the others: from the farthest such z the planes of two sides meet all of it.
    const double z = std::min({-(rightmost + leftmost) / (2 * half_wide_), -(highest + lowest) / (2 * half_high_),
                               -nearest - 0.02 * std::max(farthest + nearest, 1e-6)});
    Camera camera;
    camera.fov = fov_;
    camera.position =
        sum(sum(sum({0, 0, 0}, right_, 0.5 * (rightmost - leftmost)), up_, 0.5 * (highest - lowest)), forward_, z);
    camera.target = sum(camera.position, forward_, 0.5 * (farthest - nearest) - z);
    return camera;
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
