#include "scenes.h"

#include <cmath>

#include "support/gas_scenes.h"
#include "support/self_contact_scenes.h"
#include "support/sewn_scenes.h"
#include "twin_comparison.h"

namespace drape::test {

namespace {

SceneDescription with(SceneDescription scene, SolverMethod method, std::uint32_t substeps) {
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    return scene;
}

/// Wind, colliders of every kind that move, pins that move and let go, springs in two iterations, bending.
SceneDescription relaxed() {
    SceneDescription scene = with(everything(), SolverMethod::relax, 4);
    scene.solver.iterations = 2;
    scene.cloths[0].stiffness.bend = 1e-4;
    return scene;
}

SceneDescription relaxed_with_holes() {
    SceneDescription scene = relaxed();
    scene.wind = {};
    scene.cloths[0].stiffness.compression = 0.1;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 20}, {36, 29}}};
    add_second_cloth(scene);
    return scene;
}

SceneDescription relaxed_to_a_tolerance() {
    SceneDescription scene = with(everything(), SolverMethod::relax, 4);
    scene.solver.iterations = 3;
    scene.solver.tolerance = 0.02;
    return scene;
}

/// Nothing happens between the steps, so that kernels take several at once.
SceneDescription flying(bool holes) {
    SceneDescription scene = with(everything(), SolverMethod::explicit_steps, 12);
    scene.wind = {};
    scene.colliders = {};
    scene.cloths[0].pins = {pin_top(scene.cloths[0])};
    if (holes) scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}};
    return scene;
}

SceneDescription bent_explicitly() {
    SceneDescription scene = with(everything(), SolverMethod::explicit_steps, 12);
    scene.cloths[0].stiffness.bend = 1e-4;
    return scene;
}

/// A wave that it starts in is the shape in which it is at rest.
SceneDescription at_rest_in_a_wave(SceneDescription scene) {
    Cloth& cloth = scene.cloths[0];
    for (std::uint32_t row = 0; row < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cloth.grid[0]; ++column)
            cloth.start.push_back({0.9 * cloth.size[0] * column / (cloth.grid[0] - 1) - 0.5,
                                   0.02 * std::sin(0.7 * row + 0.2 * column) + 0.01 * std::sin(0.5 * column),
                                   0.9 * cloth.size[1] * row / (cloth.grid[1] - 1) - 0.4});
    cloth.placement = {};
    cloth.rest = Rest::start;
    return scene;
}

SceneDescription bent_lines_with_holes() {
    SceneDescription scene = with(free_lines(), SolverMethod::line, 4);
    scene.solver.iterations = 2;
    scene.cloths[0].stiffness.bend = 1e-3;
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{0, 20}, {6, 29}}, {{25, 15}, {26, 16}}};
    return scene;
}

SceneDescription lines_to_a_tolerance() {
    SceneDescription scene = with(free_lines(), SolverMethod::line, 4);
    scene.solver.iterations = 3;
    scene.solver.tolerance = 0.01;
    return scene;
}

SceneDescription soft_lines() {
    SceneDescription scene = with(everything_in_lines(), SolverMethod::line, 4);
    scene.cloths[0].stiffness = {false, 800, 60, 1e-5, 0.05};
    return scene;
}

SceneDescription around_lone_pins(bool holes) {
    SceneDescription scene = with(lone_pins(), SolverMethod::line, 2);
    if (holes) scene.cloths[0].holes = {{{3, 4}, {9, 10}}, {{52, 25}, {60, 33}}};
    return scene;
}

/// Coarse cells fall on a standing and a turning box, and are held by tethers.
SceneDescription over_boxes() {
    SceneDescription scene = with(sheet(19, 34, 0.9, 0.85, 4), SolverMethod::line, 4);
    scene.time.frame_count = frame_count + 1;
    const MotionPath path{{{0, {0, 0, 0}, {0, 0, 0}}, {0.3, {0.05, 0.1, 0}, {20, 90, 10}}}};
    scene.colliders = {{Box{{0.2, -0.15, 0}, {0.12, 0.1, 0.2}}, 0.3, {10, 20, 30}, path},
                       {Box{{-0.25, -0.15, 0.02}, {0.1, 0.12, 0.13}}, 0.5},
                       {Plane{{0, 1, 0}, -0.2}}};
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.45, 0.0, -0.6}, {1, 0, 0}, {0, 0, 1}};
    cloth.stiffness = {false, 800, 60, 0};
    cloth.thickness = 0.002;
    cloth.velocity = {0, -1.5, 0};
    cloth.pins = {pin_box(9, 11, 9, 11)};
    scene.solver.tethers = true;
    return scene;
}

/// Three of one kind and another in their midst.
SceneDescription several(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = with(everything(), method, substeps);
    Cloth cloth = scene.cloths[0];
    cloth.name = "other";
    cloth.grid = {24, 13};
    cloth.pins = {pin_top(cloth)};
    scene.cloths.push_back(cloth);
    for (const char* name : {"second", "third"}) {
        cloth = scene.cloths[0];
        cloth.name = name;
        cloth.placement.origin[1] += 0.1 * static_cast<double>(scene.cloths.size());
        cloth.pins.push_back(pin_box(7, 9, 9, 9));
        cloth.pins.back().path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0, 0.05, 0.1}, {}}};
        scene.cloths.push_back(cloth);
    }
    return scene;
}

