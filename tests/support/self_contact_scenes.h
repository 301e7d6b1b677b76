// Small scenes in which a cloth meets itself.
#pragma once

#include "support/sheets.h"

namespace drape::test {

/// A sheet of n x n particles over 1 m, a little out of the vertical, let fall on its lower edge, so that it folds to
/// and fro on the ground. `thickness`: in edges.
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

/// A sheet between two bars, which turn against each other by `turns` in `seconds` and come nearer meanwhile.
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

}  // namespace drape::test
