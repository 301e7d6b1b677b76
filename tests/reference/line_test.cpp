// The line solver agrees with the double-precision network and statics, and survives the worst starts.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "network_scenes.h"
#include "reference/closed_forms.h"
#include "reference/symplectic_reference.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

std::vector<Vec3> positions(const TwinCloth& state) {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) all.push_back(test::position_of(state, i));
    return all;
}

/// RMS distance (m) from the reference after half a second.
double swing_error(SceneDescription scene, std::uint32_t substeps, const ReferenceRun& reference) {
    scene.solver.method = SolverMethod::line;
    scene.solver.substeps = substeps;
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
    return position_rms(positions(twin.cloth(0)), reference.states[0].position);
}

class LineSwing : public testing::TestWithParam<double> {};

TEST_P(LineSwing, ConvergesInSecondOrder) {
    SceneDescription scene = test::swing(32, 100, 30);
    scene.cloths[0].damping = GetParam();
    const double times[] = {0.5};
    const ReferenceRun reference = run_symplectic(SpringNetwork(scene, 0), times, {.cfl = 0.2});
    ASSERT_LE(reference.worst_error(), 1e-6);
    const double coarse = swing_error(scene, 10, reference), middle = swing_error(scene, 20, reference),
                 fine = swing_error(scene, 40, reference);
    const double order = std::log2(coarse / fine) / 2;
    std::printf(
        "[ measured ] swing 32^2, damping %g, RMS error after 0.5 s: %.2e %.2e %.2e m at 10, 20, 40 substeps; "
        "order %.2f\n",
        GetParam(), coarse, middle, fine, order);
    EXPECT_LE(middle, 1e-4);
    // The order is fitted over a factor of four: 2 but for the springs' own vibrations, which no such step resolves.
    EXPECT_GE(order, 1.3);
    EXPECT_LE(fine, 2.5e-5);
}

INSTANTIATE_TEST_SUITE_P(Damping, LineSwing, testing::Values(0.0, 2.0));

TEST(LineTest, ASwingNeedsNoMoreSubstepsForMoreLinks) {
    // h sqrt(g L)/l is 0.8 and 3.3, where the limit of transverse waves would be 0.67 if the tension were not implicit.
    const double times[] = {0.5};
    const SceneDescription scene = test::swing(64, 100, 30);
    const ReferenceRun reference = run_symplectic(SpringNetwork(scene, 0), times, {.cfl = 0.24});
    const double coarse = swing_error(scene, 4, reference), one = swing_error(scene, 1, reference);
    std::printf("[ measured ] swing 64^2, RMS error after 0.5 s: %.2e m at 4 substeps, %.2e m at 1\n", coarse, one);
    EXPECT_LE(coarse, 6e-4);
    EXPECT_LE(one, 1e-2);
}

TEST(LineTest, AnUndampedSwingKeepsItsEnergyForTenSeconds) {
    SceneDescription scene = test::swing(16, 100, 30);
    scene.solver.method = SolverMethod::line;
    scene.solver.substeps = 10;
    const SimulationModel model(scene);
    Twin twin(model);
    const double lowest = -scene.cloths[0].areal_density * 9.81 * 0.5;
    const double start = test::energy_of(model, 0, twin.cloth(0)).gravity - lowest;
    double sum = 0;
    for (std::uint32_t frame = 1; frame <= 600; ++frame) {
        twin.run_frame(frame);
        if (frame > 570) sum += test::energy_of(model, 0, twin.cloth(0)).total() - lowest;
    }
    std::printf("[ measured ] swing 16^2, 10 substeps, energy after 10 s: %.4f of the start\n", sum / 30 / start);
    EXPECT_NEAR(sum / 30 / start, 0.98, 0.015);
}

TEST(LineTest, AHangingSheetStretchesByItsTension) {
    const std::uint32_t links = 32;
    SceneDescription scene = test::sheet(9, links + 1, 0.25, 1.0, 4);
    scene.solver.method = SolverMethod::line;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 100, 0, 0};
    cloth.damping = 20;
    cloth.pins = {test::pin_top(cloth)};
    const SimulationModel model(scene);
    ASSERT_EQ(model.cloths[0].scheme.used_stiffness[1], model.cloths[0].stiffness_constant.spring[1]);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 120; ++frame) twin.run_frame(frame);
    double worst = 0;
    for (std::uint32_t row = 0; row < links; ++row)
        for (std::uint32_t column = 0; column < 9; ++column) {
            const Grid& grid = model.cloths[0].grid;
            const double dy = model.cloths[0].spacing[1];
            const double length = test::distance(test::position_of(twin.cloth(0), grid.particle(column, row)),
                                                 test::position_of(twin.cloth(0), grid.particle(column, row + 1)));
            const double expected =
                cloth.areal_density * 9.81 * (links - row - 0.5) * dy / cloth.stiffness.stretch.weft;
            worst = std::max(worst, std::abs((length / dy - 1) / expected - 1));
        }
    std::printf("[ measured ] worst relative error of a link's strain: %.2e\n", worst);
    EXPECT_LE(worst, 0.01);
}

