// Bodies that cloth moves, as the library hands them out: of ensembles as alone, saved and restored, drawn where they
// are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/vectors.h"
#include "drape/ensemble.h"
#include "drape/simulation.h"
#include "library_device.h"
#include "support/sheets.h"

namespace drape {
namespace {

using test::library_device;
using BodiesDeviceTest = test::LibraryTest;

/// A ball that falls into a sheet held along its edges.
SceneDescription ball_on_a_sheet(double mass, double beside) {
    SceneDescription scene = test::sheet(13, 13, 0.6, 0.6, 32);
    scene.solver.method = SolverMethod::line;
    scene.time.frame_count = 40;
    scene.image.size = {160, 120};
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 500, 50, 0};
    cloth.placement = {{-0.3, 0.5, -0.3}, {1, 0, 0}, {0, 0, 1}};
    cloth.pins = {test::pin_box(0, 0, 12, 0), test::pin_box(0, 12, 12, 12), test::pin_box(0, 0, 0, 12),
                  test::pin_box(12, 0, 12, 12)};
    Collider ball{Sphere{{beside, 0.65, 0}, 0.1}};
    ball.mass = mass;
    ball.color = {1, 0, 0};
    ball.angular_velocity = {0, 3, 1};
    scene.colliders = {Collider{Plane{}}, ball};
    return scene;
}

bool same(const BodyState& one, const BodyState& other) {
    return one.position == other.position && one.turn == other.turn && one.velocity == other.velocity &&
           one.angular_velocity == other.angular_velocity;
}

std::vector<BodyState> alone(const SceneDescription& scene, std::uint32_t frames) {
    Simulation simulation(scene, {}, library_device());
    std::vector<BodyState> all;
    for (std::uint32_t frame = 0; frame < frames && simulation.step(); ++frame)
        all.push_back(simulation.frame().bodies.at(0));
    return all;
}

TEST_F(BodiesDeviceTest, ScenesTogetherKeepTheirOwnBodies) {
    const std::vector<SceneDescription> scenes{ball_on_a_sheet(0.2, 0), ball_on_a_sheet(0.4, 0.1)};
    std::vector<Simulation> together = Simulation::together(scenes, {{}, {}}, library_device());
    std::vector<std::vector<BodyState>> found(2);
    std::vector<FrameRequest> requests(2);
    for (std::size_t k = 0; k < 2; ++k)
        requests[k] = {20, [](std::uint32_t) { return true; },
                       [&found, k](const FinishedFrame& frame) { found[k].push_back(frame.bodies.at(0)); }};
    Simulation::run_together(together, requests);
    for (std::size_t k = 0; k < 2; ++k) {
        const std::vector<BodyState> own = alone(scenes[k], 21);
        ASSERT_EQ(found[k].size(), own.size());
        for (std::size_t frame = 0; frame < own.size(); ++frame)
            EXPECT_TRUE(same(found[k][frame], own[frame])) << "scene " << k << ", frame " << frame;
    }
}

TEST_F(BodiesDeviceTest, WhatIsSavedGoesOnToTheSameBits) {
    const SceneDescription scene = ball_on_a_sheet(0.2, 0.05);
    Simulation first(scene, {}, library_device());
    for (int frame = 0; frame < 20; ++frame) first.step();
    const SimulationState state = first.save();
    Simulation second(scene, {}, library_device());
    second.restore(state);
    for (int frame = 0; frame < 10; ++frame) {
        first.step();
        second.step();
        EXPECT_TRUE(same(first.frame().bodies.at(0), second.frame().bodies.at(0)));
    }
    EXPECT_LT(first.frame().bodies[0].position[1], 0.65);
}

/// Balls that nothing touches.
std::vector<SceneDescription> flying_balls(std::size_t members) {
    SceneDescription scene = ball_on_a_sheet(0.5, 3);
    Collider box{Box{{-3, 2, 0}, {0.1, 0.05, 0.2}}};
    box.mass = 2;
    scene.colliders = {scene.colliders[1], box};
    scene.colliders[0].angular_velocity = {};
    return std::vector<SceneDescription>(members, scene);
}

void expect_vector(const Vec3& found, const Vec3& expected, double bound, const char* what) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], bound) << what << ", axis " << k;
}

