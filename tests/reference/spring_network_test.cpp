// The spring network is built right, and its derivatives, symmetries and fast kernel agree with it.
#include "reference/spring_network.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "cloth/cloth_model.h"
#include "cloth/cut_topology.h"
#include "network_scenes.h"
#include "reference/network_kernel.h"
#include "support/method_steps.h"

namespace drape {
namespace {

SceneDescription holed_sheet() {
    SceneDescription scene = test::sheet(9, 7, 1.2, 0.6, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 50, 7, 2e-3, 0.3};
    cloth.holes = {{{2, 2}, {4, 4}}, {{6, 0}, {8, 1}}};
    cloth.pins = {test::pin_box(0, 0, 2, 0)};
    return scene;
}

TEST(SpringNetworkTest, HasTheMassesSpringsAndRestLengthsOfTheDevice) {
    const SceneDescription scene = holed_sheet();
    const SpringNetwork network(scene, 0);
    const ClothModel model(scene, 0);
    for (std::size_t p = 0; p < network.particle_count(); ++p) {
        const double weight = double(model.free_weight[p]);
        EXPECT_NEAR(network.mass[p], weight == 0 ? 0 : model.inner_mass / weight, 1e-7 * model.inner_mass);
    }
    double total = 0;
    for (const double m : network.mass) total += m;
    const Cloth& cloth = scene.cloths[0];
    EXPECT_NEAR(total, cloth.areal_density * (1.2 * 0.6 - 6 * 0.15 * 0.1), 1e-14);
    // Every spring of the device occurs once, with share * k = share * m_inner / (compliance h^2).
    std::size_t found = 0;
    const CutTopology topology(model);
    for (const glsl::SpringPush& push : test::pushes<glsl::SpringPush>(model.scheme)) {
        if (push.parity != 0) continue;
        const double h = model.substep_length, k = model.inner_mass / (double(push.compliance) * h * h);
        const int step = push.offset.y * 9 + push.offset.x;
        for (const NetworkSpring& spring : network.springs) {
            if (static_cast<int>(spring.second) - static_cast<int>(spring.first) != step) continue;
            const glsl::vec4 shares = topology.spring_shares()[spring.first];
            const double share = double((&shares.x)[push.channel]);
            EXPECT_NEAR(spring.stiffness, share * k, 1e-6 * k);
            EXPECT_NEAR(spring.rest_length, double(push.rest_length), 1e-7);
            ++found;
        }
    }
    EXPECT_EQ(found, network.springs.size());
    std::size_t present = 0;
    for (const glsl::vec4& shares : topology.spring_shares())
        for (std::size_t direction = 0; direction < 4; ++direction) present += (&shares.x)[direction] > 0;
    EXPECT_EQ(present, network.springs.size());
}

TEST(SpringNetworkTest, RefusesWhatHasNoReference) {
    SceneDescription scene = holed_sheet();
    scene.colliders.push_back({Sphere{}});
    EXPECT_THROW(SpringNetwork(scene, 0), std::invalid_argument);
    EXPECT_NO_THROW(SpringNetwork(scene, 0, {.ignore_colliders = true}));
    scene.colliders = {};
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_THROW(SpringNetwork(scene, 0), std::invalid_argument);
}

TEST(SpringNetworkTest, GradientIsTheEnergysDerivative) {
    const SpringNetwork network(holed_sheet(), 0);
    std::vector<Vec3> x = test::shaken(network.rest_position, 0.05, 1);
    const std::vector<Vec3> gradient = network.gradient(x);
    double worst = 0, scale = 0;
    for (std::size_t p = 0; p < x.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = x[p][k], e = 1e-5;
            x[p][k] = at + e;
            const double after = network.potential_energy(x);
            x[p][k] = at - e;
            const double before = network.potential_energy(x);
            x[p][k] = at;
            worst = std::max(worst, std::abs((after - before) / (2 * e) - gradient[p][k]));
            scale = std::max(scale, std::abs(gradient[p][k]));
        }
    EXPECT_LT(worst, 1e-7 * scale);
}

Eigen::MatrixXd dense(const SpringNetwork& network, const std::vector<Vec3>& x, HessianForm form) {
    const auto size = static_cast<Eigen::Index>(3 * network.particle_count());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    for (const HessianEntry& entry : network.hessian(x, form)) {
        EXPECT_GE(entry.row, entry.column);
        matrix(entry.row, entry.column) += entry.value;
        if (entry.row != entry.column) matrix(entry.column, entry.row) += entry.value;
    }
    return matrix;
}

TEST(SpringNetworkTest, HessianIsTheGradientsDerivative) {
    const SpringNetwork network(holed_sheet(), 0);
    std::vector<Vec3> x = test::shaken(network.rest_position, 0.05, 2);
    const Eigen::MatrixXd hessian = dense(network, x, HessianForm::exact);
    double worst = 0;
    for (std::size_t p = 0; p < x.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = x[p][k], e = 1e-6;
            x[p][k] = at + e;
            const std::vector<Vec3> after = network.gradient(x);
            x[p][k] = at - e;
            const std::vector<Vec3> before = network.gradient(x);
            x[p][k] = at;
            for (std::size_t q = 0; q < x.size(); ++q)
                for (std::size_t c = 0; c < 3; ++c)
                    worst = std::max(worst, std::abs((after[q][c] - before[q][c]) / (2 * e) -
                                                     hessian(static_cast<Eigen::Index>(3 * q + c),
                                                             static_cast<Eigen::Index>(3 * p + k))));
        }
    EXPECT_LT(worst, 1e-6 * hessian.cwiseAbs().maxCoeff());
}

TEST(SpringNetworkTest, ClampedHessianIsPositiveSemidefiniteWhereTheExactOneIsNot) {
    const SpringNetwork network(holed_sheet(), 0);
    const std::vector<Vec3> x = test::shaken(network.rest_position, 0.05, 3);
    const auto least = [&](HessianForm form) {
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(network, x, form), Eigen::EigenvaluesOnly)
            .eigenvalues()[0];
    };
    EXPECT_LT(least(HessianForm::exact), -1.0);
    EXPECT_GT(least(HessianForm::clamped), -1e-10);
}

TEST(SpringNetworkTest, SpringsAndBendingExertNoTotalForceOrTorque) {
    SpringNetwork network(holed_sheet(), 0);
    network.gravity = {0, 0, 0};
    const std::vector<Vec3> x = test::shaken(network.rest_position, 0.1, 4), gradient = network.gradient(x);
    Vec3 force{}, torque{};
    for (std::size_t p = 0; p < x.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            force[k] += gradient[p][k];
            torque[k] += x[p][a] * gradient[p][b] - x[p][b] * gradient[p][a];
        }
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(force[k], 0, 1e-12);
        EXPECT_NEAR(torque[k], 0, 1e-12);
    }
}

