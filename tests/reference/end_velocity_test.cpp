// The velocity at a frame's end (shaders/include/end_velocity.h) is that of free flight wherever nothing touches, and
// what has just been stopped is not taken to rebound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/vectors.h"
#include "cloth/simulation_model.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

class EndVelocity : public testing::TestWithParam<SolverMethod> {};

/// Displacement (m) that a substep would have at the velocity of a frame's end.
Vec3 end_motion(const Twin& twin, std::size_t cloth, std::size_t particle) {
    const glsl::vec4 &d = twin.cloth(cloth)[Field::displacement][particle],
                     &e = twin.cloth(cloth)[Field::end_excess][particle];
    return {d.x + e.x, d.y + e.y, d.z + e.z};
}

std::vector<Vec3> end_motions(const Twin& twin, const SimulationModel& model) {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) all.push_back(end_motion(twin, 0, i));
    return all;
}

/// A crumpled sheet that turns as it flies.
SceneDescription thrown(SolverMethod method) {
    SceneDescription scene = test::sheet(9, 9, 0.4, 0.4, method == SolverMethod::explicit_steps ? 40 : 2);
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.pins.clear();
    cloth.stiffness = {false, 500, 30, 1e-4};
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 9; ++column) {
            const double x = 0.05 * column, z = 0.05 * row;
            cloth.start.push_back({x, 0.03 * std::sin(9 * x) + 0.1 * z, z});
            cloth.velocities.push_back({std::cos(9 * z), 2 * x, -std::sin(7 * x)});
        }
    return scene;
}

/// A flat sheet stands still at the end of frame 6, a tenth of a second after it was thrown up.
SceneDescription thrown_up(SolverMethod method) {
    SceneDescription scene = thrown(method);
    Cloth& cloth = scene.cloths[0];
    cloth.start.clear();
    cloth.velocities.clear();
    cloth.placement = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.velocity = {0, 0.981, 0};
    return scene;
}

/// Runs a scene alone, with a ball far away, and with cloth that could meet itself.
void expect_same_velocities(const SceneDescription& free) {
    SceneDescription beside_a_ball = free, meets_itself = free;
    beside_a_ball.colliders.push_back({Sphere{{0, -100, 0}, 0.1}});
    meets_itself.cloths[0].self_collision = SelfCollision{0.002, {}};
    const SimulationModel model(free), with_ball(beside_a_ball), with_itself(meets_itself);
    Twin twin(model), twin_with_ball(with_ball), twin_with_itself(with_itself);
    for (std::uint32_t frame = 1; frame <= 8; ++frame) {
        for (Twin* each : {&twin, &twin_with_ball, &twin_with_itself}) each->run_frame(frame);
        const std::vector<Vec3> expected = end_motions(twin, model);
        EXPECT_EQ(end_motions(twin_with_ball, with_ball), expected) << frame;
        EXPECT_EQ(end_motions(twin_with_itself, with_itself), expected) << frame;
    }
}

TEST_P(EndVelocity, IsTheSameWithSomethingFarAwayThatMayTouch) {
    expect_same_velocities(thrown(GetParam()));
    expect_same_velocities(thrown_up(GetParam()));
}

/// A sheet falls flat from `height` on a floor, with one substep a frame, so that each of them is a frame's last.
SceneDescription falling(SolverMethod method, double height) {
    SceneDescription scene = test::sheet(5, 5, 0.4, 0.4, 1);
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.pins.clear();
    cloth.stiffness = {false, 5, 1, 0};
    cloth.thickness = 0.002;
    cloth.placement = {{0, height, 0}, {1, 0, 0}, {0, 0, 1}};
    scene.colliders.push_back({Plane{}});
    return scene;
}

TEST_P(EndVelocity, OfWhatAFloorStopsIsNoRebound) {
    double fastest = 0, worst = -1;
    for (const double height : {0.05, 0.1, 0.17, 0.29, 0.5}) {
        const SimulationModel model(falling(GetParam(), height));
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 40; ++frame) {
            twin.run_frame(frame);
            for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
                const double up = end_motion(twin, 0, i)[1];
                const double made = twin.cloth(0)[Field::displacement][i].y;
                fastest = std::max(fastest, -up);
                worst = std::max(worst, up - std::max(made, 0.0));
            }
        }
    }
    std::printf("[ measured ] falls at %.4f m a substep, rises by %.2e m more than it was moved\n", fastest, worst);
    EXPECT_GT(fastest, 0.03);
    EXPECT_LE(worst, 1e-7);
}