TEST_F(BodiesDeviceTest, ActionsMoveBodiesAsNewtonSays) {
    Ensemble ensemble(flying_balls(2), {.controls = {.bodies = true}}, library_device());
    const Vec3 start = ensemble.bodies(1)[0].position;
    std::vector<double> velocities(24), forces(24), impulses(24);
    velocities[12] = 1, velocities[13] = 2, velocities[16] = 3;  // of member 1's ball: 1 2 0 m/s, 0 3 0 rad/s
    const std::vector<std::uint8_t> sets{0, 0, 1, 0};
    forces[14] = 0.5;       // N along z
    forces[18 + 4] = 0.06;  // N m about y, of member 1's box
    ensemble.step({.body_forces = forces, .body_velocities = velocities, .body_sets = sets});
    for (int frame = 2; frame <= 30; ++frame) ensemble.step();
    const double t = 0.5;
    const BodyState &ball = ensemble.bodies(1)[0], &box = ensemble.bodies(1)[1];
    expect_vector(ball.velocity, {1, 2 - 9.81 * t, t}, 1e-5, "velocity");
    expect_vector(minus(ball.position, start), {t, 2 * t - 0.5 * 9.81 * t * t, 0.5 * t * t}, 1e-5, "way");
    expect_vector(ball.angular_velocity, {0, 3, 0}, 1e-5, "turn");
    const double inertia = 2.0 / 3 * (0.01 + 0.04);
    expect_vector(box.angular_velocity, {0, 0.06 * t / inertia, 0}, 1e-5, "turn of the box");
    expect_vector(ensemble.bodies(0)[0].velocity, {0, -9.81 * t, 0}, 1e-5, "the other member");
    // The force ends with the step in which an impulse of 0.5 N s along x is given to 0.5 kg.
    impulses[12] = 0.5;
    ensemble.step({.body_forces = std::vector<double>(24), .body_impulses = impulses});
    ensemble.step();
    expect_vector(ensemble.bodies(1)[0].velocity, {2, 2 - 9.81 * (t + 2 / 60.0), t}, 1e-5, "after an impulse");
}

TEST_F(BodiesDeviceTest, MembersGoBackAndOnWithTheirBodies) {
    Ensemble ensemble(flying_balls(2), {.controls = {.bodies = true}}, library_device());
    const BodyState start = ensemble.bodies(0)[0];
    const std::vector<double> forces(24, 0.3);
    ensemble.step({.body_forces = forces});
    ensemble.step();
    const SimulationState saved = ensemble.save(1);
    const BodyState then = ensemble.bodies(1)[1];
    for (int frame = 0; frame < 5; ++frame) ensemble.step();
    const BodyState later = ensemble.bodies(1)[1];
    const std::size_t zero[] = {0}, one[] = {1};
    ensemble.restore(one, std::vector{saved});
    EXPECT_TRUE(same(ensemble.bodies(1)[1], then));
    for (int frame = 0; frame < 5; ++frame) ensemble.step();
    EXPECT_TRUE(same(ensemble.bodies(1)[1], later)) << "the force is saved, too";
    ensemble.reset(zero);
    EXPECT_TRUE(same(ensemble.bodies(0)[0], start));
}