TEST(SpringNetworkTest, FastKernelEqualsThePlainGradient) {
    // The second sheet's rows are longer than the kernel takes at a time.
    for (const SceneDescription& scene : {holed_sheet(), test::sheet(300, 3, 30.0, 0.2, 1)}) {
        const SpringNetwork network(scene, 0);
        const std::vector<Vec3> x = test::shaken(network.rest_position, 0.05, 5), gradient = network.gradient(x);
        Planes acceleration;
        NetworkKernel(network).accelerations(to_planes(x), acceleration);
        for (std::size_t p = 0; p < x.size(); ++p)
            for (std::size_t k = 0; k < 3; ++k) {
                const double expected = network.mass[p] > 0 ? -gradient[p][k] / network.mass[p] : 0.0;
                EXPECT_NEAR(acceleration[k][p], expected, 1e-12 * (1 + std::abs(expected)));
            }
    }
    SpringNetwork collapsed = test::chain(1, 1, 1, 100, {1, 0, 0});  // no length, no direction, no force
    Planes acceleration;
    NetworkKernel(collapsed).accelerations(to_planes(std::vector<Vec3>(2, Vec3{})), acceleration);
    EXPECT_EQ(acceleration[0][1], 0);
    EXPECT_EQ(acceleration[1][1], -9.81);
}

