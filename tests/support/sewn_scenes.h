// Scenes of sewn cloths.
#pragma once

#include <cmath>
#include <numbers>

#include "support/sheets.h"

namespace drape::test {

inline constexpr std::uint32_t sewn_substeps = 12;

/// Two panels of unlike rows and densities, the second hanging from the first by its seam, in wind.
inline SceneDescription two_panels(SolverMethod method) {
    SceneDescription scene = sheet(17, 12, 0.8, 0.55, sewn_substeps, 1);
    scene.solver.method = method;
    scene.wind.velocity = {1, 0.3, -2};
    Cloth& upper = scene.cloths[0];
    upper.name = "upper";
    upper.placement = {{-0.4, 0.5, -0.3}, {1, 0, 0}, {0, 0, 1}};
    upper.stiffness = {false, 800, 60, 1e-5};
    upper.velocity = {0.1, 0, 0.4};
    upper.pins = {pin_box(0, 0, 16, 0)};
    Cloth lower = upper;
    lower.name = "lower";
    lower.grid = {17, 9};
    lower.size = {0.8, 0.4};
    lower.areal_density = 0.3;
    lower.velocity = {};
    lower.pins = {};
    lower.placement.origin = {-0.4, 0.5, 0.25};
    scene.cloths.push_back(lower);
    scene.seams = {{{"upper", SeamEdge::bottom}, {"lower", SeamEdge::top}}};
    return scene;
}

/// Three panels of which two hang from one seam, all with colliders in their way, and a pin on a follower that moves
/// and one that lets go.
inline SceneDescription three_panels(SolverMethod method) {
    SceneDescription scene = two_panels(method);
    Cloth third = scene.cloths[1];
    third.name = "third";
    third.placement.v = {0, -1, 0};
    scene.cloths.push_back(third);
    scene.seams.push_back({{"third", SeamEdge::top}, {"upper", SeamEdge::bottom}});
    Pin moving = pin_box(0, 0, 2, 0), released = pin_box(16, 0, 16, 0);
    moving.path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0.1, 0.05, 0}, {0, 30, 10}}};
    released.release = 0.11;
    scene.cloths[1].pins = {moving, released};
    scene.colliders = {{Sphere{{0, 0.1, 0.3}, 0.3}, 0.3}, {Box{{0.3, 0.2, 0}, {0.1, 0.15, 0.2}}, 0.3}};
    return scene;
}

/// The three panels of unlike columns, so that the particles of two lie between those of the first, or all between the
/// third's; with `close` above 0 the lower ones start apart from it.
inline SceneDescription unlike_panels(SolverMethod method, double close = 0) {
    SceneDescription scene = three_panels(method);
    scene.cloths[1].grid[0] = 21;
    scene.cloths[1].pins.pop_back();  // pins hold no particle between two
    scene.cloths[1].pins[0].particles.last = {0, 0};
    scene.cloths[2].grid[0] = close > 0 ? 14 : 24;
    for (Seam& seam : scene.seams) seam.close = close;
    if (close > 0) {
        scene.seams.back().b = {"lower", SeamEdge::top};
        scene.seams.front().b = {"third", SeamEdge::top};
        scene.cloths[1].placement.origin[1] += 0.07;
        scene.cloths[2].placement.origin[2] += 0.09;
        scene.cloths[1].pins = {pin_box(0, 0, 0, 0)};
    }
    return scene;
}

/// A tube that is one cloth, hung by its upper rim.
inline SceneDescription tube(SolverMethod method) {
    constexpr std::uint32_t around = 24, down = 12;
    SceneDescription scene = sheet(around + 1, down + 1, 0.75, 0.4, sewn_substeps, 1);
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 800, 60, 0};
    cloth.pins = {pin_box(0, 0, around, 0)};
    cloth.velocity = {3, -1, 1};
    const double radius = 0.75 / around / (2 * std::sin(std::numbers::pi / around));
    for (std::uint32_t row = 0; row <= down; ++row)
        for (std::uint32_t column = 0; column <= around; ++column) {
            const double angle = 2 * std::numbers::pi * (column % around) / around;
            cloth.start.push_back({radius * std::cos(angle), -0.4 * row / down, radius * std::sin(angle)});
        }
    cloth.placement = {};
    scene.seams = {{{cloth.name, SeamEdge::left}, {cloth.name, SeamEdge::right}}};
    return scene;
}

/// A free strip of two panels of unlike density, .2 m wide, sewn across its middle. The lower end of the second is
/// pulled by a force that grows by so many newtons a second.
inline SceneDescription pulled_strip(SolverMethod method, double growth, double rip) {
    SceneDescription scene = sheet(9, 13, 0.2, 0.3, sewn_substeps, 1);
    scene.solver.method = method;
    scene.gravity = {};
    Cloth& upper = scene.cloths[0];
    upper.name = "upper";
    upper.placement = {{0, 0, 0}, {1, 0, 0}, {0, -1, 0}};
    upper.areal_density = 0.5;
    upper.stiffness = {false, 2000, 0, 0};
    Cloth lower = upper;
    lower.name = "lower";
    lower.areal_density = 0.2;
    lower.grid = {9, 9};
    lower.size = {0.2, 0.2};
    lower.placement.origin = {0, -0.3, 0};
    lower.loads = {{.particles = {{0, 8}, {8, 8}}, .force_keys = {{0, {0, 0, 0}}, {10, {0, -10 * growth, 0}}}}};
    scene.cloths.push_back(lower);
    scene.seams = {{{"upper", SeamEdge::bottom}, {"lower", SeamEdge::top}}};
    scene.seams[0].rip = rip;
    return scene;
}

