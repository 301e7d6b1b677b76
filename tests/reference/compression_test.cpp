// Springs that are pushed together act by a share of their stiffness (`stiffness.compression`): in the projection, in
// the double-precision network (against closed forms), and in every method (against that network).
#include <gtest/gtest.h>

#include <cmath>

#include "network_scenes.h"
#include "reference/symplectic_reference.h"
#include "support/sheet_state.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

TEST(Compression, TheProjectionIsThatOfASofterSpring) {
    using namespace glsl;
    const float compliance = 0.7f, share = 0.25f;
    const SpringResult pushed = project_spring({0.9f, 0, 0}, 2.0f, 1.0f, 1.0f, share, compliance, 0.0f);
    const SpringResult softer = project_spring({0.9f, 0, 0}, 2.0f, 1.0f, share, 1.0f, compliance, 0.0f);
    EXPECT_EQ(pushed.correction.x, softer.correction.x);
    EXPECT_EQ(pushed.tension, share * softer.tension) << "of the whole stiffness, of which a quarter acts";
    const SpringResult pulled = project_spring({1.1f, 0, 0}, 2.0f, 1.0f, 1.0f, share, compliance, 0.0f);
    const SpringResult whole = project_spring({1.1f, 0, 0}, 2.0f, 1.0f, 1.0f, 1.0f, compliance, 0.0f);
    EXPECT_EQ(pulled.correction.x, whole.correction.x);
}

/// The sheet hangs upwards from its top row: it stands on its head within its plane, which it cannot leave.
SceneDescription standing(double compression) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, 1);
    scene.gravity = {0, 9.81, 0};
    Cloth& cloth = scene.cloths[0];
    model_scenes::set_wave_speed(cloth, 60);
    cloth.stiffness.compression = compression;
    cloth.damping = 2;
    cloth.pins = {test::pin_top(cloth)};
    return scene;
}

TEST(Compression, AChainPushesByItsShare) {
    // Twenty links are pushed together by a tenth: each end is pushed by compression k l/10, with the energy of that
    // share.
    SpringNetwork network = test::chain(20, 1, 1, 500, {1, 0, 0});
    network.gravity = {0, 0, 0};
    for (NetworkSpring& spring : network.springs) spring.compression = 0.2;
    std::vector<Vec3> x = network.rest_position;
    for (Vec3& at : x) at[0] *= 0.9;
    const std::vector<Vec3> gradient = network.gradient(x);
    EXPECT_NEAR(gradient.front()[0], 0.2 * 500 * 0.1, 1e-9);
    EXPECT_NEAR(gradient.back()[0], -0.2 * 500 * 0.1, 1e-9);
    EXPECT_NEAR(network.spring_energy(x), 0.5 * 0.2 * 500 * 0.1 * 0.1, 1e-9);
    for (Vec3& at : x) at[0] /= 0.9 * 0.9;
    EXPECT_NEAR(network.gradient(x).back()[0], 500 * (1 / 0.9 - 1), 1e-6);
}

/// Returns the RMS distance (m) of a method from the reference after a quarter of a second.
double standing_error(SolverMethod method, std::uint32_t substeps, const ReferenceRun& reference, double compression) {
    SceneDescription scene = standing(compression);
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 15; ++frame) twin.run_frame(frame);
    std::vector<Vec3> at;
    for (std::size_t i = 0; i < reference.states[0].position.size(); ++i)
        at.push_back(test::position_of(twin.cloth(0), i));
    return position_rms(at, reference.states[0].position);
}

TEST(Compression, EveryMethodStandsAsTheNetworkDoes) {
    const double times[] = {0.25}, compression = 0.1;
    const SpringNetwork network(standing(compression), 0), full(standing(1), 0);
    const ReferenceRun reference = run_symplectic(network, times, {.cfl = 0.1});
    ASSERT_LE(reference.worst_error(), 1e-6);
    const double given = position_rms(reference.states[0].position, network.rest_position),
                 at_full =
                     position_rms(run_symplectic(full, times, {.cfl = 0.1}).states[0].position, full.rest_position);
    EXPECT_GT(given, 5 * at_full) << "it gives way as it does not at its whole stiffness";
    const double line[] = {standing_error(SolverMethod::line, 10, reference, compression),
                           standing_error(SolverMethod::line, 40, reference, compression)},
                 relax = standing_error(SolverMethod::relax, 320, reference, compression),
                 micro_steps = standing_error(SolverMethod::explicit_steps, 80, reference, compression);
    std::printf(
        "[ measured ] standing sheet, compression 0.1: gives way by %.2e m (%.2e at 1); error of line %.2e and %.2e "
        "(10, 40 substeps), relax %.2e (320), explicit %.2e m (80)\n",
        given, at_full, line[0], line[1], relax, micro_steps);
    EXPECT_LE(line[0], 0.1 * given);
    EXPECT_LE(line[1], 0.3 * line[0]);
    EXPECT_LE(relax, 0.1 * given);
    EXPECT_LE(micro_steps, 0.01 * given);
}