TEST(LineTest, AChainHangsAsTheElasticCatenary) {
    // Two equal chains lie side by side, without shear, each with half the mass and the stiffness of a metre of cloth.
    const std::uint32_t links = 64;
    SceneDescription scene = test::sheet(links + 1, 2, 1.0, 1.0 / links, 4);
    scene.solver.method = SolverMethod::line;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 2000, 0, 0};
    cloth.damping = 4;
    Pin left = test::pin_box(0, 0, 0, 1), right = test::pin_box(links, 0, links, 1);
    right.path.keys = {{0, {0, 0, 0}, {}}, {1, {-0.4, 0, 0}, {}}};
    cloth.pins = {left, right};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 600; ++frame) twin.run_frame(frame);
    const double elastic_length = cloth.stiffness.stretch.warp / (cloth.areal_density * 9.81);
    const auto curve = closed_forms::elastic_catenary(0.6, 1.0, elastic_length);
    double sum = 0;
    for (std::uint32_t p = 0; p <= links; ++p) {
        const Vec3 x = test::position_of(twin.cloth(0), p);
        const auto expected =
            closed_forms::elastic_catenary_point(curve, elastic_length, static_cast<double>(p) / links - 0.5);
        const double dx = x[0] - (0.3 + expected.x), dy = x[1] - (expected.y - curve.sag);
        sum += dx * dx + dy * dy;
    }
    const double rms = std::sqrt(sum / (links + 1));
    std::printf("[ measured ] catenary of 64 links, 4 substeps: RMS %.2e m\n", rms);
    EXPECT_LE(rms, 3e-4);
}

TEST(LineTest, RigidClothPulledTooLongStretchesEvenly) {
    // The rows are taut between two held particles: without a least compliance their systems are singular. Rigid
    // diagonals contradict them.
    for (const bool has_shear : {false, true}) {
        SceneDescription scene = test::sheet(65, 9, 1, 0.125, 8);
        scene.solver.method = SolverMethod::line;
        scene.gravity = {0, 0, 0};
        scene.cloths[0].stiffness = {false, rigid_stiffness, has_shear ? rigid_stiffness : 0, 0};
        Pin right = test::pin_box(64, 0, 64, 8);
        right.path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0.001, 0, 0}, {}}};
        scene.cloths[0].pins = {test::pin_box(0, 0, 0, 8), right};
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 120; ++frame) twin.run_frame(frame);
        double worst = 0;
        for (std::uint32_t i = 0; i < 65 * 9; ++i) {
            const Vec3 x = test::position_of(twin.cloth(0), i);
            ASSERT_TRUE(std::isfinite(x[0]) && std::isfinite(x[2]));
            worst = std::max({worst, std::abs(x[0] - 1.001 * (i % 65) / 64), std::abs(x[2])});
        }
        std::printf("[ measured ] rigid cloth pulled 0.1 %% too long, %s: off the even stretch by %.2e m\n",
                    has_shear ? "with diagonals" : "rows alone", worst);
        EXPECT_LE(worst, 1e-6);
    }
}

/// Returns the largest strain of rows and columns over the last half of two seconds, RMS over the springs that exist;
/// infinite when a position is not finite.
double late_strain(SimulationModel& model, Twin& twin) {
    const ClothModel& cloth = model.cloths[0];
    const TwinCloth& state = twin.cloth(0);
    double worst = 0;
    for (std::uint32_t frame = 1; frame <= 120; ++frame) {
        twin.run_frame(frame);
        if (frame <= 60) continue;
        double sum = 0;
        std::size_t count = 0;
        test::for_springs(cloth, [&](std::size_t first, std::size_t second, std::size_t direction, double) {
            if (direction > 1) return;
            if (state.topology.cut_fraction(first, direction) >= 0) return;
            const double length = test::distance(test::position_of(state, first), test::position_of(state, second));
            const double strain = length / cloth.stiffness_constant.rest_length[direction] - 1;
            sum += strain * strain;
            ++count;
        });
        worst = std::max(worst, std::sqrt(sum / static_cast<double>(count)));
        if (!std::isfinite(worst) || !std::isfinite(sum)) return INFINITY;
    }
    return worst;
}

