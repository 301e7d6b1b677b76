// In these small scenes cloths meet themselves and each other.
#pragma once

#include <string>

#include "support/sheets.h"
#include "twin/twin.h"
#include "world/triangle_crossings.h"

namespace drape::test {

/// A sheet of n x n particles over 1 m, a little out of the vertical, falls on its lower edge, so that it folds to and
/// fro on the ground. `thickness`: in edges.
inline SceneDescription fold(std::uint32_t n, double thickness, SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = sheet(n, n, 1, 1, substeps);
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.5, 1.05, 0}, {1, 0, 0.02}, {0, -1, 0.05}};
    const double u = std::hypot(1, 0.02), v = std::hypot(1, 0.05);
    cloth.placement.u = {1 / u, 0, 0.02 / u};
    cloth.placement.v = {0, -1 / v, 0.05 / v};
    cloth.stiffness = {false, 200, 40, 1e-4};
    cloth.damping = 1;
    cloth.friction = 0.4;
    cloth.self_collision = SelfCollision{thickness / (n - 1), {}};
    Collider ground{Plane{}};
    ground.friction = 0.6;
    scene.colliders = {ground};
    return scene;
}

/// A sheet hangs between two bars, which turn against each other by `turns` in `seconds` and come nearer meanwhile.
inline SceneDescription twist(std::uint32_t n, double thickness, SolverMethod method, std::uint32_t substeps,
                              double turns, double seconds) {
    SceneDescription scene = sheet(n, n, 1, 1, substeps);
    scene.solver.method = method;
    scene.gravity = {0, 0, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.5, 1.5, 0}, {1, 0, 0}, {0, -1, 0}};
    cloth.stiffness = {false, 200, 40, 1e-4};
    cloth.damping = 2;
    cloth.self_collision = SelfCollision{thickness / (n - 1), 0.3};
    for (const double side : {-1.0, 1.0}) {
        const std::uint32_t column = side < 0 ? 0 : n - 1;
        Pin pin = pin_box(column, 0, column, n - 1);
        pin.path.keys = {{0, {0, 0, 0}, {0, 0, 0}}, {seconds, {-side * 0.25, 0, 0}, {side * 180 * turns, 0, 0}}};
        cloth.pins.push_back(pin);
    }
    return scene;
}

/// Three sheets lie above each other over a ball, of different grids, weights and thicknesses: the lowest, which falls
/// on the ball, meets itself; the next one, turned, is small and has a hole; the last one is coarse and comes fast.
inline SceneDescription layers(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = sheet(15, 13, 0.84, 0.72, substeps);
    scene.solver.method = method;
    const auto lie = [](Cloth& cloth, Vec3 origin, double degrees) {
        const double c = std::cos(degrees * 0.017453292519943295), s = std::sin(degrees * 0.017453292519943295);
        cloth.placement = {origin, {c, 0, s}, {-s, 0, c}};
        cloth.stiffness = {false, 200, 40, 1e-4};
        cloth.damping = 1;
        cloth.friction = 0.4;
    };
    Cloth small = scene.cloths[0], coarse = scene.cloths[0];
    lie(scene.cloths[0], {-0.42, 0.36, -0.36}, 0);
    scene.cloths[0].self_collision = SelfCollision{0.02, {}};
    small.name = "small";
    small.grid = {12, 10};
    small.size = {0.44, 0.36};
    small.areal_density *= 0.5;
    small.holes = {{{4, 3}, {7, 6}}};
    small.thickness = 0.01;
    lie(small, {-0.15, 0.41, -0.25}, 25);
    coarse.name = "coarse";
    coarse.grid = {7, 9};
    coarse.size = {0.5, 0.64};
    coarse.areal_density *= 3;
    coarse.thickness = 0.03;
    lie(coarse, {-0.2, 0.5, -0.3}, -10);
    coarse.velocity = {0.5, -3, 0};
    scene.cloths.push_back(small);
    scene.cloths.push_back(coarse);
    Collider ball{Sphere{{0, 0, 0}, 0.3}};
    ball.friction = 0.4;
    scene.colliders = {ball};
    return scene;
}

/// A sheet lies, and a smaller, lighter one stands through it, its upper third above; both are free, without gravity.
inline SceneDescription crossed(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = sheet(13, 11, 0.6, 0.5, substeps);
    scene.solver.method = method;
    scene.gravity = {0, 0, 0};
    Cloth& lying = scene.cloths[0];
    lying.self_collision = SelfCollision{0.01, {}};
    lying.stiffness = {false, 200, 40, 1e-4};
    lying.damping = 0;
    Cloth standing = lying;
    standing.name = "standing";
    standing.grid = {9, 8};
    standing.size = {0.37, 0.3};
    standing.areal_density *= 0.5;
    lying.placement = {{-0.3, 0.5, -0.25}, {1, 0, 0}, {0, 0, 1}};
    standing.placement = {{-0.2, 0.6, 0.013}, {1, 0, 0}, {0, -1, 0}};
    scene.cloths.push_back(standing);
    return scene;
}

/// Sheets of n x n particles, each turned against the one below, fall onto a ball and each other.
inline SceneDescription stack(std::uint32_t count, std::uint32_t n, SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = sheet(n, n, 0.7, 0.7, substeps);
    scene.solver.method = method;
    const Cloth first = scene.cloths[0];
    scene.cloths.clear();
    for (std::uint32_t k = 0; k < count; ++k) {
        const double angle = 0.4 * k, c = std::cos(angle), s = std::sin(angle);
        Cloth& cloth = scene.cloths.emplace_back(first);
        cloth.name = "sheet" + std::to_string(k);
        cloth.placement = {{-0.35 * (c - s), 0.36 + 0.05 * k, -0.35 * (c + s)}, {c, 0, s}, {-s, 0, c}};
        cloth.stiffness = {false, 200, 40, 1e-4};
        cloth.damping = 1;
        cloth.friction = 0.4;
        cloth.self_collision = SelfCollision{0.3 * 0.7 / (n - 1), {}};
    }
    Collider ball{Sphere{{0, 0, 0}, 0.3}}, ground{Plane{}};
    ball.friction = ground.friction = 0.4;
    ground.shape = Plane{{0, 1, 0}, -0.3};
    scene.colliders = {ball, ground};
    return scene;
}

/// Counts the pairs of triangles that cross, of cloths that meet.
inline std::size_t crossings(const SimulationModel& model, const Twin& twin) {
    std::vector<TriangleCrossings::Mesh> meshes;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        meshes.push_back({{}, model.cloths[cloth].grid.triangle_indices()});
        for (const glsl::vec4& x : twin.cloth(cloth)[Field::position])
            meshes.back().points.push_back({double(x.x), double(x.y), double(x.z)});
    }
    const auto counts = [&](std::size_t one, std::size_t other) {
        return one != other || model.cloths.size() == 1 || model.scene.cloths[one].self_collision;
    };
    return TriangleCrossings(meshes).count(counts);
}

}  // namespace drape::test