/// The upper of two sheets strikes the lower one while that falls, and presses it to a floor that it would not reach
/// yet.
TEST_P(EndVelocity, OfWhatOtherClothPressesOnAFloorIsTheOneThatTheFloorLeaves) {
    SceneDescription scene = falling(GetParam(), 0.006);
    scene.gravity = {0, -1, 0};
    scene.cloths[0].self_collision = SelfCollision{0.002, {}};
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "upper";
    scene.cloths[1].placement.origin = {0.03, 0.022, 0.02};
    scene.cloths[1].velocity = {0.1, -0.5, 0};
    const SimulationModel model(scene);
    Twin twin(model);
    const TwinCloth& lower = twin.cloth(0);
    double worst = 0;
    std::size_t lying = 0;
    for (std::uint32_t frame = 1; frame <= 20; ++frame) {
        twin.run_frame(frame);
        for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
            // Contact leaves particles deeper by what coordinates round (rounding_at).
            if (std::abs(double(lower[Field::position][i].y) - 0.002) > 6e-7) continue;
            ++lying;
            worst = std::max(worst, std::abs(double(lower[Field::end_excess][i].y)));
        }
    }
    std::printf("[ measured ] %zu times lying, at most %.2e m from the motion that they are left with\n", lying, worst);
    EXPECT_GT(lying, 400u);
    EXPECT_LE(worst, 1e-7);
}

/// Returns the mean velocity of a cloth at a frame's end, m/s.
Vec3 mean_velocity(const Twin& twin, const SimulationModel& model, std::size_t cloth) {
    Vec3 sum{};
    double mass = 0;
    for (std::size_t i = 0; i < model.cloths[cloth].grid.particle_count(); ++i) {
        const double own = 1 / double(twin.cloth(cloth)[Field::position][i].w);
        const Vec3 moved = end_motion(twin, cloth, i);
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += own * moved[axis];
        mass += own;
    }
    const double per_substep = model.scene.solver.substeps * model.scene.time.fps;
    return {sum[0] / mass * per_substep, sum[1] / mass * per_substep, sum[2] / mass * per_substep};
}

/// In damped flight it is that of the closed form, and a change of the substeps' length leaves it so.
TEST_P(EndVelocity, OfDampedFlightIsExactBeforeAndAfterAChangeOfSubsteps) {
    SceneDescription scene = falling(GetParam(), 0);
    scene.colliders.clear();
    scene.forces = true;
    scene.solver.substeps = 4;
    Cloth& cloth = scene.cloths[0];
    cloth.damping = 3;
    cloth.velocity = {1, 4, -2};
    const SimulationModel model(scene), finer(model, 96);
    Twin twin(model);
    double worst = 0;
    const auto look = [&](const SimulationModel& run, double seconds) {
        const Vec3 terminal{0, -9.81 / cloth.damping, 0};
        const Vec3 left = times(std::exp(-cloth.damping * seconds), minus(cloth.velocity, terminal));
        worst = std::max(worst, length(minus(mean_velocity(twin, run, 0), plus(terminal, left))));
    };
    for (std::uint32_t frame = 1; frame <= 3; ++frame) twin.run_frame(frame), look(model, frame / 60.0);
    twin.change_substep(finer);
    look(finer, 3 / 60.0);
    for (std::uint32_t frame = 4; frame <= 6; ++frame) twin.run_frame(frame), look(finer, frame / 60.0);
    std::printf("[ measured ] damped flight: off by %.1e m/s of 4.6\n", worst);
    EXPECT_LT(worst, 1e-5);
}

/// Two sheets fall; the lower one is thrown up at the upper one. Neither the moment of the impact within a frame nor
/// what the pair bears on changes the exact law of both together, and they do not rebound.
TEST_P(EndVelocity, OfSheetsThatStrikeInFlightIsExactAndNoRebound) {
    const std::uint32_t substeps = GetParam() == SolverMethod::explicit_steps ? 24 : 8;
    for (const double gap : {0.021, 0.0237, 0.0291}) {
        SceneDescription scene = falling(GetParam(), 0);
        scene.colliders.clear();
        scene.solver.substeps = substeps;
        scene.cloths[0].damping = 0;
        scene.cloths[0].self_collision = SelfCollision{0.01, {}};
        scene.cloths[0].velocity = {0, 1, 0};
        scene.cloths.push_back(scene.cloths[0]);
        scene.cloths[1].name = "upper";
        scene.cloths[1].placement.origin = {0.03, gap, 0.02};
        scene.cloths[1].velocity = {0, -1, 0};
        const SimulationModel model(scene);
        Twin twin(model);
        double worst = 0, apart = 0;
        for (std::uint32_t frame = 1; frame <= 6; ++frame) {
            twin.run_frame(frame);
            const Vec3 lower = mean_velocity(twin, model, 0), upper = mean_velocity(twin, model, 1);
            worst = std::max(worst, std::abs((lower[1] + upper[1]) / 2 + 9.81 * frame / 60));
            apart = std::max(apart, upper[1] - lower[1]);
        }
        std::printf("[ measured ] together off by %.1e m/s, apart at %.3f of 2 m/s\n", worst, apart);
        EXPECT_LT(worst, 2e-4);
        EXPECT_LT(apart, 0.1);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, EndVelocity,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps));

}  // namespace
}  // namespace drape
