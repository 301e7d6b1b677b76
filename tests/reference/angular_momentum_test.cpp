// Lines and relaxation keep angular momentum: of a free cloth about its centre of mass, of a cloth that is held on a
// line along gravity about that line, at any number of substeps. Its bounds are those of rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "base/vectors.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

double free_mass(const ClothModel& cloth, const TwinCloth& state, std::size_t i) {
    return state[Field::position][i].w > 0 ? test::mass_of(cloth, i) : 0;
}

/// Returns the angular momentum (kg m^2/s) of a cloth's free particles about a point, over the last substep.
Vec3 momentum_about(const Vec3& point, const SimulationModel& model, const Twin& twin) {
    const ClothModel& cloth = model.cloths[0];
    const TwinCloth& state = twin.cloth(0);
    Vec3 sum{};
    for (std::size_t i = 0; i < cloth.position.size(); ++i)
        sum = plus(sum, times(free_mass(cloth, state, i) / cloth.substep_length,
                              cross(minus(test::position_of(state, i), point), test::displacement_of(state, i))));
    return sum;
}

Vec3 centre_of(const SimulationModel& model, const Twin& twin) {
    Vec3 sum{};
    double mass = 0;
    for (std::size_t i = 0; i < model.cloths[0].position.size(); ++i) {
        const double own = free_mass(model.cloths[0], twin.cloth(0), i);
        sum = plus(sum, times(own, test::position_of(twin.cloth(0), i)));
        mass += own;
    }
    return times(1 / mass, sum);
}

/// A sheet that turns at some `turning` rad/s about an oblique axis, in a motion, drawn from a seed, that crumples it.
SceneDescription crumpled(std::uint32_t substeps, double turning, double bend, unsigned seed,
                          SolverMethod method = SolverMethod::line) {
    constexpr std::uint32_t links = 8;
    SceneDescription scene = test::sheet(links + 1, links + 1, 0.5, 0.5, substeps);
    scene.solver.method = method;
    scene.gravity = {0, 0, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = 0.1;
    cloth.stiffness = {false, 1000, 60, bend};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> speed(-1, 1);
    std::array<std::array<double, 3>, 3> waves{};
    for (auto& wave : waves)
        for (double& each : wave) each = speed(random);
    for (std::uint32_t row = 0; row <= links; ++row)
        for (std::uint32_t column = 0; column <= links; ++column) {
            const double x = 0.5 * column / links - 0.25, y = 0.25 - 0.5 * row / links;
            Vec3 v = cross(Vec3{0.3 * turning, turning, 0.5 * turning}, Vec3{x, y, 0});
            for (std::size_t k = 0; k < 3; ++k)
                v[k] += waves[0][k] * std::sin(12 * x) + waves[1][k] * std::cos(9 * y) +
                        waves[2][k] * std::sin(10 * x + 14 * y);
            cloth.velocities.push_back(v);
        }
    return scene;
}

struct Crumple {
    std::uint32_t substeps;
    double bend;
    SolverMethod method = SolverMethod::line;
};

class AngularMomentum : public testing::TestWithParam<Crumple> {};

TEST_P(AngularMomentum, OfACrumpledSheetThatSpinsWithoutWeightStays) {
    const auto [substeps, bend, method] = GetParam();
    for (const double turning : {1.0, 10.0}) {
        const SimulationModel model(crumpled(substeps, turning, bend, 7, method));
        Twin twin(model);
        const Vec3 start = momentum_about(centre_of(model, twin), model, twin);
        double worst = 0;
        for (std::uint32_t frame = 1; frame <= 60; ++frame) {
            twin.run_frame(frame);
            const Vec3 now = momentum_about(centre_of(model, twin), model, twin);
            worst = std::max(worst, length(minus(now, start)) / length(start));
        }
        std::printf("[ measured ] %u substeps, %g rad/s: angular momentum drifts by %.1e\n", substeps, turning, worst);
        EXPECT_LT(worst, 1e-4);
    }
}

INSTANTIATE_TEST_SUITE_P(Sheets, AngularMomentum,
                         testing::Values(Crumple{1, 0}, Crumple{4, 0}, Crumple{16, 0}, Crumple{64, 0}, Crumple{1, 1e-4},
                                         Crumple{8, 1e-4}, Crumple{1, 0, SolverMethod::relax},
                                         Crumple{4, 0, SolverMethod::relax}, Crumple{16, 0, SolverMethod::relax},
                                         Crumple{64, 0, SolverMethod::relax}, Crumple{8, 1e-4, SolverMethod::relax}));

/// A sheet that is held by its left edge on a pole, and lets itself down from there.
SceneDescription flag(std::uint32_t substeps, SolverMethod method = SolverMethod::line) {
    SceneDescription scene = test::sheet(13, 9, 0.9, 0.6, substeps);
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = 0.1;
    cloth.stiffness = {false, 1000, 60, 0};
    cloth.pins = {test::pin_box(0, 0, 0, 8)};
    // It swings out of its plane, and turns.
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 13; ++column)
            cloth.velocities.push_back({0, 0, std::sin(0.7 * column + 0.3 * row) + 0.02 * column});
    return scene;
}