TEST_F(BodiesDeviceTest, ActionsOnBodiesAreChecked) {
    Ensemble ensemble(flying_balls(2), {.controls = {.bodies = true}}, library_device());
    const auto refusal = [&](const EnsembleActions& actions) -> std::string {
        try {
            ensemble.step(actions);
        } catch (const ActionError& error) {
            return error.what();
        }
        return "";
    };
    std::vector<double> numbers(24);
    const std::vector<std::uint8_t> sets(4);
    EXPECT_THAT(refusal({.body_forces = std::span(numbers).first(6)}), testing::HasSubstr("body_forces has 6 numbers"));
    EXPECT_THAT(refusal({.body_sets = sets}), testing::HasSubstr("expected body_velocities too"));
    numbers[13] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal({.body_forces = numbers}), testing::HasSubstr("member 1: body_forces: number 1 is nan"));
    EXPECT_THAT(refusal({.body_impulses = numbers}), testing::HasSubstr("member 1: body_impulses"));
    EXPECT_THAT(refusal({.body_velocities = numbers}), testing::HasSubstr("member 1: body_velocities"));
    EXPECT_EQ(ensemble.frame(0), 0u);
    Ensemble plain(flying_balls(2), {}, library_device());
    EXPECT_THROW(plain.step({.body_forces = std::vector<double>(24)}), ActionError);
    SceneDescription none = ball_on_a_sheet(0.5, 3);
    none.colliders.clear();
    EXPECT_THROW(Ensemble({none}, {.controls = {.bodies = true}}, library_device()), Error);
}

/// What a fast ball does to a sheet at rest is explained by the ball.
TEST_F(BodiesDeviceTest, AShotAtASheetIsPlausible) {
    for (const bool held : {true, false}) {
        SceneDescription scene = ball_on_a_sheet(0.4, 0.02);
        scene.gravity = {0, 0, 0};
        scene.solver.substeps = 64;
        if (!held) scene.cloths[0].pins.clear();
        scene.colliders[1].velocity = {0, -12, 0};
        Simulation simulation(scene, {}, library_device());
        for (int frame = 0; frame < 20; ++frame) ASSERT_NO_THROW(simulation.step()) << held << ", frame " << frame;
        EXPECT_GT(simulation.frame().statistics[0].largest_speed, 1.0);
    }
}

TEST_F(BodiesDeviceTest, AMassIsNoneOfAPath) {
    SceneDescription scene = ball_on_a_sheet(0.2, 0);
    scene.colliders[1].path.keys = {{}};
    EXPECT_THROW(Simulation(scene, {}, library_device()), Error);
}

/// Returns the mean row of the red pixels; nothing where there are none.
std::optional<double> red_row(std::span<const std::uint8_t> rgba, std::uint32_t width) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; 4 * i < rgba.size(); ++i)
        if (rgba[4 * i] > 100 && rgba[4 * i + 1] < 70 && rgba[4 * i + 2] < 70) {
            sum += static_cast<double>(i / width);
            ++count;
        }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

TEST_F(BodiesDeviceTest, PicturesShowABodyWhereItIs) {
    SceneDescription scene = ball_on_a_sheet(0.2, 0);
    std::get<Sphere>(scene.colliders[1].shape).center[1] = 0.9;
    scene.camera = Camera{{0, 0.6, 2.5}, {0, 0.5, 0}, 40};
    Simulation simulation(scene, {.draw = true}, library_device());
    simulation.step();
    const std::optional<double> first = red_row(simulation.frame().rgba, 160);
    const double from = simulation.frame().bodies.at(0).position[1];
    for (int frame = 0; frame < 10; ++frame) simulation.step();
    const std::optional<double> last = red_row(simulation.frame().rgba, 160);
    const double way = from - simulation.frame().bodies.at(0).position[1];
    ASSERT_TRUE(first && last);
    // 120 rows show 2 x 2.5 tan 20 degrees at the target.
    EXPECT_NEAR(*last - *first, way * 120 / (5 * 0.36397), 4);
    EXPECT_GT(way, 0.1);
}

/// The cloth and the bodies of a scene's last frame.
struct LastFrame {
    std::vector<float> positions;
    std::vector<BodyState> bodies;
    FrameEffort effort;
    std::uint32_t most_substeps = 0;
};

