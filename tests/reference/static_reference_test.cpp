// Statics agree with closed forms: hanging column and sheet, catenary, cantilever, modes about an equilibrium.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "network_scenes.h"
#include "reference/closed_forms.h"
#include "reference/implicit_reference.h"

namespace drape {
namespace {

TEST(StaticReferenceTest, HangingColumnHasTheTensionOfTheWeightBelow) {
    // Two columns of a cloth only stretch: every column link carries what hangs below it.
    SceneDescription scene = test::swing(2, 30, 25);
    Cloth& cloth = scene.cloths[0];
    cloth.grid = {2, 17};
    cloth.stiffness.shear = 0;
    cloth.pins = {test::pin_top(cloth)};
    const SpringNetwork network(scene, 0);
    const StaticResult result = find_equilibrium(network);
    ASSERT_TRUE(result.converged);
    double worst = 0;
    for (const NetworkSpring& spring : network.springs) {
        if (spring.second - spring.first != 2) continue;
        const Vec3 &a = result.position[spring.first], &b = result.position[spring.second];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        const double tension = spring.stiffness * (length - spring.rest_length);
        const double expected = closed_forms::hanging_link_tension(16, spring.first / 2, network.mass[4], 9.81, true);
        worst = std::max(worst, std::abs(tension / expected - 1));
    }
    std::printf("[ measured ] hanging column: worst tension error %.1e, %u iterations, residual %.1e N\n", worst,
                result.iterations, result.residual);
    EXPECT_LT(worst, 1e-9);
    EXPECT_NEAR(-result.position[32][1],
                closed_forms::hanging_length(16, 1, network.springs.back().stiffness, network.mass[4], 9.81, true),
                1e-10);
}

TEST(StaticReferenceTest, HangingSheetCarriesItsWeightRowByRow) {
    const SpringNetwork network(test::swing(12, 30, 30), 0);
    const StaticResult result = find_equilibrium(network);
    ASSERT_TRUE(result.converged);
    // The vertical force through the cut between rows j and j+1 is the weight below it.
    for (std::uint32_t row = 0; row < 12; ++row) {
        double through = 0, below = 0;
        for (const NetworkSpring& spring : network.springs) {
            if (spring.first / 13 > row || spring.second / 13 <= row) continue;
            const Vec3 &a = result.position[spring.first], &b = result.position[spring.second];
            const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
            through += spring.stiffness * (1 - spring.rest_length / length) * (a[1] - b[1]);
        }
        for (std::uint32_t p = 13 * (row + 1); p < network.particle_count(); ++p) below += 9.81 * network.mass[p];
        EXPECT_NEAR(through / below, 1, 1e-9) << row;
    }
}

TEST(StaticReferenceTest, CornerPinnedDrapeReachesAMinimum) {
    SceneDescription scene = test::swing(16, 30, 0);
    Cloth& cloth = scene.cloths[0];
    cloth.placement.v = {0, 0, 1};  // starts flat
    cloth.stiffness.bend = 1e-4;
    cloth.pins = {test::pin_box(0, 0, 0, 0), test::pin_box(16, 0, 16, 0)};
    const SpringNetwork network(scene, 0);
    const StaticResult result = find_equilibrium(network);
    std::printf("[ measured ] drape: %u iterations, residual %.1e N, last step %.1e m, energy %.9f J\n",
                result.iterations, result.residual, result.last_step, result.energy);
    ASSERT_TRUE(result.converged);
    ASSERT_TRUE(result.minimum);
    EXPECT_LT(result.residual, 1e-9);
    for (unsigned seed = 1; seed <= 20; ++seed) {  // at a strict minimum every small move costs energy
        std::vector<Vec3> moved = test::shaken(result.position, 1e-4, seed);
        for (const std::size_t pinned : {0u, 16u}) moved[pinned] = result.position[pinned];
        EXPECT_GT(network.potential_energy(moved), result.energy);
    }
}

TEST(StaticReferenceTest, SaysWhetherAnEquilibriumIsAMinimum) {
    // The sheet is flat to the last bit and without bending: the compression beside the pins would make wrinkles, if
    // something started them; a turned start does.
    const StaticResult flat = find_equilibrium(SpringNetwork(test::swing(16, 100, 0), 0));
    EXPECT_TRUE(flat.converged);
    EXPECT_FALSE(flat.minimum);
    const StaticResult wrinkled = find_equilibrium(SpringNetwork(test::swing(16, 100, 30), 0));
    EXPECT_TRUE(wrinkled.converged);
    EXPECT_TRUE(wrinkled.minimum);
    EXPECT_LT(wrinkled.energy, flat.energy);
    SceneDescription bent = test::swing(16, 100, 30);
    bent.cloths[0].stiffness.bend = 1e-4;
    const StaticResult smooth = find_equilibrium(SpringNetwork(bent, 0));
    EXPECT_TRUE(smooth.minimum);
    for (const Vec3& x : smooth.position) EXPECT_NEAR(x[2], 0, 1e-12);
}

TEST(StaticReferenceTest, TheWayToTheMinimumDoesNotMatterWhereThereIsOne) {
    SceneDescription scene = test::swing(10, 100, 60);
    scene.cloths[0].stiffness.bend = 1e-3;
    const SpringNetwork network(scene, 0);
    const StaticResult soft = find_equilibrium(network), direct = find_equilibrium(network, {.soften_first = false});
    ASSERT_TRUE(soft.converged && direct.converged);
    EXPECT_LT(position_rms(soft.position, direct.position), 1e-10);
}

/// RMS distance of a hanging chain's particles from the elastic catenary.
double catenary_error(std::uint32_t links) {
    SpringNetwork network = test::chain(links, 1, 1, 100 * 9.81, {1, 0, 0});
    network.pins.emplace_back();
    network.pin_of.back() = 1;
    for (std::uint32_t p = 0; p <= links; ++p)
        network.rest_position[p] = {0.8 * p / links, -0.3 * std::sin(std::numbers::pi * p / links), 0};
    const StaticResult result = find_equilibrium(network);
    EXPECT_TRUE(result.converged);
    const closed_forms::Catenary curve = closed_forms::elastic_catenary(0.8, 1, 100);
    std::vector<Vec3> exact;
    for (std::uint32_t p = 0; p <= links; ++p) {
        const auto at = closed_forms::elastic_catenary_point(curve, 100, double(p) / links - 0.5);
        exact.push_back({0.4 + at.x, at.y - curve.sag, 0});
    }
    return position_rms(result.position, exact);
}

TEST(StaticReferenceTest, CatenaryConvergesWithOrderTwo) {
    const std::vector<double> links{16, 32, 64, 128};
    std::vector<double> errors;
    for (const double count : links) errors.push_back(catenary_error(static_cast<std::uint32_t>(count)));
    std::printf("[ measured ] catenary RMS error, N = 16 32 64 128: %.3e %.3e %.3e %.3e m\n", errors[0], errors[1],
                errors[2], errors[3]);
    EXPECT_LT(errors[2], 2.3e-4);
    EXPECT_NEAR(std::log(errors[0] / errors[3]) / std::log(8.0), 2, 0.05);
}

/// Angular frequencies, lowest first, of small motions out of the chain's plane.
Eigen::VectorXd transverse_frequencies(const SpringNetwork& network) {
    const std::vector<Vec3> x = find_equilibrium(network).position;
    const auto count = static_cast<Eigen::Index>(network.particle_count()) - 1;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    for (const HessianEntry& entry : network.hessian(x, HessianForm::exact)) {
        if (entry.row % 3 != 2 || entry.column % 3 != 2 || entry.column / 3 == 0) continue;
        matrix(entry.row / 3 - 1, entry.column / 3 - 1) += entry.value;
    }
    for (Eigen::Index r = 0; r < count; ++r)
        for (Eigen::Index c = 0; c <= r; ++c)
            matrix(r, c) /= std::sqrt(network.mass[static_cast<std::size_t>(r) + 1] *
                                      network.mass[static_cast<std::size_t>(c) + 1]);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().cwiseSqrt();  // reads the lower half
}

TEST(StaticReferenceTest, HangingChainModesConvergeWithOrderTwo) {
    const std::vector<double> links{16, 32, 64, 128};
    std::vector<Eigen::VectorXd> found;
    for (const double count : links)
        found.push_back(transverse_frequencies(test::chain(static_cast<std::uint32_t>(count), 1, 1, 1e9, {0, -1, 0})));
    for (std::uint32_t n = 1; n <= 4; ++n) {
        std::vector<double> errors;
        for (const Eigen::VectorXd& frequencies : found)
            errors.push_back(std::abs(frequencies[n - 1] / closed_forms::hanging_chain_frequency(n, 1, 9.81) - 1));
        std::printf("[ measured ] chain mode %u, N = 16 32 64 128: %.2e %.2e %.2e %.2e\n", n, errors[0], errors[1],
                    errors[2], errors[3]);
        EXPECT_NEAR(std::log(errors[2] / errors[3]) / std::log(2.0), 2, 0.1);
    }
}

struct Overhang {
    double reach, drop;  ///< W/L, H/L
    double worst_strain;
    std::uint32_t iterations;
};

/// Returns H/W of a strip two particles wide whose first segment is held level. The hinge at the last held particle
/// bends over half a segment to either side, so the clamp is that segment's middle and the length L counts from there.
Overhang overhang(std::uint32_t segments, double gamma, double strain) {
    const double length = 1, spacing = length / (segments - 0.5), density = 0.2;
    SceneDescription scene = test::sheet(segments + 1, 2, spacing * segments, spacing, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = density;
    cloth.placement.origin = {-0.5 * spacing, 0, 0};
    cloth.placement.v = {0, 0, 1};
    const double weight = density * 9.81;  // N/m^2
    cloth.stiffness.bend = weight * length * length * length / gamma;
    cloth.stiffness.stretch = weight * length / strain;
    cloth.stiffness.shear = 0.1 * cloth.stiffness.stretch.warp;
    cloth.pins = {test::pin_box(0, 0, 1, 1)};
    const SpringNetwork network(scene, 0);
    const StaticResult result = find_equilibrium(network);
    EXPECT_TRUE(result.converged) << segments << " segments, gamma " << gamma << ": last step " << result.last_step;
    const Vec3& tip = result.position[segments];
    return {tip[0], -tip[1], network.strain(result.position, SpringFamily::stretch).max, result.iterations};
}

TEST(StaticReferenceTest, CantileverFollowsTheHeavyElastica) {
    for (const double gamma : {1.0, 10.0, 100.0}) {
        const closed_forms::HeavyElastica exact = closed_forms::heavy_elastica(gamma);
        const std::vector<double> segments{16, 32, 64};
        std::vector<double> tip, ratio;
        Overhang last{};
        for (const double count : segments) {
            last = overhang(static_cast<std::uint32_t>(count), gamma, 1e-6);
            tip.push_back(std::hypot(last.reach - exact.reach, last.drop - exact.drop));
            ratio.push_back(std::abs(last.drop / last.reach / exact.ratio() - 1));
        }
        std::printf(
            "[ measured ] gamma %g: H/W %.6f (exact %.6f), relative errors at 16 32 64 segments "
            "%.2e %.2e %.2e, tip %.2e %.2e %.2e L, worst strain %.1e, %u iterations\n",
            gamma, last.drop / last.reach, exact.ratio(), ratio[0], ratio[1], ratio[2], tip[0], tip[1], tip[2],
            last.worst_strain, last.iterations);
        EXPECT_LT(ratio[2], 0.02);
        // The order is the tip's: at gamma = 10 the leading errors of H and W nearly cancel in their ratio.
        EXPECT_NEAR(std::log(tip[0] / tip[2]) / std::log(4.0), 2, 0.1);
    }
}

}  // namespace
}  // namespace drape