/// Returns the bending energy of a square sheet rolled gently into a cylinder of the given curvature whose axis lies at
/// `angle` to the columns, over B/2 curvature^2 area.
double rolled_energy(double angle) {
    SceneDescription scene = test::sheet(65, 65, 1.0, 1.0, 1);
    scene.cloths[0].stiffness.bend = 1e-3;
    const SpringNetwork network(scene, 0);
    const double curvature = 0.1;
    return network.bending_energy(test::rolled(network.rest_position, angle, curvature)) /
           (0.5 * 1e-3 * curvature * curvature);
}

TEST(SpringNetworkTest, BendingIsAsStiffInEveryDirection) {
    const double across_angle = std::numbers::pi / 4, axes = rolled_energy(0),
                 between = rolled_energy(across_angle / 2), across = rolled_energy(across_angle);
    std::printf("[ measured ] rigidity over B: axes %.4f, 22.5 degrees %.4f, 45 degrees %.4f\n", axes, between, across);
    // The outermost half cells of the bent axis carry no curvature, a share 1/64 of the area. Across the axes half of
    // the rigidity is the twist's, which every cell has.
    EXPECT_NEAR(axes, 63.0 / 64, 1e-4);
    EXPECT_NEAR(between, 0.75 * 63.0 / 64 + 0.25, 1e-4);
    EXPECT_NEAR(across, 0.5 * 63.0 / 64 + 0.5, 1e-4);
}

TEST(SpringNetworkTest, BendingStaysBelowTheCellsBound) {
    // Explicit steps rely on it that 16 (b0 + b1 + t)/m bounds the squared frequencies of any assembly of cells.
    SceneDescription scene = holed_sheet();
    scene.cloths[0].stiffness = {false, 0, 0, 2e-3};
    for (const bool whole : {false, true}) {
        if (whole) scene.cloths[0].holes.clear();
        const SpringNetwork network(scene, 0);
        Eigen::MatrixXd matrix = dense(network, network.rest_position, HessianForm::exact);
        for (Eigen::Index row = 0; row < matrix.rows(); ++row)
            for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
                const double mass = network.mass[static_cast<std::size_t>(row / 3)] *
                                    network.mass[static_cast<std::size_t>(column / 3)];
                matrix(row, column) = mass > 0 ? matrix(row, column) / std::sqrt(mass) : 0;
            }
        const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
                                   .eigenvalues()[matrix.rows() - 1];
        const ClothModel model(scene, 0);
        const StiffnessConstants& k = model.stiffness_constant;
        const double bound = 16 * (k.bend[0] + k.bend[1] + k.twist) / model.inner_mass;
        std::printf("[ measured ] %s sheet: largest squared frequency of the bending %.4f of the cells' bound\n",
                    whole ? "whole" : "holed", largest / bound);
        EXPECT_LT(largest, bound);
        EXPECT_GT(largest, 0.7 * bound);
    }
}

TEST(SpringNetworkTest, BendingEndsAtHoles) {
    const SpringNetwork network(holed_sheet(), 0);
    for (const BendingElement& element : network.bending)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(network.mass[element.particle[k]], 0);
    // Particle (3, 2) lies on the hole's upper edge, with cloth on one side only: a row triple there has half the
    // weight and a column triple (rows 1 2 3) none.
    const auto stiffness = [&](std::uint32_t p, std::uint32_t step) {
        for (const BendingElement& element : network.bending)
            if (element.coefficient[1] == -2 && element.particle[1] == p && element.particle[0] == p - step)
                return element.stiffness;
        return 0.0;
    };
    const double along_row = 2e-3 * 0.1 / (0.15 * 0.15 * 0.15);
    EXPECT_NEAR(stiffness(2 * 9 + 3, 1), 0.5 * along_row, 1e-12);
    EXPECT_EQ(stiffness(2 * 9 + 3, 9), 0);
    EXPECT_NEAR(stiffness(5 * 9 + 5, 1), along_row, 1e-12);
}

