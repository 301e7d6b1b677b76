// Cloth that is drawn over the edge of a box holds by the capstan's law, whatever its particles' spacing.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double strip_thickness = 0.005, strip_friction = 0.3, on_top = 0.3;  // m, 1, m
constexpr double quarter = M_PI / 2, round_edge = quarter * strip_thickness;

/// Returns the longest end that hangs from an edge without drawing the strip over it, m. On a round edge of radius r
/// tension rises by mu (T + r w cos a) - r w sin a per radian, for a weight w per length.
double capstan_length(double on_face) {
    constexpr int steps = 1000;
    double tension = strip_friction * on_face;
    for (int step = 0; step < steps; ++step) {
        const double at = (step + 0.5) * quarter / steps;
        tension += quarter / steps *
                   (strip_friction * (tension + strip_thickness * std::cos(at)) - strip_thickness * std::sin(at));
    }
    return tension;
}

/// Returns where the strip is that goes over the edge at the origin, from x < 0 down along x = 0, `along` m after the
/// edge begins.
Vec3 over_edge(double along, double z) {
    if (along < 0) return {along, strip_thickness, z};
    if (along > round_edge) return {strip_thickness, round_edge - along, z};
    const double angle = along / strip_thickness;
    return {strip_thickness * std::sin(angle), strip_thickness * std::cos(angle), z};
}

/// A strip whose hanging end is so many times as long as the law's.
SceneDescription strip_over_edge(double thicknesses, double ratio, SolverMethod method, std::uint32_t substeps) {
    const double spacing = thicknesses * strip_thickness;
    const double wanted = on_top + round_edge + ratio * capstan_length(on_top);
    const auto cells = static_cast<std::uint32_t>(std::ceil(wanted / spacing));
    const double length = cells * spacing;
    double on_face = on_top;  // makes the ratio exact for whole cells
    for (int round = 0; round < 60; ++round) on_face = length - round_edge - ratio * capstan_length(on_face);
    SceneDescription scene = test::sheet(cells + 1, 2, length, spacing, substeps);
    scene.time.frame_count = 61;
    scene.solver.method = method;
    scene.colliders = {{Box{{-1, -1, 0}, {1, 1, 1}}, strip_friction}};
    Cloth& cloth = scene.cloths[0];
    cloth.friction = strip_friction;
    cloth.thickness = strip_thickness;
    cloth.stiffness = {false, 2000, 80, 1e-7};
    cloth.damping = 3;  // the weight that is there at once makes the strip swing
    for (std::uint32_t row = 0; row < 2; ++row)
        for (std::uint32_t column = 0; column <= cells; ++column)
            cloth.start.push_back(over_edge(column * spacing - on_face, row * spacing));
    return scene;
}

/// Returns how far the lower end still goes down in the last quarter of a second, m.
double slides(const SceneDescription& scene) {
    const SimulationModel model(scene);
    Twin twin(model);
    const std::size_t end = scene.cloths[0].grid[0] - 1;
    double height = 0;
    for (std::uint32_t frame = 1; frame <= 60; ++frame) {
        twin.run_frame(frame);
        if (frame == 45) height = test::position_of(twin.cloth(0), end)[1];
    }
    return height - test::position_of(twin.cloth(0), end)[1];
}

TEST(EdgeCapstanTest, HoldsByTheLawForSpacingsOfOneToFiveThicknesses) {
    struct Case {
        SolverMethod method;
        std::uint32_t substeps;
    };
    for (const Case& each : {Case{SolverMethod::line, 16}, {SolverMethod::line, 64}, {SolverMethod::relax, 32}})
        for (const double thicknesses : {1.0, 2.0, 3.0, 4.0, 5.0}) {
            if (each.method == SolverMethod::relax && thicknesses < 2) continue;  // so many cells stay slack
            const auto moved = [&](double ratio) {
                return slides(strip_over_edge(thicknesses, ratio, each.method, each.substeps));
            };
            EXPECT_LT(moved(0.85), 0.002) << int(each.method) << ", " << each.substeps << ", " << thicknesses;
            EXPECT_GT(moved(1.15), 0.01) << int(each.method) << ", " << each.substeps << ", " << thicknesses;
        }
}

}  // namespace
}  // namespace drape
