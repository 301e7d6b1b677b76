// A steady wind has the right force on a flat plate, and none on a triangle without area.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sheets.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

/// Total wind force on a 0.6 x 0.4 m plate at rest in the xy plane.
Vec3 plate_force(const Vec3& wind, double drag, double lift) {
    SceneDescription scene = test::sheet(13, 9, 0.6, 0.4, 1);
    scene.wind.velocity = wind;
    scene.wind.drag = drag;
    scene.wind.lift = lift;
    const SimulationModel model(scene);
    Twin twin(model);
    twin.cloth(0)[Field::displacement].assign(13 * 9, {});
    twin.run_step({StepKind::wind, 0, 0}, frame_inputs(model, 1));
    Vec3 sum{};
    for (const glsl::vec4& force : twin.cloth(0)[Field::wind_force]) {
        sum[0] += double(force.x);
        sum[1] += double(force.y);
        sum[2] += double(force.z);
    }
    return sum;
}

TEST(WindTest, AFlatPlateFeelsTheStatedForce) {
    for (const double degrees : {0.0, 20.0, 45.0, 70.0, 85.0, 160.0})
        for (const auto& [drag, lift] : {std::pair{1.0, 0.5}, {1.2, 0.0}, {0.3, 0.9}}) {
            const double a = degrees * M_PI / 180;
            const Vec3 v{8 * std::sin(a), 0, 8 * std::cos(a)};  // the plate's normal is along z
            const Vec3 measured = plate_force(v, drag, lift);
            const double side = v[2] < 0 ? -1 : 1, along = std::abs(v[2]);
            const double scale = 0.5 * 1.2 * 0.6 * 0.4;
            const Vec3 stated{scale * (drag - lift) * along * v[0], 0,
                              scale * ((drag - lift) * along * v[2] + lift * 64 * side)};
            const double size = std::hypot(stated[0], stated[2]);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(measured[k], stated[k], 1e-5 * size) << degrees;
        }
}

TEST(WindTest, ADegenerateQuarterFeelsNothing) {
    using namespace glsl;
    const vec3 wind{5, 0, 3};
    const vec3 edges[][2] = {{{0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {2, 0, 0}}, {{1e-30f, 0, 0}, {0, 1e-30f, 0}}};
    for (const auto& [row, column] : edges) {
        const WindForce felt = quarter_wind_force(row, column, wind, 34, sqrt(34.0f), 0.6f, 0.3f, 1.0f);
        EXPECT_EQ(felt.force.x, 0.0f);
        EXPECT_EQ(felt.force.y, 0.0f);
        EXPECT_EQ(felt.force.z, 0.0f);
        EXPECT_EQ(felt.drag, 0.0f);
    }
}

TEST(WindTest, AMovingPlateFeelsTheRelativeWindOnly) {
    // A plate that moves with the wind feels no force at all, so it keeps its speed to rounding.
    SceneDescription scene = test::sheet(5, 5, 0.4, 0.4, 8);
    scene.gravity = {0, 0, 0};
    scene.wind.velocity = {2, 0, 3};
    scene.cloths[0].velocity = {2, 0, 3};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    for (std::size_t i = 0; i < 25; ++i) {
        EXPECT_NEAR(double(twin.cloth(0)[Field::position][i].x) - double(model.cloths[0].position[i].x), 2.0, 1e-5);
        EXPECT_NEAR(double(twin.cloth(0)[Field::position][i].z) - double(model.cloths[0].position[i].z), 3.0, 1e-5);
    }
}

/// Returns the velocity (m/s) of the centre of mass after `seconds` of a free sheet, starting at rest.
Vec3 velocity_after(SceneDescription scene, double seconds) {
    const SimulationModel model(scene);
    Twin twin(model);
    const auto frames = static_cast<std::uint32_t>(std::lround(seconds * scene.time.fps));
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    Vec3 momentum{};
    double mass = 0;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
        const glsl::vec4& moved = twin.cloth(0)[Field::displacement][i];
        const double m = 1 / double(twin.cloth(0)[Field::position][i].w);
        mass += m;
        momentum[0] += m * double(moved.x);
        momentum[1] += m * double(moved.y);
        momentum[2] += m * double(moved.z);
    }
    for (double& p : momentum) p /= mass * model.cloths[0].substep_length;
    return momentum;
}

