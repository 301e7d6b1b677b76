// Tests and benchmarks measure on these model sheets, built in code: one cloth, no camera.
#pragma once

#include <cmath>
#include <numbers>

#include "drape/scene.h"

namespace drape::model_scenes {

/// A vertical sheet in the xy plane: columns along +x, rows along -y, corner (0, 0) at the origin.
inline SceneDescription sheet(std::uint32_t columns, std::uint32_t rows, double width, double height,
                              std::uint32_t substeps, std::uint32_t iterations = 1) {
    SceneDescription scene;
    scene.name = "sheet";
    scene.time.frame_count = 2;
    Cloth cloth;
    cloth.name = "sheet";
    cloth.grid = {columns, rows};
    cloth.size = {width, height};
    scene.cloths.push_back(cloth);
    scene.solver.method = SolverMethod::relax;
    scene.solver.substeps = substeps;
    scene.solver.iterations = iterations;
    return scene;
}

inline Pin pin_box(std::uint32_t c0, std::uint32_t r0, std::uint32_t c1, std::uint32_t r1) {
    Pin pin;
    pin.particles = {{c0, r0}, {c1, r1}};
    return pin;
}

inline Pin pin_top(const Cloth& cloth) { return pin_box(0, 0, cloth.grid[0] - 1, 0); }

/// Sets the stretch stiffness of a wave speed (m/s), and a shear stiffness that is `shear_share` of it.
inline void set_wave_speed(Cloth& cloth, double wave_speed, double shear_share = 0.1) {
    cloth.areal_density = 0.2;
    cloth.stiffness.stretch = cloth.areal_density * wave_speed * wave_speed;
    cloth.stiffness.shear = shear_share * cloth.stiffness.stretch.warp;
}

/// A sheet of links x links over 1 m, pinned along its top row and turned by `degrees` about it (90: horizontal), with
/// springs of the given wave speed (m/s).
inline SceneDescription swing(std::uint32_t links, double wave_speed, double degrees) {
    SceneDescription scene = sheet(links + 1, links + 1, 1.0, 1.0, 1);
    Cloth& cloth = scene.cloths[0];
    const double angle = degrees * std::numbers::pi / 180;
    cloth.placement.v = {0, -std::cos(angle), std::sin(angle)};
    set_wave_speed(cloth, wave_speed);
    cloth.pins = {pin_top(cloth)};
    return scene;
}

inline constexpr double gravity = 9.81;           ///< m/s^2
inline constexpr double cantilever_length = 0.1;  ///< m

/// Slowest angular frequency (rad/s) of the cantilever below, about its first mode as beam and pendulum together.
inline double cantilever_frequency(double gamma) {
    return std::sqrt((12.36 / gamma + 1.4) * gravity / cantilever_length);
}

/// A strip clamped level at one end, of the rigidity that makes gamma = w L^3/B: `segments` cells from the clamp to the
/// free end, 1000 frames/s, substeps as the method needs them (line: 60 frames/s, 8 substeps). Two held columns clamp
/// the middle of their cell, so the free length is half a cell more than the free columns.
inline SceneDescription cantilever(std::uint32_t segments, double gamma, SolverMethod method) {
    constexpr double density = 0.2, stretch = 500, length = cantilever_length;
    const double cell = length / (segments + 0.5), mass = density * cell * cell;
    const double rigidity = density * gravity * length * length * length / gamma;
    const double bend = rigidity / (cell * cell);
    // Relaxation takes steps of m/(b h^2) = 60, explicit steps are a little shorter than their limit.
    const double steps_per_second = method == SolverMethod::relax
                                        ? std::sqrt(60 * bend / mass)
                                        : std::sqrt(std::max(48 * bend, 4 * 1.54 * stretch) / mass);
    const auto substeps = static_cast<std::uint32_t>(std::ceil(steps_per_second / 1000));
    SceneDescription scene = sheet(segments + 2, 2, cell * (segments + 1), cell, substeps);
    scene.time.fps = 1000;
    if (method == SolverMethod::line) {
        scene.time.fps = 60;
        scene.solver.substeps = 8;
    }
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = density;
    cloth.placement = {{-0.5 * cell, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.stiffness = {false, stretch, 0.1 * stretch, rigidity};
    cloth.pins = {pin_box(0, 0, 1, 1)};
    return scene;
}

/// The cantilever until it hangs still, damped a little less than critically, so that nothing creeps.
inline SceneDescription hanging_cantilever(std::uint32_t segments, double gamma, SolverMethod method) {
    SceneDescription scene = cantilever(segments, gamma, method);
    const double slowest = cantilever_frequency(gamma);
    scene.cloths[0].damping = 1.4 * slowest;
    scene.time.frame_count = static_cast<std::uint32_t>(scene.time.fps * 20 / slowest) + 1;
    return scene;
}

}  // namespace drape::model_scenes