LastFrame last_frame(const SceneDescription& scene) {
    Simulation simulation(scene, {}, library_device());
    LastFrame last;
    while (simulation.step()) last.most_substeps = std::max(last.most_substeps, simulation.frame().effort.substeps);
    const FinishedFrame& frame = simulation.frame();
    last.positions.assign(frame.positions[0].begin(), frame.positions[0].end());
    last.bodies = frame.bodies;
    last.effort = frame.effort;
    return last;
}

/// Returns the RMS distance of the particles, which weigh nearly the same, m.
double particles_apart(const LastFrame& one, const LastFrame& other) {
    double sum = 0;
    for (std::size_t i = 0; i < one.positions.size(); ++i)
        if (i % 4 != 3) sum += std::pow(double{one.positions[i]} - double{other.positions[i]}, 2);
    return std::sqrt(4 * sum / static_cast<double>(one.positions.size()));
}

struct JudgedScene {
    const char* name;
    SceneDescription (*scene)();
};

SceneDescription ball_beside_the_middle() { return ball_on_a_sheet(0.3, 0.04); }
SceneDescription box_in_a_hammock() {
    SceneDescription scene = ball_on_a_sheet(0.3, 0);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 12), test::pin_box(12, 0, 12, 12)};
    Collider box{Box{{0.03, 0.6, 0.02}, {0.08, 0.03, 0.06}}};
    box.mass = 0.6;
    scene.colliders = {Collider{Plane{}}, box};
    return scene;
}
SceneDescription thrown_ball_and_corners() {
    SceneDescription scene = ball_on_a_sheet(0.25, -0.05);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(12, 0, 12, 0), test::pin_box(0, 12, 0, 12),
                            test::pin_box(12, 12, 12, 12)};
    scene.cloths[0].damping = 0.5;
    scene.colliders[1].velocity = {0.3, -0.5, 0.1};
    return scene;
}

class AutoWithBodies : public test::LibraryTest, public testing::WithParamInterface<JudgedScene> {};

/// The stated error is that of cloth and bodies, against many more substeps (docs/accuracy.md: within a factor of 3).
TEST_P(AutoWithBodies, StatesTheErrorOfBodiesToo) {
    SceneDescription scene = GetParam().scene();
    scene.time.frame_count = 43;  // it ends with a comparison
    SceneDescription exact = scene;
    exact.solver.method = SolverMethod::line;
    exact.solver.substeps = 512;
    scene.solver = {};
    const LastFrame judged = last_frame(scene), reference = last_frame(exact);
    const double cloth = particles_apart(judged, reference);
    const double body = length(minus(judged.bodies[0].position, reference.bodies[0].position));
    const FrameEffort& effort = judged.effort;
    std::printf("[ measured ] %s: %u substeps at most; stated %.2e m, allowed %.2e m; cloth off by %.2e, body %.2e\n",
                GetParam().name, judged.most_substeps, effort.position_error, effort.position_allowed, cloth, body);
    EXPECT_LE(std::max(cloth, body), 3 * effort.position_error);
    EXPECT_TRUE(effort.within_limits);
    EXPECT_FALSE(effort.asleep);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AutoWithBodies,
                         testing::Values(JudgedScene{"ball", ball_beside_the_middle},
                                         JudgedScene{"box", box_in_a_hammock},
                                         JudgedScene{"thrown", thrown_ball_and_corners}),
                         [](const auto& scene) { return std::string(scene.param.name); });

/// A body that flies keeps a sheet awake that hangs still.
TEST_F(BodiesDeviceTest, NothingSleepsWhileABodyFlies) {
    SceneDescription scene = ball_on_a_sheet(0.5, 3);
    scene.solver = {};
    scene.time.frame_count = 121;
    scene.colliders.erase(scene.colliders.begin());
    const LastFrame last = last_frame(scene);
    EXPECT_NEAR(last.bodies.at(0).position[1], 0.65 - 0.5 * 9.81 * 4, 1e-3);
}

}  // namespace
}  // namespace drape
