// The explicit micro-step agrees with statics and conservation laws, and survives the worst starts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/sheet_state.h"
#include "support/windy_scenes.h"
#include "twin/twin.h"

namespace drape {
namespace {

SceneDescription explicit_sheet(std::uint32_t columns, std::uint32_t rows, double width, double height,
                                std::uint32_t substeps, double strain_damping) {
    SceneDescription scene = test::sheet(columns, rows, width, height, substeps);
    scene.solver.method = SolverMethod::explicit_steps;
    scene.solver.strain_damping = strain_damping;
    return scene;
}

TEST(ExplicitTest, AHangingSheetStretchesByItsTension) {
    // Columns alone: the tension under link j carries the mass below it, so strain = rho g (N - j - 1/2) dy / stretch.
    const std::uint32_t links = 32;
    SceneDescription scene = explicit_sheet(9, links + 1, 0.25, 1.0, 24, 0.2);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 100, 0, 0};
    cloth.damping = 20;
    cloth.pins = {test::pin_top(cloth)};
    const SimulationModel model(scene);
    ASSERT_TRUE(model.cloths[0].scheme.compromises.empty());
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 120; ++frame) twin.run_frame(frame);
    // Rounding excites waves of some 1e-7 m, which hardly anything damps: the mean tells the strain.
    constexpr std::uint32_t columns = 9, frames = 60;
    std::vector<double> lengths(columns * links);
    for (std::uint32_t frame = 121; frame <= 120 + frames; ++frame) {
        twin.run_frame(frame);
        for (std::uint32_t spring = 0; spring < columns * links; ++spring)
            lengths[spring] += test::distance(test::position_of(twin.cloth(0), spring),
                                              test::position_of(twin.cloth(0), spring + columns)) /
                               frames;
    }
    double worst = 0;
    for (std::uint32_t spring = 0; spring < columns * links; ++spring) {
        const std::uint32_t row = spring / columns;
        const double dy = model.cloths[0].spacing[1], below = links - row - 0.5;
        const double expected = cloth.areal_density * 9.81 * below * dy / cloth.stiffness.stretch.weft;
        worst = std::max(worst, std::abs((lengths[spring] / dy - 1) / expected - 1));
    }
    std::printf("[ measured ] worst relative error of a link's strain: %.2e\n", worst);
    EXPECT_LE(worst, 0.01);
}

/// A sheet of `links` x `links` is pinned along its top, 30 degrees out of the vertical; full stiffness, no damping.
SceneDescription swing(std::uint32_t links, std::uint32_t substeps, double strain_damping) {
    SceneDescription scene = explicit_sheet(links + 1, links + 1, 1, 1, substeps, strain_damping);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 2000, 200, 0};  // wave speed 100 m/s
    const double angle = std::numbers::pi / 6;
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, -std::cos(angle), std::sin(angle)}};
    cloth.pins = {test::pin_top(cloth)};
    return scene;
}

/// Energy above the sheet hanging straight down, as a mean over half a second around `end`, over that at the start.
double energy_kept(const SceneDescription& scene, std::uint32_t end) {
    const SimulationModel model(scene);
    EXPECT_TRUE(model.cloths[0].scheme.compromises.empty());
    Twin twin(model);
    const double mass = scene.cloths[0].areal_density, lowest = -mass * 9.81 * 0.5;
    const double start = test::energy_of(model, 0, twin.cloth(0)).gravity - lowest;
    double sum = 0;
    for (std::uint32_t frame = 1; frame <= end; ++frame) {
        twin.run_frame(frame);
        if (frame > end - 30) sum += test::energy_of(model, 0, twin.cloth(0)).total() - lowest;
    }
    return sum / 30 / start;
}

TEST(ExplicitTest, AnUndampedSwingKeepsItsEnergyForTenSeconds) {
    const double without = energy_kept(swing(16, 48, 0), 600), with = energy_kept(swing(16, 56, 0.2), 600);
    std::printf("[ measured ] swing 16^2, energy after 10 s: %.5f of the start (kappa 0), %.5f (kappa 0.2)\n", without,
                with);
    EXPECT_NEAR(without, 1, 0.01);
    EXPECT_NEAR(with, 1, 0.05);
}

/// Returns where the sheet is after half a second.
std::vector<Vec3> swung(std::uint32_t substeps, double strain_damping) {
    const SimulationModel model(swing(16, substeps, strain_damping));
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i)
        positions.push_back(test::position_of(twin.cloth(0), i));
    return positions;
}

TEST(ExplicitTest, StrainDampingHardlyChangesTheMotionOfFabric) {
    const std::vector<Vec3> exact = swung(448, 0);
    const auto error = [&](double strain_damping) {
        const std::vector<Vec3> found = swung(56, strain_damping);
        double sum = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(test::distance(exact[i], found[i]), 2);
        return std::sqrt(sum / static_cast<double>(exact.size()));
    };
    const double without = error(0), with = error(SolverSettings{}.strain_damping);
    std::printf("[ measured ] swing 16^2 after 0.5 s: %.2e m off without damping, %.2e with\n", without, with);
    EXPECT_LT(with, 3 * without);
}

