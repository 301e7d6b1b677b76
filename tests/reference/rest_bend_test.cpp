// Cloth that rests bent (`rest`: "start", with bending) keeps its shape, gives way to a load as a curved beam does, and
// flies as a body does.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/vectors.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/kernels.h"
#include "twin/statistics.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr SolverMethod bending_methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

/// Gives a cloth the shape of a part of a cylinder whose axis is z, in which it is at rest: its columns go around it,
/// from straight right of the axis on.
void roll(Cloth& cloth, double angle) {
    const auto [columns, rows] = cloth.grid;
    const double radius = cloth.size[0] / angle;
    cloth.start.clear();
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double turn = angle * column / (columns - 1), z = cloth.size[1] * row / (rows - 1);
            cloth.start.push_back({radius * std::sin(turn), radius * std::cos(turn), z});
        }
    cloth.placement = {};
    cloth.rest = Rest::start;
}

/// Two thirds of a circle, and no gravity.
SceneDescription shell(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::sheet(19, 9, 0.6, 0.3, substeps);
    scene.solver.method = method;
    scene.gravity = {0, 0, 0};
    scene.cloths[0].stiffness = {false, 500, 100, 2e-4};
    scene.cloths[0].damping = 0;
    roll(scene.cloths[0], 4 * std::numbers::pi / 3);
    return scene;
}

std::vector<Vec3> positions_of(const Twin& twin) {
    std::vector<Vec3> at;
    for (std::size_t i = 0; i < twin.cloth(0)[Field::position].size(); ++i)
        at.push_back(test::position_of(twin.cloth(0), i));
    return at;
}

/// Returns where the particles are after so many frames, m.
std::vector<Vec3> simulated(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    return positions_of(twin);
}

double largest_distance(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
    double largest = 0;
    for (std::size_t i = 0; i < one.size(); ++i) largest = std::max(largest, length(minus(one[i], other[i])));
    return largest;
}

TEST(RestBendTest, AShellStaysOneWhereItIsAtRest) {
    for (const SolverMethod method : bending_methods) {
        SceneDescription scene = shell(method, 32);
        const std::vector<Vec3> start = scene.cloths[0].start;
        const double kept = largest_distance(simulated(scene, 60), start);
        scene.cloths[0].rest = Rest::flat;
        const double sprung = largest_distance(simulated(scene, 60), start);
        std::printf("[ measured ] method %d: a shell at rest moved by %.1e m, one that is flat at rest by %.1e m\n",
                    static_cast<int>(method), kept, sprung);
        EXPECT_LE(kept, 1e-5);
        EXPECT_GT(sprung, 0.05);
    }
}

/// A quarter of a circle, clamped by its first two columns.
SceneDescription cantilever(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::sheet(17, 3, 0.1, 0.02, substeps);
    scene.solver.method = method;
    scene.gravity = {0, -0.981, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 1000, 200, 1e-2};
    cloth.damping = 60;
    roll(cloth, std::numbers::pi / 2);
    cloth.pins = {test::pin_box(0, 0, 1, 2)};
    return scene;
}

/// Returns by how much (m) a row's last particle is displaced by its weight: each joint of the polygon turns by what
/// the weight behind it asks for, M l/B per width (Castigliano's theorem, for small angles).
Vec3 tip_displacement(const SceneDescription& scene) {
    const Cloth& cloth = scene.cloths[0];
    const std::uint32_t columns = cloth.grid[0];
    const auto at = [&](std::uint32_t column) { return cloth.start[column]; };
    const double chord = length(minus(at(1), at(0))), flat = cloth.size[0] / (columns - 1);
    Vec3 tip{0, 0, 0};
    for (std::uint32_t joint = 1; joint + 1 < columns; ++joint) {
        double moment = 0;  // N m per width
        for (std::uint32_t k = joint + 1; k < columns; ++k)
            moment +=
                cloth.areal_density * flat * (k + 1 < columns ? 1 : 0.5) * scene.gravity[1] * (at(k)[0] - at(joint)[0]);
        // An element's stiffness is B/l^3 of flat cloth, for a difference of an angle times the chord.
        const double turn = moment * flat * flat * flat / (cloth.stiffness.bend.warp * chord * chord);
        const Vec3 arm = minus(at(columns - 1), at(joint));
        tip = plus(tip, {-turn * arm[1], turn * arm[0], 0});
    }
    return tip;
}

