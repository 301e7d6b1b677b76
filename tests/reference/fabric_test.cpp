// Warp, weft, shear and twist have constants of their own. A sheet of them is the orthotropic one: it stretches and
// bends along every direction as that does, and its threads hang and droop by the constants of their own direction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/felt_energy.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

const char* word(SolverMethod method) { return named(method).name.data(); }

constexpr double cell = 1.0 / 16;
/// Unlike in each of its constants.
constexpr Stiffness woven{false, {400, 100}, 30, {}}, bent{false, 0.0, 0, {1e-3, 2e-4, 3e-4}};

struct Way {
    SolverMethod method;
    double compliance;  ///< m/(k h^2) of the stiffest spring or element
    double limit;       ///< largest relative error; passes that follow each other err by 1/compliance
};

/// A square metre that nothing pulls at, with one substep per frame.
SceneDescription piece(const Way& way, const Stiffness& stiffness) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, 1);
    scene.gravity = {0, 0, 0};
    scene.solver.method = way.method;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = stiffness;
    const double stiffest = std::max(stiffness.stretch.largest(), stiffness.bend.largest() / (cell * cell));
    scene.time.fps = std::sqrt(way.compliance * stiffest / (cloth.areal_density * cell * cell));
    return scene;
}

std::vector<Vec3> unstrained() {
    std::vector<Vec3> shape;
    for (int row = 0; row < 17; ++row)
        for (int column = 0; column < 17; ++column) shape.push_back({cell * column, cell * row, 0});
    return shape;
}

/// The compliances of the sheet of square cells: its moduli are stretch + shear along the threads, shear across them,
/// and shear in shear.
struct Compliances {
    explicit Compliances(const Stiffness& s) {
        const double warp = s.stretch.warp + s.shear, weft = s.stretch.weft + s.shear;
        const double determinant = warp * weft - s.shear * s.shear;
        along_warp = weft / determinant, along_weft = warp / determinant;
        across = -s.shear / determinant, in_shear = 1 / s.shear;
    }
    double along_warp, along_weft, across, in_shear;
    /// Returns the modulus, N/m, of a strip that is cut at this angle to the warp.
    double modulus(double angle) const {
        const double c = std::pow(std::cos(angle), 2), s = std::pow(std::sin(angle), 2);
        return 1 / (along_warp * c * c + along_weft * s * s + (2 * across + in_shear) * c * s);
    }
    /// Returns the sheet under the tension of 1 N/m along this angle, times `tension`.
    std::vector<Vec3> pulled(double angle, double tension) const {
        const double c = std::cos(angle), s = std::sin(angle);
        const double warp = tension * (along_warp * c * c + across * s * s),
                     weft = tension * (along_weft * s * s + across * c * c),
                     half_shear = tension * in_shear * c * s / 2;
        std::vector<Vec3> shape = unstrained();
        for (Vec3& at : shape)
            at = {at[0] + warp * at[0] + half_shear * at[1], at[1] + half_shear * at[0] + weft * at[1], 0};
        return shape;
    }
};

class FabricMethods : public testing::TestWithParam<Way> {};

TEST_P(FabricMethods, AStripIsAsStiffAsItsCutSays) {
    const Compliances compliances(woven);
    const SceneDescription scene = piece(GetParam(), woven);
    for (const double degrees : {0.0, 22.5, 45.0, 67.5, 90.0, 135.0}) {
        const double angle = degrees * std::numbers::pi / 180, expected = compliances.modulus(angle);
        const double tension = 3e-3 * expected;
        // Pulled and pushed by as much, so that what is of third order in the strain drops out.
        const double felt = (test::felt_energy(scene, compliances.pulled(angle, tension), unstrained()) +
                             test::felt_energy(scene, compliances.pulled(angle, -tension), unstrained())) /
                            2;
        const double modulus = tension * tension / (2 * felt);
        std::printf("[ measured ] %s, cut at %g degrees: %.2f of %.2f N/m\n", word(GetParam().method), degrees, modulus,
                    expected);
        EXPECT_NEAR(modulus / expected, 1, GetParam().limit);
    }
}