TEST(ExplicitTest, MomentumIsKept) {
    SceneDescription scene = explicit_sheet(23, 17, 1, 0.8, 50, 0.2);
    scene.gravity = {0, 0, 0};
    scene.cloths[0].velocity = {0.4, -0.3, 0.7};
    scene.cloths[0].holes = {{{5, 3}, {9, 8}}};
    scene.cloths[0].stiffness.bend = 1e-3;
    const SimulationModel model(scene);
    Twin twin(model);
    TwinCloth& state = twin.cloth(0);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> kick(-2e-4f, 2e-4f);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i)
        if (state[Field::position][i].w > 0) {
            state[Field::displacement][i].x += kick(random);
            state[Field::displacement][i].y += kick(random);
            state[Field::displacement][i].z += kick(random);
        }
    const auto momentum = [&] {
        Vec3 sum{};
        for (std::size_t i = 0; i < state[Field::position].size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] += test::mass_of(model.cloths[0], i) * test::displacement_of(state, i)[k];
        return sum;
    };
    const Vec3 before = momentum();
    for (std::uint32_t frame = 1; frame <= 200; ++frame) twin.run_frame(frame);  // 1e4 steps
    const double error = test::distance(before, momentum()) / std::hypot(before[0], before[1], before[2]);
    std::printf("[ measured ] relative change of the momentum over 1e4 steps: %.2e\n", error);
    EXPECT_LE(error, 1e-6);
}

/// Energy (J) above the cloth hanging at its reach.
double energy_above(const SimulationModel& scene, const TwinCloth& state) {
    return test::energy_of(scene, 0, state).total() + scene.scene.cloths[0].areal_density * 9.81 * 2;
}

/// Simulates two seconds from a start that `disturb` makes; returns the last second's largest energy over the start's.
template <class Disturb>
double energy_growth(const SceneDescription& scene, const Disturb& disturb) {
    const SimulationModel model(scene);
    Twin twin(model);
    TwinCloth& state = twin.cloth(0);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i)
        if (state[Field::position][i].w > 0) {
            state[Field::position][i] = disturb(state[Field::position][i]);
            state[Field::displacement][i] = {};
        }
    const double start = energy_above(model, state);
    double largest = 0;
    for (std::uint32_t frame = 1; frame <= 120; ++frame) {
        twin.run_frame(frame);
        const double energy = energy_above(model, state);
        if (!std::isfinite(energy)) return energy;
        if (frame > 60) largest = std::max(largest, energy);
    }
    return largest / start;
}

class ExplicitStress : public testing::TestWithParam<std::tuple<std::uint32_t, double, double, double>> {};

TEST_P(ExplicitStress, NoStartGainsEnergy) {
    const auto [substeps, stretch, shear_ratio, bend] = GetParam();
    SceneDescription scene = explicit_sheet(33, 33, 1, 1, substeps, 0.2);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, stretch, shear_ratio * stretch, bend};
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(32, 0, 32, 0)};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> noise(-0.5f, 0.5f);
    const double tangled = energy_growth(scene, [&](const glsl::vec4& x) {
        return glsl::vec4{noise(random), noise(random), noise(random), x.w};
    });
    const double collapsed = energy_growth(scene, [&](const glsl::vec4& x) {
        return glsl::vec4{0.5f, -0.2f, 0.0f, x.w};
    });
    const double pulled = energy_growth(scene, [&](const glsl::vec4& x) {
        return glsl::vec4{10 * x.x, 10 * x.y, 1e-3f * noise(random), x.w};
    });
    std::printf(
        "[ measured ] %u substeps, %g N/m, shear %g, bend %g: energy after 1..2 s / start %.3f (tangled), %.3f "
        "(collapsed), "
        "%.3f (pulled)\n",
        substeps, stretch, shear_ratio, bend, tangled, collapsed, pulled);
    for (const double growth : {tangled, collapsed, pulled}) EXPECT_LE(growth, 1);
}

INSTANTIATE_TEST_SUITE_P(SubstepsAndStiffness, ExplicitStress,
                         testing::Combine(testing::Values(1u, 4u, 24u), testing::Values(10.0, 1e7),
                                          testing::Values(0.0, 0.1, 1.0), testing::Values(0.0, 1e-3)));

TEST(RelaxTest, BendingGainsNoEnergyFromATangledStart) {
    for (const double bend : {1e-6, 1e-3, 1e3})
        for (const std::uint32_t substeps : {1u, 4u, 24u}) {
            SceneDescription scene = test::sheet(33, 33, 1, 1, substeps);
            scene.cloths[0].stiffness = {false, 1000, 100, bend};
            scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(32, 0, 32, 0)};
            std::mt19937 random(7);
            std::uniform_real_distribution<float> noise(-0.5f, 0.5f);
            const double growth = energy_growth(scene, [&](const glsl::vec4& x) {
                return glsl::vec4{noise(random), noise(random), noise(random), x.w};
            });
            std::printf("[ measured ] relax, %u substeps, bend %g: energy after 1..2 s / start %.4f\n", substeps, bend,
                        growth);
            EXPECT_LE(growth, 1);
        }
}

TEST(ExplicitTest, ACrumpledClothCalmsDownAtTheDefaultDamping) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, 16);
    scene.solver.method = SolverMethod::explicit_steps;
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(16, 0, 16, 0)};
    const SimulationModel model(scene);
    Twin twin(model);
    test::Dice dice(1);
    for (glsl::vec4& at : twin.cloth(0)[Field::position])
        if (at.w > 0)
            at = {static_cast<float>(dice.between(-0.5, 0.5)), static_cast<float>(dice.between(-0.5, 0.5)),
                  static_cast<float>(dice.between(-0.5, 0.5)), at.w};
    for (std::uint32_t frame = 1; frame <= 300; ++frame) twin.run_frame(frame);
    double squares = 0;
    for (const glsl::vec4& d : twin.cloth(0)[Field::displacement])
        squares += double(d.x) * double(d.x) + double(d.y) * double(d.y) + double(d.z) * double(d.z);
    const double speed = std::sqrt(squares / 289) / model.cloths[0].substep_length;
    std::printf("[ measured ] %.3f m/s RMS after five seconds\n", speed);
    EXPECT_LT(speed, 3);
}

}  // namespace
}  // namespace drape
