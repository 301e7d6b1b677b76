// Reference (b) has its order in time, and agrees with (a), with which it shares only the model.
#include "reference/implicit_reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "network_scenes.h"
#include "reference/symplectic_reference.h"

namespace drape {
namespace {

void expect_agreement(const SpringNetwork& network, std::span<const double> times, double cfl, double step) {
    const ReferenceRun a = run_symplectic(network, times, {.cfl = cfl});
    const ReferenceRun b = run_implicit(network, times, {.step = step});
    for (std::size_t t = 0; t < times.size(); ++t) {
        const double apart = position_rms(a.states[t].position, b.states[t].position);
        std::printf("[ measured ] t = %.2f s: apart %.2e m; estimates %.2e (a, order %.2f), %.2e (b, order %.2f)\n",
                    times[t], apart, a.error_estimate[t], a.observed_order[t], b.error_estimate[t],
                    b.observed_order[t]);
        EXPECT_LT(apart, a.error_estimate[t] + b.error_estimate[t]);
        EXPECT_LT(apart, 1e-4);
    }
}

TEST(ImplicitReferenceTest, AgreesWithTheSymplecticOneOnASwing) {
    const double times[] = {0.25, 0.5};
    expect_agreement(SpringNetwork(test::swing(16, 20, 30), 0), times, 0.1, 2.5e-4);
}

TEST(ImplicitReferenceTest, AgreesWithTheSymplecticOneUnderEveryForce) {
    SceneDescription scene = test::swing(6, 8, 20);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.bend = 1e-3;
    cloth.damping = 0.8;
    cloth.velocity = {0.2, 0, 0};
    cloth.holes = {{{2, 2}, {4, 4}}};
    Pin moved = test::pin_box(0, 0, 3, 0), released = test::pin_box(4, 0, 6, 0);
    moved.path.keys = {{0, {0, 0, 0}, {}}, {0.4, {0.1, 0.05, -0.1}, {0, 20, 10}}};
    released.release = 0.1;
    cloth.pins = {moved, released};
    scene.wind.velocity = {1, 0, 4};
    scene.wind.gust = {1, 0.5, 3};
    scene.wind.lift = 0;  // with lift the law jumps where a triangle turns edge-on
    const double times[] = {0.1, 0.3};
    expect_agreement(SpringNetwork(scene, 0), times, 0.1, 5e-4);
}

TEST(ImplicitReferenceTest, SecondOrderInTheStep) {
    const SpringNetwork network(test::swing(6, 8, 30), 0);
    const double times[] = {0.3};
    const auto position = [&](double h) { return implicit_states(network, times, h)[0].position; };
    const std::vector<Vec3> exact = position(6.25e-5);
    const std::vector<double> steps{2e-3, 1e-3, 5e-4};
    std::vector<double> errors;
    for (const double h : steps) errors.push_back(position_rms(position(h), exact));
    std::printf("[ measured ] implicit midpoint errors %.3e %.3e %.3e m\n", errors[0], errors[1], errors[2]);
    EXPECT_GT(test::least_order(steps, errors), 1.85);
}

TEST(ImplicitReferenceTest, StatesAreWhereTheyWereAskedFor) {
    const SpringNetwork network(test::swing(4, 8, 30), 0);
    const double times[] = {0.0, 0.1};
    const std::vector<NetworkState> states = implicit_states(network, times, 1e-2);
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].position, network.rest_position);
    EXPECT_NE(states[1].position, network.rest_position);
}

}  // namespace
}  // namespace drape