constexpr SolverMethod every_method[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

TEST(WindTest, LightClothFollowsAStrongWindAtAnySubsteps) {
    // The sheet is blown flat on, and u = W - v falls as du/dt = -k u^2: v = W k W t/(1 + k W t), k = rho Cd/(2 sigma).
    for (const SolverMethod method : every_method)
        for (const std::uint32_t substeps : {1u, 4u, 16u}) {
            SceneDescription scene = test::sheet(9, 9, 0.4, 0.4, substeps);
            scene.solver.method = method;
            scene.gravity = {0, 0, 0};
            scene.wind.velocity = {0, 0, 100};
            scene.cloths[0].areal_density = 0.02;
            scene.cloths[0].stiffness.bend = 1;
            const double reached = velocity_after(scene, 0.1)[2], rate = 0.5 * 1.2 / 0.02 * 100 * 0.1;
            std::printf("[ measured ] %s, %u substeps: %.3f m/s, exact %.3f\n", std::string(named(method).name).c_str(),
                        substeps, reached, 100 * rate / (1 + rate));
            // BDF2 remembers the gust's onset for a step or two.
            const double limit = method == SolverMethod::line ? 4.0 / substeps : 0.1;
            EXPECT_NEAR(reached, 100 * rate / (1 + rate), limit);
        }
}

/// Returns the wind's force over weight, less 1, on a sheet folded along its middle column by `degrees` on both sides
/// and falling at `speed` (m/s).
double net_fall(double degrees, double speed) {
    SceneDescription scene = test::sheet(5, 3, 0.4, 0.2, 1);
    scene.wind.velocity = {1e-9, 0, 0};
    const SimulationModel model(scene);
    Twin twin(model);
    const double angle = degrees * M_PI / 180, h = model.cloths[0].substep_length;
    TwinCloth& state = twin.cloth(0);
    for (std::size_t i = 0; i < 15; ++i) {
        const double along = 0.1 * (static_cast<double>(i % 5) - 2);
        state[Field::position][i] = {static_cast<float>(along * std::cos(angle)),
                                     static_cast<float>(std::abs(along) * std::sin(angle)),
                                     0.1f * static_cast<float>(i / 5), model.cloths[0].free_weight[i]};
        state[Field::displacement][i] = {0, static_cast<float>(-speed * h), 0, 0};
    }
    twin.run_step({StepKind::wind, 0, 0}, frame_inputs(model, 1));
    Vec3 force{};
    for (const glsl::vec4& each : state[Field::wind_force]) force[1] += double(each.y);
    return force[1] / (0.4 * 0.2 * scene.cloths[0].areal_density * 9.81) - 1;
}

TEST(WindTest, AFallingSheetEndsAtItsTerminalVelocityFlatOrFolded) {
    // At the terminal velocity Cd cos(a) rho v^2/2 = sigma g.
    const double density = test::sheet(2, 2, 1, 1, 1).cloths[0].areal_density;
    for (const double degrees : {0.0, 30.0, 60.0}) {
        const double terminal = std::sqrt(2 * density * 9.81 / (1.2 * std::cos(degrees * M_PI / 180)));
        EXPECT_NEAR(net_fall(degrees, terminal), 0, 1e-5) << degrees;
    }
    // It is reached at any substeps: v = V tanh(g t/V).
    for (const SolverMethod method : every_method)
        for (const std::uint32_t substeps : {1u, 8u}) {
            SceneDescription scene = test::sheet(5, 5, 0.4, 0.4, substeps);
            scene.solver.method = method;
            scene.wind.velocity = {0, 1e-9, 0};
            scene.cloths[0].placement.v = {0, 0, 1};
            scene.cloths[0].areal_density = 0.1;
            scene.cloths[0].stiffness.bend = 1;
            const double terminal = std::sqrt(2 * 0.1 * 9.81 / 1.2),
                         exact = terminal * std::tanh(9.81 * 0.5 / terminal);
            const double reached = -velocity_after(scene, 0.5)[1];
            std::printf("[ measured ] %s, %u substeps: %.4f m/s, exact %.4f\n", std::string(named(method).name).c_str(),
                        substeps, reached, exact);
            EXPECT_NEAR(reached, exact, 0.02 * exact);
        }
}

TEST(WindTest, ClothAtRestBearsTheWholeForceAtAnySubsteps) {
    // The cloth bulges from a frame, as far as the force that it bears. Two substeps feel 1.7 times the mass of air and
    // cloth together. Line solves let each direction bear the load before the others have (10 % at 2 substeps, as the
    // square of their length).
    const auto bulge = [](SolverMethod method, std::uint32_t substeps) {
        SceneDescription scene = test::sheet(9, 9, 0.4, 0.4, substeps, 20);
        scene.solver.method = method;
        scene.gravity = {0, 0, 0};
        scene.wind.velocity = {0, 0, 10};
        Cloth& cloth = scene.cloths[0];
        cloth.areal_density = 0.05;
        cloth.damping = 20;
        cloth.pins = {test::pin_top(cloth), test::pin_box(0, 0, 0, 8), test::pin_box(8, 0, 8, 8),
                      test::pin_box(0, 8, 8, 8)};
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 180; ++frame) twin.run_frame(frame);
        return double(twin.cloth(0)[Field::position][40].z);
    };
    const double exact = bulge(SolverMethod::explicit_steps, 240);
    for (const auto& [method, substeps] :
         {std::pair{SolverMethod::line, 8u}, {SolverMethod::line, 20u}, {SolverMethod::relax, 40u}}) {
        const double reached = bulge(method, substeps);
        std::printf("[ measured ] %s, %u substeps: bulges by %.5f m, explicit by %.5f m\n",
                    std::string(named(method).name).c_str(), substeps, reached, exact);
        EXPECT_NEAR(reached, exact, 0.025 * exact);
    }
}

}  // namespace
}  // namespace drape
