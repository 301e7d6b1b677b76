// One explicit micro-step feels the forces of the double-precision network: minus its energy's gradient.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/spring_network.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

/// Largest difference of a particle's force from the network's, relative to the largest force.
double force_error(const SceneDescription& scene) {
    const SimulationModel model(scene);
    EXPECT_TRUE(model.cloths[0].scheme.compromises.empty());
    Twin twin(model);
    TwinCloth& state = twin.cloth(0);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> noise(-0.02f, 0.02f);
    std::vector<Vec3> position;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        glsl::vec4& x = state[Field::position][i];
        x = {x.x + noise(random), x.y + noise(random), x.z + noise(random), x.w};
        state[Field::displacement][i] = {};
        position.push_back(test::position_of(state, i));
    }
    const SpringNetwork network(scene, 0);
    const std::vector<Vec3> gradient = network.gradient(position);
    twin.run_step(frame_steps(model)[0], frame_inputs(model, 1));
    const double h = model.cloths[0].substep_length;
    double largest = 0, worst = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
        if (!(state[Field::position][i].w > 0)) continue;
        const Vec3 moved = test::displacement_of(state, i);
        for (std::size_t k = 0; k < 3; ++k) {
            const double force = moved[k] * test::mass_of(model.cloths[0], i) / (h * h);
            largest = std::max(largest, std::abs(force));
            worst = std::max(worst, std::abs(force + gradient[i][k]));
        }
    }
    return worst / largest;
}

TEST(ExplicitNetworkTest, AStepFeelsTheNetworksForces) {
    SceneDescription scene = test::sheet(14, 11, 1.0, 0.6, 100);  // cells are not square
    scene.solver.method = SolverMethod::explicit_steps;
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_box(3, 0, 5, 1)};
    cloth.holes = {{{2, 3}, {5, 6}}, {{9, 7}, {13, 10}}, {{8, 3}, {9, 4}}};  // the last is one cell
    for (const Stiffness& stiffness :
         {Stiffness{false, 80, 0, 0}, Stiffness{false, 80, 30, 0}, Stiffness{false, 0, 0, 1e-2},
          Stiffness{false, 80, 30, 1e-2}, Stiffness{false, {80, 20}, 30, {1e-2, 2e-3, 5e-3}}}) {
        cloth.stiffness = stiffness;
        const double error = force_error(scene);
        std::printf("[ measured ] stretch %g, shear %g, bend %g: largest error of a force %.1e of the largest\n",
                    stiffness.stretch.warp, stiffness.shear, stiffness.bend.warp, error);
        EXPECT_LE(error, 1e-5);
    }
}

TEST(ExplicitNetworkTest, AStepFeelsTheNetworksForcesWhereTheClothRestsAsItStarts) {
    SceneDescription scene = test::sheet(14, 11, 1.0, 0.6, 100);
    scene.solver.method = SolverMethod::explicit_steps;
    Cloth& cloth = scene.cloths[0];
    for (int row = 0; row < 11; ++row)
        for (int column = 0; column < 14; ++column)
            cloth.start.push_back({0.08 * column, 0.1 * std::sin(0.8 * column + 0.3 * row), 0.05 * row});
    cloth.rest = Rest::start;
    cloth.holes = {{{9, 7}, {13, 10}}};
    cloth.stiffness = {false, 80, 30, 0};
    EXPECT_LE(force_error(scene), 1e-5);
    const SpringNetwork network(scene, 0);
    EXPECT_LE(network.spring_energy(cloth.start), 1e-20);
}

/// Cells are up to ten times as stiff and five times as heavy as others.
TEST(ExplicitNetworkTest, AStepFeelsTheNetworksForcesWhereCellsDiffer) {
    SceneDescription scene = test::sheet(14, 11, 1.0, 0.6, 100);
    scene.solver.method = SolverMethod::explicit_steps;
    Cloth& cloth = scene.cloths[0];
    cloth.pins = {test::pin_box(3, 0, 5, 1)};
    cloth.holes = {{{9, 7}, {13, 10}}};
    std::mt19937 random(5);
    for (int cell = 0; cell < 13 * 10; ++cell) {
        cloth.cell_stiffness.push_back(std::uniform_real_distribution<float>(0.1f, 1)(random));
        cloth.cell_density.push_back(std::uniform_real_distribution<float>(1, 5)(random));
    }
    for (const Stiffness& stiffness : {Stiffness{false, 80, 30, 0}, Stiffness{false, 0, 0, 1e-2},
                                       Stiffness{false, {80, 20}, 30, {1e-2, 2e-3, 5e-3}}}) {
        cloth.stiffness = stiffness;
        EXPECT_LE(force_error(scene), 1e-5);
    }
    double heavy = 0;
    for (const double mass : SpringNetwork(scene, 0).mass) heavy += mass;
    double expected = 0;
    for (int cell = 0; cell < 13 * 10; ++cell)
        if (cell / 13 < 7 || cell % 13 < 9) expected += double{cloth.cell_density[static_cast<std::size_t>(cell)]};
    EXPECT_NEAR(heavy, expected * cloth.areal_density * (1.0 / 13) * (0.6 / 10), 1e-9);
}

}  // namespace
}  // namespace drape
