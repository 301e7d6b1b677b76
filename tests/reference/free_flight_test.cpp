// Free fall and ballistic flight, damped and undamped, agree with the closed form after 10 s.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "control/watch.h"
#include "support/sheets.h"
#include "twin/statistics.h"
#include "twin/twin.h"

namespace drape {
namespace {

/// Distance covered in `time`: v0 t + g t^2/2, or with damping c: v_inf t + (v0 - v_inf)(1 - e^(-c t))/c.
double flight(double v0, double g, double c, double time) {
    if (c == 0) return v0 * time + 0.5 * g * time * time;
    const double v_inf = g / c;
    return v_inf * time - (v0 - v_inf) * std::expm1(-c * time) / c;
}

class FreeFlight : public testing::TestWithParam<std::tuple<SolverMethod, std::uint32_t, double>> {};

TEST_P(FreeFlight, FollowsTheClosedForm) {
    const auto [method, substeps, damping] = GetParam();
    SceneDescription scene = test::sheet(4, 3, 0.3, 0.2, substeps);
    scene.solver.method = method;
    scene.cloths[0].damping = damping;
    scene.cloths[0].velocity = {3, 0, -7};
    const SimulationModel model(scene);
    Twin twin(model);
    const std::uint32_t frames = 600;
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    // Line solves round more.
    const double limit = substeps > 16 ? 1e-4 : method == SolverMethod::line ? 2e-5 : 1e-5;
    double worst = 0;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
        const glsl::vec4 start = model.cloths[0].position[i], end = twin.cloth(0)[Field::position][i];
        const double moved[3] = {double(end.x) - double(start.x), double(end.y) - double(start.y),
                                 double(end.z) - double(start.z)};
        for (std::size_t k = 0; k < 3; ++k) {
            const double expected = flight(scene.cloths[0].velocity[k], scene.gravity[k], damping, 10.0);
            worst = std::max(worst, std::abs(moved[k] - expected) / std::abs(expected));
        }
    }
    std::printf("[ measured ] %s, %u substeps, damping %.1f: worst relative error %.2e (limit %.0e)\n",
                std::string(model.method().name).c_str(), substeps, damping, worst, limit);
    EXPECT_LE(worst, limit);
}

INSTANTIATE_TEST_SUITE_P(MethodsSubstepsAndDamping, FreeFlight,
                         testing::Combine(testing::Values(SolverMethod::relax, SolverMethod::explicit_steps,
                                                          SolverMethod::line),
                                          testing::Values(1u, 16u, 256u), testing::Values(0.0, 0.5)));

/// Returns the worst of a flight of 5 frames beyond what single precision and a first substep that keeps 1/128 of a
/// velocity explain, as a ratio; at most 1 is right. What the watch finds implausible is infinitely wrong.
double overdamped_error(SceneDescription scene, const Vec3& velocity) {
    scene.cloths[0].velocity = velocity;
    const double damping = scene.cloths[0].damping;
    const SimulationModel model(scene);
    Twin twin(model);
    Watch watch(model);
    double worst = 0;
    for (std::uint32_t frame = 0; frame <= 5; ++frame) {
        if (frame > 0) twin.run_frame(frame);
        if (model.cloths[0].scheme.gathered_tension) twin.tension(0);
        const glsl::StatisticsRecord record = twin_statistics(model, 0, twin.cloth(0), frame_inputs(model, frame));
        if (watch.implausible(frame, {cloth_statistics(model, model.cloths[0], record, frame)})) return INFINITY;
        const glsl::vec4 start = model.cloths[0].position[4], end = twin.cloth(0)[Field::position][4];
        const double moved[3] = {double(end.x) - double(start.x), double(end.y) - double(start.y),
                                 double(end.z) - double(start.z)};
        for (std::size_t k = 0; k < 3; ++k) {
            const double beside = std::abs(velocity[k] - scene.gravity[k] / damping) / damping,
                         expected = flight(velocity[k], scene.gravity[k], damping, frame / scene.time.fps),
                         allowed = beside / 120 + 1e-5 * std::abs(expected) + 1e-7;
            worst = std::max(worst, std::abs(moved[k] - expected) / allowed);
        }
    }
    return worst;
}

TEST(FreeFlight, OverdampedClothFollowsTheClosedForm) {
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps})
        for (const std::uint32_t substeps : {1u, 4u, 20u})
            for (const double exponent :
                 {4.0, 4.8, 4.9, 6.0, 9.0, 13.0, 17.0, 30.0, 41.0, 50.0, 250.0, 5e4, 1e20, 1e28}) {
                SceneDescription scene = test::sheet(4, 3, 0.3, 0.2, substeps);
                scene.solver.method = method;
                scene.cloths[0].damping = exponent * substeps * scene.time.fps;
                EXPECT_LE(overdamped_error(scene, {}), 1) << "c h = " << exponent << ", " << substeps << " substeps";
                if (substeps == 1) continue;
                EXPECT_LE(overdamped_error(scene, {3, 0, -7}), 1) << "c h = " << exponent << ", thrown";
            }
}

TEST(FreeFlight, DampingOfAnyStrengthIsBounded) {
    for (const double damping : {30.0, 59.0, 61.0, 180.0, 1000.0}) {
        SceneDescription scene = test::sheet(3, 3, 1, 1, 1);
        scene.solver.method = SolverMethod::line;
        scene.cloths[0].damping = damping;
        scene.cloths[0].velocity = {1, 2, 3};
        scene.cloths[0].pins.clear();
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
        const double fallen = model.cloths[0].position[0].y - twin.cloth(0)[Field::position][0].y;
        const double speed = -std::expm1(-damping) / damping;
        EXPECT_NEAR(fallen, 9.81 / damping * (1 - speed) - 2 * speed, 0.05) << damping;
    }
}

}  // namespace
}  // namespace drape
