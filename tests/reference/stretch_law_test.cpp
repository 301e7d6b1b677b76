// The hanging sheet stretches under K iterations per substep by eps = N^2 g dt^2 / (2 K L) (docs/physics.md 2).
#include <gtest/gtest.h>

#include <cmath>

#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

struct Stretch {
    double mean, rms;
};

/// Strain of all column springs once the sheet hangs still.
Stretch hanging_stretch(std::uint32_t links, std::uint32_t substeps, std::uint32_t iterations, bool with_shear) {
    SceneDescription scene = test::sheet(links + 1, links + 1, 1.0, 1.0, substeps, iterations);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 1e12, with_shear ? 1e12 : 0.0, 0};  // rigid to rounding, shear optional
    cloth.pins = {test::pin_top(cloth)};
    cloth.damping = 6;  // settles in time; lowers the effective g by 0.25 % at 20 substeps
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 180; ++frame) twin.run_frame(frame);
    double sum = 0, squares = 0;
    const Grid& grid = model.cloths[0].grid;
    for (std::uint32_t row = 0; row < links; ++row)
        for (std::uint32_t column = 0; column <= links; ++column) {
            const glsl::vec4 a = twin.cloth(0)[Field::position][grid.particle(column, row)];
            const glsl::vec4 b = twin.cloth(0)[Field::position][grid.particle(column, row + 1)];
            const double strain =
                std::hypot(double(b.x) - double(a.x), double(b.y) - double(a.y), double(b.z) - double(a.z)) * links - 1;
            sum += strain;
            squares += strain * strain;
        }
    const double count = links * (links + 1.0);
    return {sum / count, std::sqrt(squares / count)};
}

double law(std::uint32_t links, std::uint32_t substeps, std::uint32_t iterations) {
    const double dt = 1.0 / (60.0 * substeps);
    return links * links * 9.81 * dt * dt / (2.0 * iterations);
}

void expect_near_law(const char* what, double measured, double expected) {
    std::printf("[ measured ] %s: %.4e, law %.4e, ratio %.3f\n", what, measured, expected, measured / expected);
    EXPECT_NEAR(measured / expected, 1.0, 0.05) << what;
}

TEST(StretchLawTest, StretchSpringsAlone) {
    const Stretch stretch = hanging_stretch(48, 20, 1, false);
    expect_near_law("mean, N 48, 20 x 1", stretch.mean, law(48, 20, 1));
    expect_near_law("RMS, N 48, 20 x 1", stretch.rms, 1.6 * law(48, 20, 1));
}

TEST(StretchLawTest, SubstepsAndIterations) {
    const Stretch stretch = hanging_stretch(48, 10, 4, false);
    expect_near_law("mean, N 48, 10 x 4", stretch.mean, law(48, 10, 4));
}

TEST(StretchLawTest, AllEightPasses) {
    const Stretch stretch = hanging_stretch(48, 20, 1, true);
    expect_near_law("mean with shear, N 48, 20 x 1", stretch.mean, 0.65 * law(48, 20, 1));
    expect_near_law("RMS with shear, N 48, 20 x 1", stretch.rms, 0.83 * law(48, 20, 1));
}

}  // namespace
}  // namespace drape
