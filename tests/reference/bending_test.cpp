// The solvers' bending is as stiff in every direction, takes off again what an iteration adds, and leaves no net force
// or torque.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/felt_energy.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double rigidity = 1e-3;

/// A square metre does nothing but bend, one substep per frame; `compliance`: m/(b h^2) of the axes' elements.
SceneDescription bending_sheet(SolverMethod method, double compliance) {
    SceneDescription scene = test::sheet(65, 65, 1, 1, 1);
    scene.gravity = {0, 0, 0};
    scene.solver.method = method;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 0, 0, rigidity};
    const double cell = 1.0 / 64, mass = cloth.areal_density * cell * cell;
    scene.time.fps = std::sqrt(compliance * rigidity / (cell * cell) / mass);
    return scene;
}

std::vector<Vec3> flat() {
    std::vector<Vec3> shape;
    for (int row = 0; row < 65; ++row)
        for (int column = 0; column < 65; ++column) shape.push_back({column / 64.0, -row / 64.0, 0});
    return shape;
}

struct Solver {
    SolverMethod method;
    double compliance;  ///< m/(b h^2)
    double limit;  ///< largest relative error; an iteration's own falls as 1/compliance^2, at borders as 1/compliance
    const char* name() const { return method == SolverMethod::relax ? "relax" : "explicit"; }
};

class SolverBending : public testing::TestWithParam<Solver> {};

TEST_P(SolverBending, IsAsStiffInEveryDirection) {
    const Solver& solver = GetParam();
    const SceneDescription scene = bending_sheet(solver.method, solver.compliance);
    for (const double degrees : {0.0, 22.5, 45.0, 90.0, 135.0}) {
        const double curvature = 1, angle = degrees * std::numbers::pi / 180;
        const double felt =
            test::felt_energy(scene, test::rolled(flat(), angle, curvature), flat()) / (0.5 * rigidity * curvature);
        std::printf("[ measured ] %s, m/(b h^2) %g: rigidity along %g degrees %.4f B\n", solver.name(),
                    solver.compliance, degrees, felt);
        // The axes' elements are missing in the half cells at the borders, the twist is missing nowhere.
        const double twist = 0.5 * std::pow(std::sin(2 * angle), 2);
        EXPECT_NEAR(felt, (1 - twist) * 63.0 / 64 + twist, solver.limit);
    }
}

TEST_P(SolverBending, TwistsAsThePlateOfPoissonsRatioZero) {
    const Solver& solver = GetParam();
    std::vector<Vec3> saddle = flat();
    for (Vec3& at : saddle) at[2] = 0.5 * at[0] * at[1];
    // The energy is B/2 integral of 2 kxy^2 with kxy = 1/2.
    const double felt =
        test::felt_energy(bending_sheet(solver.method, solver.compliance), saddle, flat()) / (rigidity * 0.25);
    std::printf("[ measured ] %s, m/(b h^2) %g: twist %.4f of the plate's\n", solver.name(), solver.compliance, felt);
    EXPECT_NEAR(felt, 1, solver.limit);
}

INSTANTIATE_TEST_SUITE_P(Methods, SolverBending,
                         testing::Values(Solver{SolverMethod::explicit_steps, 100, 1e-3},
                                         Solver{SolverMethod::relax, 20, 0.05}, Solver{SolverMethod::relax, 60, 0.008},
                                         Solver{SolverMethod::relax, 1000, 1e-3}));

class BendingForces : public testing::TestWithParam<SolverMethod> {};

TEST_P(BendingForces, KeepMomentumAndAngularMomentum) {
    SceneDescription scene = bending_sheet(GetParam(), GetParam() == SolverMethod::relax ? 10 : 100);
    scene.cloths[0].holes = {{{5, 3}, {19, 28}}, {{40, 40}, {41, 41}}};
    const SimulationModel model(scene);
    Twin twin(model);
    TwinCloth& state = twin.cloth(0);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> noise(-0.05f, 0.05f);
    for (glsl::vec4& x : state[Field::position])
        x = {x.x + noise(random), x.y + noise(random), x.z + noise(random), x.w};
    Vec3 momentum{}, angular{};
    double size = 0, angular_size = 0;
    // The sums go step by step: within a step no particle moves twice, and its arm is where it was before.
    for (const Step& step : frame_steps(model)) {
        if (step.kind == StepKind::torque || step.kind == StepKind::advance) break;  // what follows is not bending's
        const TwinCloth before = state;
        twin.run_step(step, frame_inputs(model, 1));
        for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
            const Vec3 x = test::position_of(before, i), moved = test::displacement_of(before, i),
                       now = test::displacement_of(state, i);
            const double mass = test::mass_of(model.cloths[0], i);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
                const double along_a = mass * (x[a] + moved[a]) * (now[b] - moved[b]);
                const double along_b = mass * (x[b] + moved[b]) * (now[a] - moved[a]);
                momentum[k] += mass * (now[k] - moved[k]);
                angular[k] += along_a - along_b;
                size += mass * std::abs(now[k] - moved[k]);
                angular_size += std::abs(along_a) + std::abs(along_b);
            }
        }
    }
    std::printf("[ measured ] momentum %.1e, angular momentum %.1e of their terms\n",
                std::hypot(momentum[0], momentum[1], momentum[2]) / size,
                std::hypot(angular[0], angular[1], angular[2]) / angular_size);
    EXPECT_LE(std::hypot(momentum[0], momentum[1], momentum[2]), 1e-6 * size);
    EXPECT_LE(std::hypot(angular[0], angular[1], angular[2]), 1e-6 * angular_size);
}

TEST(LineBending, KeepsMomentumHoweverStiff) {
    // The line's forces act where the substep ends, so the angular momentum is kept to the substep's length.
    SceneDescription scene = bending_sheet(SolverMethod::line, 1e-3);
    scene.cloths[0].holes = {{{5, 3}, {19, 28}}, {{40, 40}, {41, 41}}};
    const SimulationModel model(scene);
    Twin twin(model);
    TwinCloth& state = twin.cloth(0);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> noise(-0.05f, 0.05f);
    for (glsl::vec4& x : state[Field::position])
        x = {x.x + noise(random), x.y + noise(random), x.z + noise(random), x.w};
    twin.run_frame(1);
    Vec3 momentum{};
    double size = 0;
    for (std::size_t i = 0; i < state[Field::position].size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = test::mass_of(model.cloths[0], i) * test::displacement_of(state, i)[k];
            ASSERT_TRUE(std::isfinite(along));
            momentum[k] += along;
            size += std::abs(along);
        }
    std::printf("[ measured ] momentum %.1e of its terms\n", std::hypot(momentum[0], momentum[1], momentum[2]) / size);
    EXPECT_LE(std::hypot(momentum[0], momentum[1], momentum[2]), 1e-6 * size);
}

INSTANTIATE_TEST_SUITE_P(Methods, BendingForces, testing::Values(SolverMethod::explicit_steps, SolverMethod::relax));

}  // namespace
}  // namespace drape