/// The sheet is held by an edge and let go where it slopes, without wind, so nothing gives it energy.
SceneDescription swinging(SolverMethod method, std::uint32_t substeps, std::uint32_t iterations, double compression) {
    SceneDescription scene = test::sheet(13, 9, 0.6, 0.4, substeps);
    Cloth& cloth = scene.cloths[0];
    cloth.placement.v = {0, -0.8, 0.6};
    cloth.stiffness = {.stretch = 1000, .shear = 100, .bend = 0, .compression = compression};
    cloth.damping = 1;
    cloth.pins = {test::pin_top(cloth)};
    scene.solver.method = method;
    scene.solver.iterations = iterations;
    return scene;
}

/// Returns the most energy (J) that the sheet comes to within a second, over that at the start.
double energy_gained(const SceneDescription& scene) {
    const SimulationModel model(scene);
    const SpringNetwork network(scene, 0);
    const double rate = scene.time.fps * scene.solver.substeps;
    Twin twin(model);
    double first = 0, most = 0;
    for (std::uint32_t frame = 0; frame <= 60; ++frame) {
        if (frame > 0) twin.run_frame(frame);
        std::vector<Vec3> at;
        double kinetic = 0;
        for (std::size_t i = 0; i < network.rest_position.size(); ++i) {
            at.push_back(test::position_of(twin.cloth(0), i));
            const glsl::vec4 moved = twin.cloth(0)[Field::displacement][i];
            if (frame > 0)
                kinetic += 0.5 * network.mass[i] * rate * rate *
                           (double{moved.x} * moved.x + double{moved.y} * moved.y + double{moved.z} * moved.z);
        }
        const double energy = network.potential_energy(at) + kinetic;
        if (frame == 0) first = energy;
        most = std::max(most, energy - first);
    }
    return most;
}

// A spring's tension means the same on both sides of its rest length: the next projection takes back what was too much.
// Where it is taken for that of the spring's stiffness pushed together, a sheet explodes (35 J, by 80 substeps of
// `line` at 0.03).
TEST(Compression, ASpringThatSnapsIsSolvedAsItIs) {
    using namespace glsl;
    const float compliance = 0.5f, share = 0.125f, carried = 0.25f;  // m
    const SpringResult slack = project_spring({0.5f, 0, 0}, 2.0f, 1.0f, 1.0f, share, compliance, carried);
    const float length = 0.5f + 2 * slack.correction.x;
    EXPECT_NEAR(slack.tension, share * (length - 1), 1e-6f) << "what balances it where it is now";
    const SpringResult taut = project_spring({1.5f, 0, 0}, 2.0f, 1.0f, 1.0f, share, compliance, -0.0625f);
    EXPECT_NEAR(taut.tension, 0.5f + 2 * taut.correction.x, 1e-6f);
}

TEST(Compression, ASheetThatSwingsGainsNoEnergy) {
    const double scale = 0.2 * 0.6 * 0.4 * 9.81 * 0.4;  // J, energy of a fall by the sheet's height
    for (const double compression : {0.1, 0.03, 0.001})
        for (const std::uint32_t substeps : {10u, 20u, 80u})
            for (const std::uint32_t iterations : {1u, 3u}) {
                const double gained = energy_gained(swinging(SolverMethod::line, substeps, iterations, compression));
                EXPECT_LT(gained, 0.01 * scale)
                    << compression << ", " << substeps << " substeps, " << iterations << " iterations";
            }
    for (const double compression : {0.1, 0.001})
        EXPECT_LT(energy_gained(swinging(SolverMethod::relax, 20, 8, compression)), 0.01 * scale) << compression;
}

}  // namespace
}  // namespace drape