class Pole : public testing::TestWithParam<std::tuple<std::uint32_t, SolverMethod>> {};

TEST_P(Pole, GivesALimpFlagNoSpin) {
    const auto [substeps, method] = GetParam();
    const SimulationModel model(flag(substeps, method));
    Twin twin(model);
    const double start = momentum_about({0, 0, 0}, model, twin)[1];
    double worst = 0;
    for (std::uint32_t frame = 1; frame <= 120; ++frame) {
        twin.run_frame(frame);
        worst = std::max(worst, std::abs(momentum_about({0, 0, 0}, model, twin)[1] - start));
    }
    std::printf("[ measured ] %u substeps: at most %.1e of %.1e kg m^2/s about the pole in 2 s\n", substeps, worst,
                start);
    EXPECT_LT(worst, 1e-4 * std::abs(start));
}

INSTANTIATE_TEST_SUITE_P(Substeps, Pole,
                         testing::Combine(testing::Values(1u, 4u, 8u, 40u),
                                          testing::Values(SolverMethod::line, SolverMethod::relax)));

TEST(AngularMomentumTest, OfASheetOnAPinWithoutWeightStaysAboutThePin) {
    SceneDescription scene = crumpled(6, 4, 0, 3);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0)};
    const SimulationModel model(scene);
    Twin twin(model);
    const Vec3 pin = test::position_of(twin.cloth(0), 0), start = momentum_about(pin, model, twin);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    EXPECT_LT(length(minus(momentum_about(pin, model, twin), start)), 1e-4 * length(start));
}

TEST(AngularMomentumTest, FallsByDampingAlone) {
    SceneDescription scene = crumpled(6, 4, 0, 4);
    scene.gravity = {1, -9.81, 2};
    scene.cloths[0].damping = 1.5;
    const SimulationModel model(scene);
    Twin twin(model);
    const Vec3 start = momentum_about(centre_of(model, twin), model, twin);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    const Vec3 left = times(std::exp(-1.5), start);
    EXPECT_LT(length(minus(momentum_about(centre_of(model, twin), model, twin), left)), 1e-3 * length(left));
}

/// Wind turns a flag as much as it does in short substeps.
TEST(AngularMomentumTest, WindTurnsAFlag) {
    const auto turned = [](std::uint32_t substeps, SolverMethod method = SolverMethod::line) {
        SceneDescription scene = flag(substeps, method);
        scene.wind.velocity = {0.5, 0, 3};
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 12; ++frame) twin.run_frame(frame);
        return momentum_about({0, 0, 0}, model, twin)[1];
    };
    const double coarse = turned(4), middle = turned(16), fine = turned(64);
    std::printf("[ measured ] wind turns a flag by %.4e %.4e %.4e kg m^2/s at 4, 16 and 64 substeps\n", coarse, middle,
                fine);
    EXPECT_NEAR(middle / fine, 1, 0.02);
    EXPECT_NEAR(coarse / fine, 1, 0.08);
    const double relaxed = turned(64, SolverMethod::relax);
    std::printf("[ measured ] and by %.4e at 64 substeps of relaxation\n", relaxed);
    EXPECT_NEAR(relaxed / fine, 1, 0.08);
}

/// A flag that a pole lets go keeps its motion, and from there on both momenta.
TEST(AngularMomentumTest, OfAFlagThatItsPoleLetsGoStays) {
    SceneDescription scene = flag(8);
    scene.gravity = {0, 0, 0};
    scene.cloths[0].pins[0].release = 0.5;
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 33; ++frame) twin.run_frame(frame);
    const Vec3 start = momentum_about(centre_of(model, twin), model, twin), from = centre_of(model, twin);
    for (std::uint32_t frame = 34; frame <= 48; ++frame) twin.run_frame(frame);
    const Vec3 middle = centre_of(model, twin);
    for (std::uint32_t frame = 49; frame <= 63; ++frame) twin.run_frame(frame);
    EXPECT_LT(length(minus(momentum_about(centre_of(model, twin), model, twin), start)), 1e-4 * length(start));
    const Vec3 first = minus(middle, from), second = minus(centre_of(model, twin), middle);
    EXPECT_LT(length(minus(second, first)), 1e-5 * length(first)) << "the centre of mass goes straight";
}

}  // namespace
}  // namespace drape