TEST(RestBendTest, ACurvedCantileverGivesWayAsABeamDoes) {
    for (const SolverMethod method : bending_methods) {
        const SceneDescription scene = cantilever(method, method == SolverMethod::line ? 16 : 1200);
        const Vec3 wanted = tip_displacement(scene);
        const std::uint32_t tip = scene.cloths[0].grid[0] * 2 - 1;
        const Vec3 found = minus(simulated(scene, 40)[tip], scene.cloths[0].start[tip]);
        std::printf("[ measured ] method %d: the tip moved by (%.3e, %.3e) m, a beam's by (%.3e, %.3e)\n",
                    static_cast<int>(method), found[0], found[1], wanted[0], wanted[1]);
        EXPECT_LE(length(minus(found, wanted)), 0.02 * length(wanted));
        EXPECT_GT(length(wanted), 1e-4);
    }
}

/// Sum of m r x v about the centre, over an inner particle's mass and with v in m per substep.
Vec3 spin(const ClothModel& model, const Twin& twin) {
    const std::vector<Vec3> at = positions_of(twin);
    Vec3 centre{0, 0, 0}, sum{0, 0, 0};
    double mass = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double own = 1 / static_cast<double>(model.free_weight[i]);
        centre = plus(centre, times(own, at[i]));
        mass += own;
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
        const glsl::vec4 moved = twin.cloth(0)[Field::displacement][i];
        const Vec3 way{double{moved.x}, double{moved.y}, double{moved.z}};
        const Vec3 arm = minus(at[i], times(1 / mass, centre));
        sum = plus(sum, times(1 / static_cast<double>(model.free_weight[i]), cross(arm, way)));
    }
    return sum;
}

/// Returns by how much the angular momentum of a cloth that turns changes in so many frames, over what it was.
double change_of_spin(SceneDescription scene, const Vec3& rate, std::uint32_t frames) {
    Cloth& cloth = scene.cloths[0];
    Vec3 centre{0, 0, 0};
    for (const Vec3& at : cloth.start) centre = plus(centre, times(1 / static_cast<double>(cloth.start.size()), at));
    for (const Vec3& at : cloth.start) cloth.velocities.push_back(cross(rate, minus(at, centre)));
    const SimulationModel model(scene);
    Twin twin(model);
    twin.run_frame(1);
    const Vec3 before = spin(model.cloths[0], twin);
    for (std::uint32_t frame = 2; frame <= frames; ++frame) twin.run_frame(frame);
    return length(minus(spin(model.cloths[0], twin), before)) / length(before);
}

/// A shell that turns about an axis across it, or along it, goes on turning: what it is at rest turns with it.
TEST(RestBendTest, AShellThatTurnsGoesOnTurning) {
    for (const SolverMethod method : bending_methods)
        for (const Vec3& rate : {Vec3{0, 0, 6}, Vec3{4, 4, 0}}) {
            const double changed = change_of_spin(shell(method, 32), rate, 60);
            std::printf("[ measured ] method %d: angular momentum changed by %.2e of it\n", static_cast<int>(method),
                        changed);
            // The one pass of relaxation follows bending less exactly than the pulls at its tangents do.
            EXPECT_LE(changed, method == SolverMethod::relax ? 0.02 : 1e-4);
        }
}

