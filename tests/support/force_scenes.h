// Scenes whose forces are known, and drawn ones, whose forces must add up.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "base/vectors.h"
#include "drape/statistics.h"
#include "support/loads.h"
#include "support/sheets.h"

namespace drape::test {

inline constexpr SolverMethod all_methods[] = {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps};

inline SceneDescription by_method(SceneDescription scene, SolverMethod method, std::uint32_t substeps) {
    scene.solver.method = method;
    scene.solver.substeps = method == SolverMethod::explicit_steps ? 10 * substeps : substeps;
    return scene;
}

/// A level sheet of 9 x 9 particles and 0.4 m a side about the origin, at a height.
inline SceneDescription level_sheet(double height, double damping) {
    SceneDescription scene = sheet(9, 9, 0.4, 0.4, 8);
    Cloth& cloth = scene.cloths[0];
    cloth.pins.clear();
    cloth.stiffness = {false, 1000, 100, 0};
    cloth.placement = {{-0.2, height, -0.2}, {1, 0, 0}, {0, 0, 1}};
    cloth.damping = damping;
    cloth.friction = 0.3;
    cloth.thickness = 0.004;
    return scene;
}

/// The force at the ends of a chain of elastic links between two points at one height: its horizontal part, N, found by
/// bisection. Its masses are at the links' ends.
inline double end_pull(std::size_t links, double length, double span, double link_weight, double stiffness) {
    const auto width = [&](double pull) {
        double sum = 0;
        for (std::size_t k = 0; k < links; ++k) {
            const double up = link_weight * (static_cast<double>(k) - 0.5 * static_cast<double>(links - 1));
            const double tension = std::hypot(pull, up);
            sum += (length / static_cast<double>(links) + tension / stiffness) * pull / tension;
        }
        return sum;
    };
    double least = 0, most = 100 * link_weight * static_cast<double>(links);
    for (int k = 0; k < 200; ++k) (width(0.5 * (least + most)) < span ? least : most) = 0.5 * (least + most);
    return least;
}

inline constexpr std::uint32_t catenary_links = 32;
inline constexpr double catenary_span = 0.8, catenary_width = 1.0 / catenary_links, catenary_stiffness = 400;

/// A strip of 1 m between two pins. It is soft and heavy, so that rounded positions tell its strain, some hundredths,
/// to 1e-4 of it.
inline SceneDescription catenary() {
    SceneDescription scene = sheet(catenary_links + 1, 2, 1, catenary_width, 8);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, catenary_stiffness, 0, 0};
    cloth.areal_density = 1;
    cloth.damping = 8;
    for (std::uint32_t row = 0; row < 2; ++row)
        for (std::uint32_t k = 0; k <= catenary_links; ++k) {
            const double x = catenary_span * (double(k) / catenary_links - 0.5);
            cloth.start.push_back({x, 1.7 * (x * x - 0.25 * catenary_span * catenary_span), row * catenary_width});
        }
    cloth.pins = {pin_box(0, 0, 0, 1), pin_box(catenary_links, 0, catenary_links, 1)};
    return scene;
}

/// Returns the force of the catenary's left pin, N. Both rows are borders: a link of either has half of the stiffness
/// dy/dx.
inline Vec3 catenary_pull(double weight, double stiffness = catenary_stiffness * catenary_width * catenary_links) {
    return {-end_pull(catenary_links, 1, catenary_span, weight / catenary_links, stiffness), 0.5 * weight, 0};
}

/// Cloths with pins that move and let go, among colliders, in the wind, one above the other, as drawn.
inline SceneDescription drawn_with_forces(std::mt19937& random) {
    const auto between = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    const auto whether = [&] { return between(0, 1) < 0.5; };
    SceneDescription scene = level_sheet(between(0.1, 0.4), whether() ? between(0, 2) : 0);
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = between(0.1, 0.4);
    cloth.velocity = {between(-1, 1), between(-1, 1), between(-1, 1)};
    cloth.stiffness.bend = whether() ? 1e-5 : 0;
    if (whether()) cloth.pins = {pin_box(0, 0, 3, 0), pin_box(8, 8, 8, 8)};
    if (!cloth.pins.empty() && whether())
        cloth.pins[0].path.keys = {{0, {0, 0, 0}, {}}, {0.3, {between(-0.2, 0.2), 0.1, 0}, {0, 20, 0}}};
    if (!cloth.pins.empty() && whether()) cloth.pins[1].release = between(0.05, 0.3);
    if (whether()) scene.wind.velocity = {between(-5, 5), between(-5, 5), between(-5, 5)};
    if (whether()) {
        cloth.loads = {pull({{2, 2}, {8, 8}}, Vec3{between(-1, 1), between(-1, 1), between(-1, 1)}),
                       press({{0, 0}, {8, 8}}, between(-5, 5)),
                       pull({{8, 8}, {8, 8}}, std::vector<VectorKey>{{0, {0, 0, 0}}, {0.2, {0, -1, 0.5}}})};
    }
    if (whether()) scene.colliders.push_back({Plane{}, 0.4});
    if (whether()) scene.colliders.push_back({Box{{0.1, 0, 0}, {0.1, 0.1, 0.1}}, 0.4, {10, 30, 0}});
    if (whether()) scene.colliders.push_back({Sphere{{-0.1, 0, 0.1}, 0.1}, 0.4});
    if (whether()) {
        scene.cloths.push_back(cloth);
        scene.cloths[1].name = "upper";
        scene.cloths[1].placement.origin[1] += 0.05;
        scene.cloths[1].velocity[1] -= 2;
        scene.cloths[1].self_collision = SelfCollision{0.01, 0.4};
    }
    const auto kind = std::uniform_int_distribution<std::size_t>(0, 2)(random);
    return by_method(scene, all_methods[kind], 8);
}

/// Returns what the forces of a frame lack of its change of momentum, in units of the largest of them.
inline double missing_force(const ClothStatistics& now, const Vec3& momentum_before, double frame_time) {
    Vec3 sum{};
    double largest = 0;
    for (const ForceOnCloth& each : now.forces) {
        sum = plus(sum, each.force);
        largest = std::max(largest, length(each.force));
    }
    return length(minus(sum, times(1 / frame_time, minus(now.momentum, momentum_before)))) / largest;
}

inline void expect_near(const Vec3& force, const Vec3& expected, double bound, const char* what) {
    const double off = length(minus(force, expected)) / length(expected);
    std::printf("[ measured ] %s: off by %.1e\n", what, off);
    EXPECT_LT(off, bound) << what;
}

}  // namespace drape::test