TEST(SpringNetworkTest, WindOnAFlatSheet) {
    SceneDescription scene = test::sheet(5, 4, 0.8, 0.5, 1);
    scene.wind.velocity = {3, 0, 4};
    scene.wind.drag = 1.1;
    scene.wind.lift = 0.4;
    const SpringNetwork network(scene, 0);
    const NetworkState state = network.start();
    std::vector<Vec3> force(network.particle_count(), Vec3{});
    network.add_wind_force(state.position, state.velocity, 0, force);
    Vec3 total{};
    for (const Vec3& f : force)
        for (std::size_t k = 0; k < 3; ++k) total[k] += f[k];
    // F = rho A/2 [(Cd - Cl)(v.n) v + Cl |v|^2 n], n = +z since v.z > 0.
    const double scale = 0.5 * 1.2 * 0.8 * 0.5;
    EXPECT_NEAR(total[0], scale * 0.7 * 4 * 3, 1e-12);
    EXPECT_NEAR(total[1], 0, 1e-12);
    EXPECT_NEAR(total[2], scale * (0.7 * 4 * 4 + 0.4 * 25), 1e-12);
}

TEST(SpringNetworkTest, StrainPerFamily) {
    SpringNetwork network(test::swing(4, 100, 0), 0);
    std::vector<Vec3> x = network.rest_position;
    for (Vec3& at : x) at[1] *= 1.1;  // column springs + 10 %, rows 0, diagonals between
    const NetworkStrain stretch = network.strain(x, SpringFamily::stretch);
    EXPECT_EQ(stretch.count, 40u);
    EXPECT_NEAR(stretch.rms, 0.1 * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(stretch.max, 0.1, 1e-12);
    EXPECT_NEAR(stretch.min, 0.0, 1e-12);
    const NetworkStrain shear = network.strain(x, SpringFamily::shear);
    EXPECT_EQ(shear.count, 32u);
    EXPECT_NEAR(shear.rms, std::sqrt((1 + 1.21) / 2) - 1, 1e-12);
}

TEST(SpringNetworkTest, FingerprintTellsNetworksApart) {
    const SceneDescription scene = holed_sheet();
    const std::uint64_t same = SpringNetwork(scene, 0).fingerprint();
    EXPECT_EQ(SpringNetwork(scene, 0).fingerprint(), same);
    const auto changed = [&](auto change) {
        SpringNetwork network(scene, 0);
        change(network);
        return network.fingerprint();
    };
    EXPECT_NE(changed([](SpringNetwork& n) { n.springs[7].rest_length += 1e-15; }), same);
    EXPECT_NE(changed([](SpringNetwork& n) { n.damping = 0.1; }), same);
    EXPECT_NE(changed([](SpringNetwork& n) { n.pin_of[5] = 0; }), same);
    EXPECT_NE(changed([](SpringNetwork& n) { n.pins[0].release = 1.0; }), same);
    EXPECT_NE(changed([](SpringNetwork& n) { n.bending[0].stiffness *= 2; }), same);
    EXPECT_NE(changed([](SpringNetwork& n) { n.start_velocity[2] = 1; }), same);
    EXPECT_NE(changed([](SpringNetwork& n) { n.wind.gust.seed = 3; }), same);
}

TEST(SpringNetworkTest, FrequencyBoundHolds) {
    const SpringNetwork network(test::swing(8, 100, 0), 0);
    const Eigen::MatrixXd hessian = dense(network, network.rest_position, HessianForm::exact);
    Eigen::VectorXd masses(hessian.rows());
    for (Eigen::Index k = 0; k < masses.size(); ++k) masses[k] = network.mass[static_cast<std::size_t>(k) / 3];
    const Eigen::VectorXd scale = masses.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * hessian * scale.asDiagonal();
    const double highest = std::sqrt(
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
    std::printf("[ measured ] highest frequency %.1f rad/s, bound %.1f\n", highest, network.highest_frequency_bound());
    EXPECT_LE(highest, network.highest_frequency_bound());
    EXPECT_GE(highest, 0.5 * network.highest_frequency_bound());
}

}  // namespace
}  // namespace drape