/// A roll of one and a half turns, stiff, whose length along the spiral is not the cloth's.
TEST(RestBendTest, ARollThatTurnsGoesOnTurning) {
    for (const SolverMethod method : {SolverMethod::explicit_steps, SolverMethod::line}) {
        SceneDescription scene = test::sheet(17, 17, 1, 1, method == SolverMethod::line ? 20 : 320);
        scene.solver.method = method;
        scene.gravity = {0, 0, 0};
        Cloth& cloth = scene.cloths[0];
        cloth.stiffness = {false, 1000, 100, 0.05};
        cloth.damping = 0;
        cloth.start.clear();
        for (int row = 0; row < 17; ++row)
            for (int column = 0; column < 17; ++column) {
                const double turn = 3 * std::numbers::pi * column / 16, radius = 0.06 + 0.02 * turn;
                cloth.start.push_back({radius * std::cos(turn), 0.5 * row / 16, radius * std::sin(turn)});
            }
        cloth.placement = {};
        cloth.rest = Rest::start;
        const double changed = change_of_spin(scene, {0, 3, 0}, 40);
        std::printf("[ measured ] roll, method %d: angular momentum changed by %.2e of it\n", static_cast<int>(method),
                    changed);
        EXPECT_LE(changed, 1e-3);
    }
}

/// The strand that is left of a cloth cut along a row of particles has no side: it bends as much as at rest, any way.
TEST(RestBendTest, AStrandIsAsLongAtRestAnyWayItBends) {
    const glsl::vec3 rest{0, 0.3f, 0.4f}, along{1, 0, 0}, none{0, 0, 0}, now{0, -2, 0};
    const glsl::vec4 coordinates = glsl::rest_coordinates(rest, glsl::Tangents(along, none));
    const glsl::vec3 difference = glsl::rest_difference(coordinates, glsl::Tangents(along, none), now);
    EXPECT_FLOAT_EQ(difference.y, -0.5f);
    EXPECT_EQ(difference.x, 0);
    EXPECT_EQ(difference.z, 0);
    EXPECT_EQ(glsl::rest_pull(coordinates, glsl::Tangents(along, none), now).row.y, 0);
    const glsl::vec3 straight = glsl::rest_difference(coordinates, glsl::Tangents(along, none), none);
    EXPECT_EQ(straight.y, 0);
}

/// Returns the total energy that statistics state, J, and the kinetic one.
std::pair<double, double> stated_energy(const SimulationModel& model, const Twin& twin, std::uint32_t frame) {
    const ClothStatistics statistics = cloth_statistics(
        model, model.cloths[0], twin_statistics(model, 0, twin.cloth(0), frame_inputs(model, frame)), frame);
    return {statistics.kinetic_energy + statistics.potential_energy + statistics.elastic_energy,
            statistics.kinetic_energy};
}

TEST(RestBendTest, StatedEnergyIsKeptByAFreeSheetThatUnbendsOrSwings) {
    for (const Rest rest : {Rest::flat, Rest::start}) {
        SceneDescription scene = test::sheet(13, 13, 0.6, 0.6, 600);
        scene.solver.method = SolverMethod::explicit_steps;
        scene.solver.strain_damping = 0;
        scene.gravity = {0, 0, 0};
        Cloth& cloth = scene.cloths[0];
        cloth.stiffness = {false, 1000, 100, 1e-2};
        cloth.damping = 0;
        roll(cloth, 3);
        cloth.rest = rest;
        if (rest == Rest::start)
            for (const Vec3& at : cloth.start) cloth.velocities.push_back({0, std::cos(9 * at[0] + 4 * at[2]), 0});
        const SimulationModel model(scene);
        Twin twin(model);
        const double start = stated_energy(model, twin, 0).first;
        double worst = 0, kinetic = 0;
        for (std::uint32_t frame = 1; frame <= 30; ++frame) {
            twin.run_frame(frame);
            const auto [total, motion] = stated_energy(model, twin, frame);
            worst = std::max(worst, std::abs(total - start));
            kinetic = std::max(kinetic, motion);
        }
        std::printf("[ measured ] energy of %.4f J, of which %.4f J move, errs by %.1e J\n", start, kinetic, worst);
        EXPECT_GT(kinetic, 0.5 * start);
        EXPECT_LE(worst, 1e-4 * start);
    }
}

}  // namespace
}  // namespace drape