/// A blade has gone through it before the compared frames.
SceneDescription slit(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = with(everything(), method, substeps);
    scene.cloths[0].stiffness.bend = 1e-4;
    Cutter cutter;
    cutter.triangle = {{{-0.3, 1, -0.2}, {0.4, 1, 0.1}, {0, -2, 0}}};
    cutter.begin = cutter.end = 0.5 / scene.time.fps;
    scene.cutters = {cutter};
    return scene;
}

/// Of these, sums of impulses do not round as devices divide.
SceneDescription telling_forces(SceneDescription scene) {
    scene.forces = scene.worst_forces = scene.force_fields = true;
    return scene;
}

SceneDescription crumpling(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = fold(17, 0.5, method, substeps);
    scene.cloths[0].velocity = {0, -4, 0};
    return scene;
}

/// Stiffness that keys change before the compared frames, whose steps are judged one by one.
SceneDescription weakened_lines() {
    SceneDescription scene = with(everything_in_lines(), SolverMethod::line, 4);
    scene.cloths[0].stiffness.bend = 1e-4;
    scene.cloths[0].stiffness_keys = {{0, 1}, {3 / scene.time.fps, 0.3}};
    return scene;
}

/// Gives particles of a scene's cloths frictions and thicknesses of their own.
SceneDescription with_maps(SceneDescription scene) {
    for (Cloth& cloth : scene.cloths)
        for (std::uint32_t particle = 0; particle < cloth.grid[0] * cloth.grid[1]; ++particle) {
            cloth.particle_friction.push_back(0.1f * static_cast<float>(particle % 13));
            cloth.particle_thickness.push_back(0.75f + 0.05f * static_cast<float>(particle % 6));
        }
    return scene;
}

/// A cushion that gas blows up.
SceneDescription blown_cushion(SolverMethod method) {
    SceneDescription scene = gas_cushion(method, 13, 4, 0.02);
    blow_up(scene, 0.005, 0.1);
    return scene;
}

/// Two that started through each other, and a third that touches one of them.
SceneDescription parting(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = crossed(method, substeps);
    scene.gravity = {0, -9.81, 0};
    Cloth below = scene.cloths[0];
    below.name = "below";
    below.grid = {6, 6};
    below.size = {0.2, 0.2};
    below.placement.origin = {-0.29, 0.493, -0.24};
    below.velocity = {0, 0.5, 0};
    scene.cloths.push_back(below);
    return scene;
}

}  // namespace

const std::vector<ConformanceScene>& conformance_scenes() {
    using enum SolverMethod;
    static const std::vector<ConformanceScene> scenes = {
        {"Relaxed", relaxed(), 5},
        {"RelaxedWithHoles", relaxed_with_holes(), 8},
        {"RelaxedToATolerance", relaxed_to_a_tolerance(), 5},
        {"Explicit", with(everything(), explicit_steps, 12), 5},
        {"ExplicitFlight", flying(false), 5},
        {"ExplicitFlightWithHoles", flying(true), 5},
        {"ExplicitBending", bent_explicitly(), 5},
        {"Line", with(everything_in_lines(), line, 4), 5},
        {"LineBendingWithHoles", bent_lines_with_holes(), 5},
        {"LineWeakened", weakened_lines(), 5},
        {"RelaxedRestsBent", at_rest_in_a_wave(relaxed()), 5},
        {"ExplicitRestsBent", at_rest_in_a_wave(bent_explicitly()), 5},
        {"LineRestsBent", at_rest_in_a_wave(bent_lines_with_holes()), 5},
        {"LineToATolerance", lines_to_a_tolerance(), 5},
        {"LineSoftInCompression", soft_lines(), 5},
        {"LonePins", around_lone_pins(false), 5},
        {"LonePinsWithHoles", around_lone_pins(true), 5},
        {"ColliderEdgesAndTethers", over_boxes(), 8},
        {"ColliderEdgesWithMaps", with_maps(over_boxes()), 8},
        {"SeveralRelaxed", several(relax, 4), 5},
        {"SeveralLine", several(line, 4), 5},
        {"SeveralExplicit", several(explicit_steps, 12), 5},
        {"SlitRelaxed", slit(relax, 4), 5},
        {"SlitLine", slit(line, 4), 5},
        {"SlitRestsBent", at_rest_in_a_wave(slit(line, 4)), 5},
        {"ContactExplicit", crumpling(explicit_steps, 40), 16},
        {"ContactLine", crumpling(line, 10), 16},
        {"ContactOfLayers", layers(line, 6), 12},
        {"ContactOfLayersWithMaps", with_maps(layers(line, 6)), 12},
        {"ContactParting", parting(line, 5), 0},
        {"SewnLine", with(three_panels(line), line, 4), 5},
        {"SewnExplicit", with(three_panels(explicit_steps), explicit_steps, 12), 5},
        {"SewnBetween", with(unlike_panels(line), line, 4), 5},
        {"SewnClosing", with(unlike_panels(line, 0.06), line, 4), 5},
        {"SewnRips", with(opening_seam(line, 1), line, 4), 5},
        {"SewnContact", with(folding_panels(line, true), line, 6), 12},
        {"GasLine", with(blown_cushion(line), line, 4), 5},
        {"GasExplicit", with(blown_cushion(explicit_steps), explicit_steps, 12), 5},
        {"ForcesInFlight", telling_forces(flying(false)), 5},
        {"ForcesOfParting", telling_forces(parting(line, 5)), 0},
    };
    return scenes;
}

}  // namespace drape::test