/// A sheet of 32 x 32 cells held at two corners, at 0.6 substeps per cell along it.
SceneDescription two_corner_drape() {
    SceneDescription scene = test::sheet(33, 33, 1, 1, 20);
    scene.solver.method = SolverMethod::line;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 2000, 200, 0};
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(32, 0, 32, 0)};
    return scene;
}

TEST(LineStress, ATwoCornerDrapeKeepsItsLengths) {
    SimulationModel model(two_corner_drape());
    Twin twin(model);
    const double strain = late_strain(model, twin);
    std::printf("[ measured ] two-corner drape: RMS strain %.4f\n", strain);
    EXPECT_LE(strain, 0.008);
}

TEST(LineStress, ATenthOfTheSpringsCut) {
    for (const double share : {0.05, 0.1}) {
        SimulationModel model(two_corner_drape());
        Twin twin(model);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> unit(0, 1);
        for (std::size_t particle = 0; particle < model.cloths[0].grid.particle_count(); ++particle)
            for (std::size_t direction = 0; direction < 4; ++direction)
                if (unit(random) < share) twin.topology(0).cut_spring(particle, direction, 0.5f);
        const double strain = late_strain(model, twin);
        std::printf("[ measured ] %.0f %% of the springs cut: RMS strain %.4f\n", 100 * share, strain);
        EXPECT_LE(strain, 0.02);
    }
}

TEST(LineStress, WorstStartsComeToTheirLengths) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> noise(-0.5f, 0.5f);
    const auto collapsed = [](const glsl::vec4& x) { return glsl::vec4{0.5f, -0.2f, 0.0f, x.w}; };
    const auto crumpled = [&](const glsl::vec4& x) {
        return glsl::vec4{0.5f + 1e-3f * noise(random), 1e-3f * noise(random), 1e-3f * noise(random), x.w};
    };
    const auto noisy = [&](const glsl::vec4& x) {
        return glsl::vec4{x.x + noise(random) / 32, x.y + noise(random) / 32, x.z + noise(random) / 32, x.w};
    };
    const auto run = [&](const char* name, const auto& start, double limit) {
        SimulationModel model(two_corner_drape());
        Twin twin(model);
        for (glsl::vec4& x : twin.cloth(0)[Field::position])
            if (x.w > 0) x = start(x);
        const double strain = late_strain(model, twin);
        std::printf("[ measured ] start %s: RMS strain %.4f\n", name, strain);
        EXPECT_LE(strain, limit);
    };
    run("in one point", collapsed, 0.15);
    run("crumpled", crumpled, 0.02);
    run("noisy", noisy, 0.02);
}

TEST(LineStress, TethersHoldADrapeThatTheSweepCannotFollow) {
    SceneDescription scene = two_corner_drape();
    scene.solver.substeps = 1;  // 0.03 per cell along the sheet
    const auto strain = [&] {
        SimulationModel model(scene);
        Twin twin(model);
        return late_strain(model, twin);
    };
    const double loose = strain();
    scene.solver.tethers = true;
    const double held = strain();
    std::printf("[ measured ] two-corner drape at 1 substep: RMS strain %.4f, with tethers %.4f\n", loose, held);
    EXPECT_GT(loose, 0.03);
    EXPECT_LE(held, 0.2 * loose);
}

TEST_P(LineSwing, TethersOfAnEdgeCostNoAccuracy) {
    SceneDescription scene = test::swing(32, 100, 30);
    scene.cloths[0].damping = GetParam();
    scene.solver.tethers = true;
    const double times[] = {0.5};
    const ReferenceRun reference = run_symplectic(SpringNetwork(scene, 0), times, {.cfl = 0.2});
    EXPECT_LE(swing_error(scene, 20, reference), 1e-4);
}

TEST(LineStress, ADrapeOnLongSubstepsGainsNoEnergy) {
    // There are 0.16 substeps per cell along the sheet. Without the carried tension the solve reaches 30 J with the
    // control that takes to backward Euler, and 190 J without it.
    SceneDescription scene = test::sheet(65, 65, 1, 1, 10);
    scene.solver.method = SolverMethod::line;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 2000, 200, 0};
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(64, 0, 64, 0)};
    const SimulationModel model(scene);
    Twin twin(model);
    double largest = 0;
    for (std::uint32_t frame = 1; frame <= 120; ++frame) {
        twin.run_frame(frame);
        largest = std::max(largest, test::energy_of(model, 0, twin.cloth(0)).total());
    }
    std::printf("[ measured ] drape 64^2 at 10 substeps: largest energy %.2f J\n", largest);
    EXPECT_LE(largest, 0.5);
}

}  // namespace
}  // namespace drape