TEST_P(FabricMethods, AStripBendsAsItsCutSays) {
    const SceneDescription scene = piece(GetParam(), bent);
    const Rigidity& b = bent.bend;
    for (const double degrees : {0.0, 22.5, 45.0, 67.5, 90.0, 135.0}) {
        const double curvature = 0.5, angle = degrees * std::numbers::pi / 180;
        const double c = std::pow(std::cos(angle), 2), s = std::pow(std::sin(angle), 2);
        const double felt = test::felt_energy(scene, test::rolled(unstrained(), angle, curvature), unstrained()) /
                            (0.5 * curvature * curvature);
        // The threads' elements are missing in the half cells at the borders, the twist is missing nowhere.
        const double expected = (b.warp * c * c + b.weft * s * s) * 15 / 16 + 2 * b.twist * c * s;
        std::printf("[ measured ] %s, rolled along %g degrees: %.3e of %.3e N m\n", word(GetParam().method), degrees,
                    felt, expected);
        EXPECT_NEAR(felt / expected, 1, GetParam().limit);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, FabricMethods,
                         testing::Values(Way{SolverMethod::relax, 1000, 2e-3}, Way{SolverMethod::line, 1000, 2e-3},
                                         Way{SolverMethod::explicit_steps, 100, 1e-3}));

struct Thread {
    SolverMethod method;
    std::size_t axis;
};

class FabricThreads : public testing::TestWithParam<Thread> {};

/// Turns a strip along u into one along v.
void turn_threads(Cloth& cloth) {
    std::swap(cloth.grid[0], cloth.grid[1]);
    std::swap(cloth.size[0], cloth.size[1]);
    std::swap(cloth.placement.u, cloth.placement.v);
    for (Pin& pin : cloth.pins) {
        std::swap(pin.particles.first[0], pin.particles.first[1]);
        std::swap(pin.particles.last[0], pin.particles.last[1]);
    }
}

TEST_P(FabricThreads, AHangingStripStretchesByTheThreadsThatHang) {
    const std::uint32_t links = 8;
    SceneDescription scene = test::sheet(links + 1, 3, 1, 0.25, 80);
    scene.solver.method = GetParam().method;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, {30, 90}, 0, {}};
    cloth.damping = 20;
    cloth.placement = {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}};
    cloth.pins = {test::pin_box(0, 0, 0, 2)};
    if (GetParam().axis == 1) turn_threads(cloth);
    const SimulationModel model(scene);
    ASSERT_TRUE(model.cloths[0].scheme.compromises.empty());
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 120; ++frame) twin.run_frame(frame);
    const Vec3 end = test::position_of(twin.cloth(0), GetParam().axis == 0 ? links : 3 * links);
    // Half of a link's weight hangs on itself: the sum over links is that of the continuous strip.
    const double expected = cloth.areal_density * 9.81 / (2 * cloth.stiffness.stretch.along(GetParam().axis));
    std::printf("[ measured ] %s, axis %zu: longer by %.5f of %.5f m\n", word(GetParam().method), GetParam().axis,
                -end[1] - 1, expected);
    EXPECT_NEAR((-end[1] - 1) / expected, 1, 0.003);
}

TEST_P(FabricThreads, AStripDroopsByTheRigidityOfTheThreadsThatBend) {
    const double gamma = 10, fall_over_reach = 1.066802;  // docs/physics.md 7
    SceneDescription scene = model_scenes::hanging_cantilever(24, gamma, GetParam().method);
    Cloth& cloth = scene.cloths[0];
    const double own = cloth.stiffness.bend.warp;
    cloth.stiffness.bend = {own, 30 * own, own};
    if (GetParam().axis == 1) {
        turn_threads(cloth);
        cloth.stiffness.bend = {30 * own, own, own};
    }
    const SimulationModel model(scene);
    ASSERT_EQ(model.cloths[0].scheme.used_bend, 30 * own) << "all of it: the largest stands for all three";
    Twin twin(model);
    for (std::uint32_t frame = 1; frame < scene.time.frame_count; ++frame) twin.run_frame(frame);
    const Grid& grid = model.cloths[0].grid;
    const Vec3 tip =
        test::position_of(twin.cloth(0), GetParam().axis == 0 ? grid.columns() - 1 : grid.particle(0, grid.rows() - 1));
    std::printf("[ measured ] %s, axis %zu: H/W %.4f of %.4f\n", word(GetParam().method), GetParam().axis,
                -tip[1] / tip[0], fall_over_reach);
    EXPECT_NEAR(-tip[1] / tip[0] / fall_over_reach, 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Methods, FabricThreads,
                         testing::Values(Thread{SolverMethod::relax, 0}, Thread{SolverMethod::relax, 1},
                                         Thread{SolverMethod::line, 0}, Thread{SolverMethod::line, 1},
                                         Thread{SolverMethod::explicit_steps, 0},
                                         Thread{SolverMethod::explicit_steps, 1}));

}  // namespace
}  // namespace drape