/// Two panels of a strip 1 m wide, sewn across its middle; the upper edge is held, and the lower one's left end is
/// pulled out, so that the seam opens from there on.
inline SceneDescription opening_seam(SolverMethod method, double rip) {
    SceneDescription scene = sheet(33, 9, 1, 0.25, sewn_substeps, 1);
    scene.solver.method = method;
    Cloth& upper = scene.cloths[0];
    upper.name = "upper";
    upper.placement = {{-0.5, 1, 0}, {1, 0, 0}, {0, -1, 0}};
    upper.stiffness = {false, 800, 60, 1e-5};
    upper.damping = 1;
    Cloth lower = upper;
    lower.name = "lower";
    lower.placement.origin = {-0.5, 0.75, 0};
    upper.pins = {pin_box(0, 0, 32, 0)};
    lower.loads = {{.particles = {{0, 4}, {1, 8}}, .force_keys = {{0, {0, 0, 0}}, {1, {0, -4, 2}}}}};
    scene.cloths.push_back(lower);
    scene.seams = {{{"upper", SeamEdge::bottom}, {"lower", SeamEdge::top}}};
    scene.seams[0].rip = rip;
    return scene;
}

/// A ground on which sewn cloths that meet themselves and each other fall. `thickness`: in edges of the first one.
inline void fall_on_ground(SceneDescription& scene, double thickness) {
    const double edge = scene.cloths[0].size[0] / (scene.cloths[0].grid[0] - 1);
    for (Cloth& cloth : scene.cloths) {
        cloth.self_collision = SelfCollision{thickness * edge, {}};
        cloth.damping = 1;
        cloth.friction = 0.4;
    }
    Collider ground{Plane{}};
    ground.friction = 0.6;
    scene.colliders = {ground};
}

/// A tube that is one cloth stands on the ground, thrown aslant, and falls over and together. Its seam has matched
/// sides.
inline SceneDescription falling_tube(SolverMethod method, std::uint32_t substeps = sewn_substeps) {
    SceneDescription scene = tube(method);
    scene.solver.substeps = substeps;
    Cloth& cloth = scene.cloths[0];
    cloth.pins.clear();
    for (Vec3& at : cloth.start) at[1] += 0.405;
    cloth.velocity = {1.5, -1, 0.4};
    cloth.stiffness = {false, 200, 40, 1e-5};
    fall_on_ground(scene, 0.3);
    return scene;
}

/// Two squares of n x n particles, sewn along all borders, bulge, come together and fall on the ground, where the
/// pressure in them grows.
inline SceneDescription dropped_cushion(SolverMethod method, std::uint32_t n, std::uint32_t substeps = sewn_substeps) {
    SceneDescription scene = sheet(n, n, 0.5, 0.5, substeps, 1);
    scene.solver.method = method;
    Cloth& top = scene.cloths[0];
    top.name = "top";
    top.areal_density = 0.3;
    top.stiffness = {false, 400, 60, 1e-5};
    Cloth bottom = top;
    bottom.name = "bottom";
    bottom.areal_density = 0.2;
    scene.cloths.push_back(bottom);
    for (const double side : {1.0, -1.0}) {
        Cloth& cloth = scene.cloths[side > 0 ? 0 : 1];
        for (std::uint32_t row = 0; row < n; ++row)
            for (std::uint32_t column = 0; column < n; ++column) {
                const double u = column / (n - 1.0), v = row / (n - 1.0);
                const bool border = row == 0 || column == 0 || row == n - 1 || column == n - 1;
                const double high = border ? 0 : 0.04 * std::sin(std::numbers::pi * u) * std::sin(std::numbers::pi * v);
                cloth.start.push_back({0.5 * u - 0.25, 0.2 + 0.15 * v + side * high, 0.48 * v - 0.25});
            }
        cloth.placement = {};
        cloth.velocity = {0.3, -2.0 - side, 0};
        Load& blown = cloth.loads.emplace_back();
        blown.particles = {{0, 0}, {n - 1, n - 1}};
        blown.pressure_keys = {{0, 0}, {0.5, 0}, {0.8, -30 * side}};
    }
    for (const SeamEdge edge : {SeamEdge::left, SeamEdge::right, SeamEdge::top, SeamEdge::bottom})
        scene.seams.push_back({{"top", edge}, {"bottom", edge}});
    fall_on_ground(scene, 0.25);
    return scene;
}

/// Three panels that hang from one another, of which two are drawn together before they meet, fold on the ground.
/// Sides are unlike where `unlike`.
inline SceneDescription folding_panels(SolverMethod method, bool unlike, std::uint32_t substeps = sewn_substeps) {
    SceneDescription scene = unlike ? unlike_panels(method, 0.06) : two_panels(method);
    scene.solver.substeps = substeps;
    scene.wind = {};
    for (Cloth& cloth : scene.cloths) {
        cloth.pins.clear();
        cloth.velocity = {0.2, -1.5, 0};
        cloth.stiffness = {false, 200, 40, 1e-5};
        cloth.placement.origin[1] -= 0.35;
    }
    if (!unlike) scene.cloths[1].placement.v = {0, std::sqrt(0.75), -0.5};
    fall_on_ground(scene, 0.25);
    return scene;
}

}  // namespace drape::test
