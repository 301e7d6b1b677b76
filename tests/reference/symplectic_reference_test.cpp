// Reference (a) agrees with closed forms and has its order.
#include "reference/symplectic_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "network_scenes.h"
#include "reference/closed_forms.h"
#include "reference/implicit_reference.h"

namespace drape {
namespace {

TEST(SymplecticReferenceTest, FreeFlightIsExactAtEveryStep) {
    for (const double damping : {0.0, 0.7}) {
        SceneDescription scene = test::sheet(4, 4, 0.3, 0.3, 1);
        scene.cloths[0].damping = damping;
        scene.cloths[0].stiffness = {false, 1, 0.1, 0};  // stable at both steps
        scene.cloths[0].velocity = {3, 1, -7};
        const SpringNetwork network(scene, 0);
        const double times[] = {0.0, 0.5, 10.0};
        for (const double step : {1e-3, 0.01}) {  // springs at rest exert nothing
            const std::vector<NetworkState> states = symplectic_states(network, times, step);
            for (std::size_t t = 0; t < 3; ++t)
                for (std::size_t k = 0; k < 3; ++k) {
                    const double v0 = scene.cloths[0].velocity[k], a = scene.gravity[k];
                    const double expected = closed_forms::flight_displacement(v0, a, damping, times[t]);
                    EXPECT_NEAR(states[t].position[9][k] - network.rest_position[9][k], expected, 1e-9);
                    const double velocity = closed_forms::flight_velocity(v0, a, damping, times[t]);
                    EXPECT_NEAR(states[t].velocity[9][k], velocity, 1e-9);
                }
        }
    }
}

/// Returns places of a spring pendulum released from the horizontal, at quarters of the rigid one's first two periods.
std::vector<Vec3> pendulum_places(std::span<const double> times, double stiffness_over_weight) {
    const SpringNetwork network = test::chain(1, 1, 2, stiffness_over_weight * 9.81, {1, 0, 0});
    const ReferenceRun run = run_symplectic(network, times);
    EXPECT_LT(run.worst_error(), 1e-5);
    std::vector<Vec3> places;
    for (const NetworkState& state : run.states) places.push_back(state.position[1]);
    return places;
}

TEST(SymplecticReferenceTest, PendulumOfAStifferAndStifferSpring) {
    const double right_angle = std::numbers::pi / 2, period = closed_forms::pendulum_period(1, 9.81, right_angle);
    std::vector<double> times;
    std::vector<Vec3> exact, limit;
    for (int k = 1; k <= 8; ++k) {
        times.push_back(period * k / 4 + 0.05);
        const double angle = closed_forms::pendulum_angle(1, 9.81, right_angle, times.back());
        exact.push_back({std::sin(angle), -std::cos(angle), 0});
    }
    const std::vector<Vec3> soft = pendulum_places(times, 1e4), stiff = pendulum_places(times, 1e5);
    for (std::size_t t = 0; t < times.size(); ++t)  // removes the part linear in 1/k
        limit.push_back({(10 * stiff[t][0] - soft[t][0]) / 9, (10 * stiff[t][1] - soft[t][1]) / 9, 0});
    std::printf("[ measured ] RMS distance from the rigid pendulum: %.3e m at k = 1e4 mg/L, %.3e at 1e5, limit %.1e\n",
                position_rms(soft, exact), position_rms(stiff, exact), position_rms(limit, exact));
    EXPECT_NEAR(position_rms(soft, exact) / position_rms(stiff, exact), 10, 0.5);
    EXPECT_LT(position_rms(limit, exact), 1e-5);
}

TEST(SymplecticReferenceTest, FirstModeOfAHangingChainSwingsAtItsFrequency) {
    std::vector<double> links, errors;
    for (const std::uint32_t count : {8u, 16u, 32u}) {
        const SpringNetwork at_rest = test::chain(count, 1, 1, 1e5, {0, -1, 0});
        SpringNetwork network = at_rest;
        network.rest_position = find_equilibrium(at_rest).position;
        const double amplitude = 1e-5, omega = closed_forms::hanging_chain_frequency(1, 1, 9.81);
        for (Vec3& x : network.rest_position) x[2] += amplitude * closed_forms::hanging_chain_shape(1, 1, 1 + x[1]);
        // The free end crosses the middle at a quarter period: z there, over its speed, is the error in phase.
        const double quarter[] = {std::numbers::pi / 2 / omega};
        const NetworkState state = symplectic_states(network, quarter, symplectic_step(network))[0];
        links.push_back(count);
        errors.push_back(std::abs(state.position[count][2]) / amplitude);
    }
    std::printf("[ measured ] phase error after a quarter period, N = 8 16 32: %.3e %.3e %.3e\n", errors[0], errors[1],
                errors[2]);
    EXPECT_NEAR(-test::least_order(links, errors), 2, 0.3);
}

TEST(SymplecticReferenceTest, SecondOrderInTheStepWithAndWithoutDamping) {
    for (const double damping : {0.0, 2.0}) {
        SceneDescription scene = test::swing(8, 10, 30);
        scene.cloths[0].damping = damping;
        const SpringNetwork network(scene, 0);
        const double times[] = {0.3};
        const double step = symplectic_step(network, {.cfl = 0.2});
        const auto position = [&](double h) { return symplectic_states(network, times, h)[0].position; };
        const std::vector<Vec3> exact = position(step / 64);
        std::vector<double> steps, errors;
        for (const double h : {step, step / 2, step / 4, step / 8}) {
            steps.push_back(h);
            errors.push_back(position_rms(position(h), exact));
        }
        std::printf("[ measured ] damping %.0f: errors %.3e %.3e %.3e %.3e m\n", damping, errors[0], errors[1],
                    errors[2], errors[3]);
        EXPECT_GT(test::least_order(steps, errors), 1.9);
    }
}

TEST(SymplecticReferenceTest, EstimatesItsOwnError) {
    const SpringNetwork network(test::swing(8, 10, 30), 0);
    const double times[] = {0.1, 0.3};
    const ReferenceRun run = run_symplectic(network, times, {.cfl = 0.1});
    const std::vector<NetworkState> exact = symplectic_states(network, times, run.step / 40);
    for (std::size_t t = 0; t < 2; ++t) {
        const double error = position_rms(run.states[t].position, exact[t].position);
        std::printf("[ measured ] error %.3e m, estimate %.3e, observed order %.2f\n", error, run.error_estimate[t],
                    run.observed_order[t]);
        EXPECT_LT(error, 1.1 * run.error_estimate[t]);
        EXPECT_GT(error, 0.3 * run.error_estimate[t]);
    }
}

TEST(SymplecticReferenceTest, KeepsTheEnergyOfASwing) {
    const SpringNetwork network(test::swing(16, 30, 30), 0);
    std::vector<double> times;
    for (int k = 0; k <= 100; ++k) times.push_back(0.02 * k);
    std::vector<double> drifts;
    for (const double cfl : {0.2, 0.1}) {
        const auto states = symplectic_states(network, times, symplectic_step(network, {.cfl = cfl}));
        const auto energy = [&](const NetworkState& s) {
            return network.kinetic_energy(s.velocity) + network.potential_energy(s.position);
        };
        double drift = 0, swing = 0;
        for (const NetworkState& state : states) {
            drift = std::max(drift, std::abs(energy(state) - energy(states[0])));
            swing = std::max(swing, network.kinetic_energy(state.velocity));
        }
        drifts.push_back(drift / swing);
    }
    std::printf("[ measured ] energy error over 2 s / kinetic energy: %.2e at cfl 0.2, %.2e at 0.1\n", drifts[0],
                drifts[1]);
    EXPECT_LT(drifts[1], 1e-4);
    EXPECT_GT(drifts[0] / drifts[1], 3);  // the drift is bounded, of second order
}

TEST(SymplecticReferenceTest, PinsMoveAndLetGo) {
    SceneDescription scene = test::swing(4, 10, 0);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.stretch = cloth.stiffness.shear = 0;
    Pin all = test::pin_box(0, 0, 4, 4);
    all.path.keys = {{0, {0, 0, 0}, {}}, {0.5, {0.3, 0, 0}, {}}, {1, {0.6, 0, 0}, {}}};
    all.release = 0.5;
    cloth.pins = {all};
    const SpringNetwork network(scene, 0);
    const double times[] = {0.25, 0.8};
    const std::vector<NetworkState> states = symplectic_states(network, times, 1e-3);
    for (std::size_t p = 0; p < network.particle_count(); ++p) {
        EXPECT_NEAR(states[0].position[p][0] - network.rest_position[p][0], 0.15 - 0.0375, 1e-12);  // Hermite at 1/2
        // The particle is released at the path's speed there, 0.6 m/s, and flies.
        EXPECT_NEAR(states[1].position[p][0] - network.rest_position[p][0], 0.3 + 0.6 * 0.3, 1e-8);
        EXPECT_NEAR(states[1].position[p][1] - network.rest_position[p][1], -0.5 * 9.81 * 0.09, 1e-8);
    }
}

TEST(SymplecticReferenceTest, SecondOrderInWind) {
    // The run is too short for any triangle to turn edge-on, where the lift jumps and every method is of first order.
    SceneDescription scene = test::swing(6, 10, 0);
    scene.wind.velocity = {0.5, 0, 4};
    scene.wind.gust = {1, 0.4, 7};
    const SpringNetwork network(scene, 0);
    const double times[] = {0.1};
    const double step = symplectic_step(network, {.cfl = 0.2});
    const auto position = [&](double h) { return symplectic_states(network, times, h)[0].position; };
    const std::vector<Vec3> exact = position(step / 32);
    std::vector<double> steps, errors;
    for (const double h : {step, step / 2, step / 4}) {
        steps.push_back(h);
        errors.push_back(position_rms(position(h), exact));
    }
    std::printf("[ measured ] wind: errors %.3e %.3e %.3e m\n", errors[0], errors[1], errors[2]);
    EXPECT_GT(test::least_order(steps, errors), 1.85);
}

TEST(SymplecticReferenceTest, RefusesNonsense) {
    const SpringNetwork network(test::swing(4, 10, 0), 0);
    const double unordered[] = {0.2, 0.1}, fine[] = {0.1};
    EXPECT_THROW(run_symplectic(network, unordered), std::invalid_argument);
    EXPECT_THROW(run_symplectic(network, fine, {.cfl = 0.5}), std::invalid_argument);
    EXPECT_THROW(symplectic_states(network, std::vector<double>{30.0}, 0.05), std::runtime_error);  // beyond the limit
}

}  // namespace
}  // namespace drape
