// Sheets and thin colliders that are thrown at each other, and whether something drawn passed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <variant>
#include <vector>

#include "base/vectors.h"
#include "shared/collider_types.h"
#include "support/sheets.h"
#include "world/collider_pose.h"

namespace drape::test {

struct Random {
    std::mt19937 engine;
    double uniform(double from, double to) { return std::uniform_real_distribution(from, to)(engine); }
    double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
    Vec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Vec3 direction() {
        Vec3 v = in_cube(1);
        while (!(length(v) > 0.1 && length(v) < 1)) v = in_cube(1);
        return unit_of(v);
    }
};

/// Returns a shelf, rod, ball, plate or tapered capsule about the origin whose thinnest part is `thin` m thick.
inline Collider thin_collider(Random& random, double thin) {
    const double half = thin / 2;
    const auto wide = [&] { return random.uniform(0.15, 0.6); };
    const ColliderShape shapes[] = {Sphere{{0, 0, 0}, half},
                                    Box{{0, 0, 0}, {wide(), half, wide()}},
                                    Box{{0, 0, 0}, {half, wide(), half}},
                                    Ellipsoid{{0, 0, 0}, {wide(), half, wide()}},
                                    Capsule{{-wide(), 0, 0}, {wide(), 0, 0}, {half, half}},
                                    Capsule{{0, -wide(), 0}, {0, wide(), 0}, {half, half * random.uniform(2, 20)}}};
    Collider collider{shapes[std::uniform_int_distribution(0, 5)(random.engine)]};
    collider.rotate = {random.uniform(0, 360), random.uniform(0, 360), random.uniform(0, 360)};
    collider.friction = random.uniform(0, 1);
    return collider;
}

/// A sheet and a collider thrown at each other, one substep a frame, so that every substep can be judged; in it one
/// goes `most_way` m at most, if the speed allows.
inline SceneDescription thrown(Random& random, double speed, std::uint32_t most_columns, double most_way = 0.7) {
    const auto columns = static_cast<std::uint32_t>(std::lround(random.log_uniform(5, most_columns)));
    SceneDescription scene = sheet(columns, columns, 0.8, 0.8, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.thickness = random.log_uniform(1e-3, 1e-2);
    const SolverMethod methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};
    scene.solver.method = methods[std::uniform_int_distribution(0, 2)(random.engine)];
    // Half of the throws go so slowly for their substeps that nothing may pass, if the cloth does not tear open.
    const bool slow = random.uniform(0, 1) < 0.5;
    const double thin = slow ? random.uniform(1e-2, 3e-2) : random.log_uniform(5e-4, 3e-2);
    const double way =
        slow ? random.uniform(0.2, 0.75) * (thin / 2 + cloth.thickness) : random.log_uniform(5e-3, most_way);
    if (slow) speed = std::min(speed, random.log_uniform(1, 20));
    scene.time.fps = std::min(speed / way, 10000.0);
    const bool cloth_moves = random.uniform(0, 1) < 0.3;
    const Vec3 u = random.direction();
    Vec3 v = random.direction();
    v = unit_of(minus(v, times(dot(u, v), u)));
    cloth.placement = {plus(times(-0.4, plus(u, v)), random.in_cube(0.05)), u, v};
    scene.gravity = {0, 0, 0};
    Collider collider = thin_collider(random, thin);
    const Vec3 normal = cross(u, v);
    const double ahead = 0.7 + random.uniform(1, 2) * way;
    const double until = 2 * ahead / speed;
    const double turn = random.uniform(0, 1) < 0.5 ? 0 : random.uniform(-90, 90);
    if (cloth_moves) {  // the same fall, the cloth pulled at the collider
        scene.gravity = times(speed * speed / (2 * ahead), normal);
        collider.path = {{{0, times(ahead, normal), {0, 0, 0}}, {until, times(ahead, normal), {turn, turn, 0}}}};
        scene.time.frame_count = static_cast<std::uint32_t>(std::ceil(2.2 * ahead / speed * scene.time.fps)) + 4;
    } else {
        collider.path = {{{0, times(ahead, normal), {0, 0, 0}}, {until, times(-ahead, normal), {turn, turn, 0}}}};
        scene.time.frame_count = static_cast<std::uint32_t>(std::ceil(until * scene.time.fps)) + 4;
    }
    scene.colliders = {collider};
    return scene;
}

/// Returns points in the middle of a collider, in its frame: whatever passes through it passes by most of them.
inline std::vector<Vec3> middle_of(const Collider& collider) {
    /// So many points on either side of the middle one, and how far from it they may be.
    struct Spread {
        int along, across;
        double farthest = 2;
    };
    const Spread spread = std::visit(ForEachKind{[](const Plane&) {
                                                     return Spread{2, 2};
                                                 },
                                                 [](const Sphere&) {
                                                     return Spread{0, 0};
                                                 },
                                                 [](const Box&) {
                                                     return Spread{2, 2};
                                                 },
                                                 [](const Ellipsoid&) {
                                                     return Spread{2, 2, 0.9};
                                                 },
                                                 [](const Capsule&) {
                                                     return Spread{2, 0};
                                                 },
                                                 [](const Mesh&) {
                                                     return Spread{2, 2};
                                                 }},
                                     collider.shape);
    const Vec3 size = shape_geometry(collider.shape).size;
    std::vector<Vec3> points;
    for (int i = -spread.along; i <= spread.along; ++i)
        for (int j = -spread.across; j <= spread.across; ++j) {
            const double u = 0.4 * i, v = 0.4 * j;
            if (std::hypot(u, v) > spread.farthest) continue;
            if (spread.across == 0)
                points.push_back({0, u * size[0], 0});
            else if (size[0] < size[1])
                points.push_back({0, u * size[1], v * size[2]});
            else
                points.push_back({u * size[0], 0, v * size[2]});
        }
    return points;
}

using Corners = std::array<Vec3, 3>;

/// Returns whether a triangle that goes straight from one place to another passes over a point: 1 one way, -1 the
/// other.
inline int passes_over(const Vec3& point, const Corners& from, const Corners& to) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        bool below = true, above = true;
        for (const Corners* corners : {&from, &to})
            for (const Vec3& corner : *corners) {
                below = below && corner[axis] < point[axis];
                above = above && corner[axis] > point[axis];
            }
        if (below || above) return 0;
    }
    const auto at = [&](double share) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = minus(plus(times(1 - share, from[k]), times(share, to[k])), point);
        return corners;
    };
    const auto volume = [&](double share) {
        const Corners c = at(share);
        return dot(c[0], cross(c[1], c[2]));
    };
    constexpr int parts = 12;
    for (int part = 0; part < parts; ++part) {
        double low = part / double(parts), high = (part + 1) / double(parts);
        const bool below = volume(low) < 0;
        if (below == (volume(high) < 0)) continue;
        for (int round = 0; round < 40; ++round) {
            const double middle = (low + high) / 2;
            ((volume(middle) < 0) == below ? low : high) = middle;
        }
        const Corners c = at(low);
        const Vec3 normal = cross(minus(c[1], c[0]), minus(c[2], c[0]));
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) inside = inside && dot(cross(c[k], c[(k + 1) % 3]), normal) > 0;
        if (inside) return below ? 1 : -1;
    }
    return 0;
}

/// Returns for every point how often triangles that go straight from one frame to the next pass over it, less how often
/// they pass back: that of the whole sheet does not depend on how its inner particles went.
inline std::vector<int> passages(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& triangles,
                                 const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    std::vector<int> net(points.size());
    for (std::size_t k = 0; k < triangles.size() && !from.empty(); k += 3) {
        const auto corners = [&](const std::vector<Vec3>& all) {
            return Corners{all[triangles[k]], all[triangles[k + 1]], all[triangles[k + 2]]};
        };
        for (std::size_t point = 0; point < points.size(); ++point)
            net[point] += passes_over(points[point], corners(from), corners(to));
    }
    return net;
}

}  // namespace drape::test
