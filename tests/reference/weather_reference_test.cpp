// Under gravity that changes, cloth flies as the integral of it says, on the twin and by both references; and the twin
// comes to the reference's motion in a wind and gravity that change.
#include <gtest/gtest.h>

#include <cmath>

#include "network_scenes.h"
#include "reference/implicit_reference.h"
#include "reference/symplectic_reference.h"
#include "twin/twin.h"

namespace drape {
namespace {

const std::vector<VectorKey> tilting{{0.2, {0, -9.81, 0}}, {1, {8, -1, 3}}};

/// Returns the way by tilting gravity alone in `time` >= 1 s: gravity is even up to 0.2 s, then goes to its end by 1 s.
Vec3 fallen(double time) {
    Vec3 way;
    for (std::size_t k = 0; k < 3; ++k) {
        const double from = tilting[0].value[k], to = tilting[1].value[k], span = 0.8, after = time - 1;
        const double speed = from * 0.2 + 0.5 * (from + to) * span;
        const double tilted = from * span * span / 3 + to * span * span / 6 + 0.2 * from * span;
        way[k] = 0.5 * from * 0.2 * 0.2 + tilted + speed * after + 0.5 * to * after * after;
    }
    return way;
}

SceneDescription flying(std::uint32_t substeps) {
    SceneDescription scene = test::sheet(4, 4, 0.3, 0.3, substeps);
    scene.cloths[0].stiffness = {false, 1, 0.1, 0};
    scene.gravity_keys = tilting;
    return scene;
}

TEST(WeatherReferenceTest, BothReferencesFlyAsGravitySays) {
    const SpringNetwork network(flying(1), 0);
    const double times[] = {1.5};
    const Vec3 way = fallen(1.5);
    const auto error = [&](const NetworkState& state) {
        double most = 0;
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, std::abs(state.position[5][k] - network.rest_position[5][k] - way[k]));
        return most;
    };
    EXPECT_LT(error(symplectic_states(network, times, 1e-3)[0]), 1e-5);
    EXPECT_LT(error(implicit_states(network, times, 1e-3)[0]), 1e-5);
    EXPECT_NE(network.fingerprint(), SpringNetwork(test::sheet(4, 4, 0.3, 0.3, 1), 0).fingerprint());
    EXPECT_THROW(find_equilibrium(network), std::invalid_argument) << "nothing is at rest";
}

/// A substep takes gravity at its middle, so that it comes half a substep too early or, in second order, too late.
TEST(WeatherReferenceTest, EveryMethodFliesAsGravitySaysHalfASubstepOff) {
    const Vec3 way = fallen(1.5);
    double gained = 0;  // m/s that gravity's change gives by then
    for (std::size_t k = 0; k < 3; ++k) {
        const double from = tilting[0].value[k], to = tilting[1].value[k];
        gained = std::hypot(gained, (to - from) * (0.5 * 0.8 + 0.5));
    }
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line})
        for (const std::uint32_t substeps : {4u, 32u}) {
            SceneDescription scene = flying(substeps);
            scene.solver.method = method;
            const SimulationModel model(scene);
            Twin twin(model);
            for (std::uint32_t frame = 1; frame <= 90; ++frame) twin.run_frame(frame);
            const glsl::vec4 from = model.cloths[0].position[5], to = twin.cloth(0)[Field::position][5];
            const double error =
                std::hypot(double(to.x) - double(from.x) - way[0], double(to.y) - double(from.y) - way[1],
                           double(to.z) - double(from.z) - way[2]);
            const double expected = 0.5 / (scene.time.fps * substeps) * gained;
            std::printf("[ measured ] %s, %u substeps: off by %.2e m of %.2f m, half a substep is %.2e m\n",
                        std::string(model.method().name).c_str(), substeps, error, std::hypot(way[0], way[1], way[2]),
                        expected);
            EXPECT_NEAR(error, expected, 0.05 * expected) << substeps;
        }
}

/// A sheet held by its upper edge, in wind that turns and gravity that tilts.
TEST(WeatherReferenceTest, TheTwinComesToTheReference) {
    SceneDescription scene = test::sheet(9, 9, 0.5, 0.5, 1);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cloths[0].stiffness = {false, 100, 20, 0};
    scene.cloths[0].damping = 1;
    scene.gravity_keys = {{0, {0, -9.81, 0}}, {0.3, {0, -7, 4}}};
    scene.wind.keys = {{0, {0, 0, 0}}, {0.2, {0, 0, 3}}, {0.4, {1, 0, 0}}};
    scene.solver.method = SolverMethod::explicit_steps;
    const double times[] = {0.5};
    const std::vector<Vec3> exact = run_symplectic(SpringNetwork(scene, 0), times).states[0].position;
    double errors[2];
    for (const bool fine : {false, true}) {
        scene.solver.substeps = fine ? 64 : 16;
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
        std::vector<Vec3> reached;
        for (const glsl::vec4& at : twin.cloth(0)[Field::position]) reached.push_back({at.x, at.y, at.z});
        errors[fine] = position_rms(reached, exact);
    }
    std::printf("[ measured ] off by %.2e m RMS at 16 substeps, %.2e at 64\n", errors[0], errors[1]);
    EXPECT_LT(errors[1], 1e-3);
    EXPECT_LT(errors[1], 0.5 * errors[0]);
}

}  // namespace
}  // namespace drape
