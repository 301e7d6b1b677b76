// The air is shared like mass: what is symmetric stays so, and cuts change nothing about how cloth falls.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "base/vectors.h"
#include "drape/fabric.h"
#include "support/sheets.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr std::array whole_methods{SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

Vec3 xyz_of(const glsl::vec4& v) { return {double(v.x), double(v.y), double(v.z)}; }

/// Returns the force of the wind on each particle of the first cloth, N, in its present state.
std::vector<Vec3> wind_forces(const SimulationModel& model, Twin& twin) {
    twin.run_step({StepKind::wind, 0, 0}, frame_inputs(model, 1));
    std::vector<Vec3> forces;
    for (const glsl::vec4& force : twin.cloth(0)[Field::wind_force]) forces.push_back(xyz_of(force));
    return forces;
}

Vec3 sum_of(const std::vector<Vec3>& all) {
    Vec3 sum{};
    for (const Vec3& each : all) sum = plus(sum, each);
    return sum;
}

void move_all(const SimulationModel& model, Twin& twin, const Vec3& velocity) {
    const double h = model.cloths[0].substep_length;
    for (glsl::vec4& moved : twin.cloth(0)[Field::displacement])
        moved = {float(velocity[0] * h), float(velocity[1] * h), float(velocity[2] * h), 0};
}

/// A square sheet that lies level about the origin in still air.
SceneDescription level_square(std::uint32_t particles, double size, SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::sheet(particles, particles, size, size, substeps);
    scene.solver.method = method;
    scene.wind.velocity = {1e-9, 0, 0};
    set_fabric(scene.cloths[0], *find_fabric("cotton"));
    scene.cloths[0].placement = {{-size / 2, 0, -size / 2}, {1, 0, 0}, {0, 0, 1}};
    return scene;
}

/// Returns how far, m, particles are at most from where their images under the symmetries of the square put them.
double unsymmetric(const std::vector<glsl::vec4>& position, int n) {
    const auto at = [&](int i, int j) { return xyz_of(position[static_cast<std::size_t>(j * n + i)]); };
    double worst = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Vec3 own = at(i, j), across = at(n - 1 - i, j), down = at(i, n - 1 - j), turned = at(j, i);
            for (const Vec3& image : {Vec3{-across[0], across[1], across[2]}, Vec3{down[0], down[1], -down[2]},
                                      Vec3{turned[2], turned[1], turned[0]}})
                worst = std::max(worst, length(minus(own, image)));
        }
    return worst;
}

TEST(WindShare, ASquareThatFallsFlatKeepsItsSymmetry) {
    for (const SolverMethod method : whole_methods)
        for (const auto& [particles, substeps] :
             {std::pair{5u, 1u}, {9u, 4u}, {9u, 256u}, {17u, 16u}, {33u, 8u}, {65u, 2u}}) {
            const SceneDescription scene = level_square(particles, 0.3, method, substeps);
            const SimulationModel model(scene);
            Twin twin(model);
            for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
            const auto& position = twin.cloth(0)[Field::position];
            const double fallen = -double(position[0].y), off = unsymmetric(position, static_cast<int>(particles));
            std::printf("[ measured ] %s, %u particles, %u substeps: fell %.3f m, unsymmetric by %.2e m\n",
                        std::string(named(method).name).c_str(), particles, substeps, fallen, off);
            EXPECT_GT(fallen, 0.5);
            EXPECT_LT(off, 2e-6);
        }
}

TEST(WindShare, ClothThatHangsInWindStraightOnStaysSymmetric) {
    for (const std::uint32_t particles : {9u, 17u, 33u}) {
        SceneDescription scene = test::sheet(particles, particles, 0.5, 0.5, 16);
        scene.solver.method = SolverMethod::line;
        scene.wind.velocity = {0, 0, 2};
        Cloth& cloth = scene.cloths[0];
        set_fabric(cloth, *find_fabric("cotton"));
        cloth.placement.origin = {-0.25, 0, 0};
        cloth.pins = {test::pin_top(cloth)};
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
        const auto& position = twin.cloth(0)[Field::position];
        double off = 0, blown = 0;
        for (std::size_t i = 0; i < position.size(); ++i) {
            const std::size_t row = i / particles, column = i % particles;
            const Vec3 own = xyz_of(position[i]), other = xyz_of(position[(row + 1) * particles - 1 - column]);
            off = std::max(off, length(minus(own, {-other[0], other[1], other[2]})));
            blown = std::max(blown, own[2]);
        }
        std::printf("[ measured ] %u particles: blown %.3f m, unsymmetric by %.2e m\n", particles, blown, off);
        EXPECT_GT(blown, 0.3);
        EXPECT_LT(off, 5e-6);
    }
}

/// Returns the force on a triangle (N) by the scene format's law.
Vec3 force_on_triangle(const Wind& wind, const Vec3& relative, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 doubled = cross(minus(b, a), minus(c, a));
    const double area = length(doubled) / 2;
    Vec3 normal = times(0.5 / area, doubled);
    if (dot(normal, relative) < 0) normal = times(-1, normal);
    return times(0.5 * wind.air_density * area, plus(times((wind.drag - wind.lift) * dot(relative, normal), relative),
                                                     times(wind.lift * dot(relative, relative), normal)));
}

TEST(WindShare, ForcesAddUpToThoseOnTheTrianglesOfBothDiagonals) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int draw = 0; draw < 50; ++draw) {
        SceneDescription scene = test::sheet(7, 6, 0.6, 0.5, 4);
        scene.wind.velocity = {3 * unit(random), 3 * unit(random), 3 * unit(random)};
        scene.wind.drag = 1 + 0.4 * unit(random), scene.wind.lift = 0.5 + 0.4 * unit(random);
        const SimulationModel model(scene);
        Twin twin(model);
        std::vector<glsl::vec4>& position = twin.cloth(0)[Field::position];
        for (glsl::vec4& at : position)
            at = {at.x + float(0.01 * unit(random)), at.y + float(0.01 * unit(random)), float(0.03 * unit(random)),
                  at.w};
        const Vec3 velocity{unit(random), unit(random), unit(random)};
        move_all(model, twin, velocity);
        const Vec3 felt = sum_of(wind_forces(model, twin)), relative = minus(scene.wind.velocity, velocity);
        Vec3 stated{};
        for (std::size_t row = 0; row < 5; ++row)
            for (std::size_t column = 0; column < 6; ++column) {
                const std::size_t first = row * 7 + column;
                const Vec3 a = xyz_of(position[first]), b = xyz_of(position[first + 1]),
                           c = xyz_of(position[first + 7]), d = xyz_of(position[first + 8]);
                for (const auto& [p, q, r] : {std::array{a, b, c}, {b, d, c}, {a, b, d}, {a, d, c}})
                    stated = plus(stated, times(0.5, force_on_triangle(scene.wind, relative, p, q, r)));
            }
        EXPECT_LT(length(minus(felt, stated)), 1e-5 * length(stated)) << draw;
    }
}

TEST(WindShare, ACellThatMovesWithoutTurningIsNotTurned) {
    // On a parallelogram, all four corners feel the same, so there is no torque about its centre.
    SceneDescription scene = test::sheet(2, 2, 0.3, 0.2, 4);
    scene.wind.velocity = {1, -2, 0.7};
    const SimulationModel model(scene);
    Twin twin(model);
    std::vector<glsl::vec4>& position = twin.cloth(0)[Field::position];
    const Vec3 u{0.28, 0.03, -0.1}, v{0.05, -0.17, 0.06};
    for (std::size_t k = 0; k < 4; ++k) {
        const double i = double(k % 2), j = double(k / 2);
        position[k] = {float(i * u[0] + j * v[0]), float(i * u[1] + j * v[1]), float(i * u[2] + j * v[2]),
                       position[k].w};
    }
    move_all(model, twin, {0.3, 0.4, -0.5});
    const std::vector<Vec3> forces = wind_forces(model, twin);
    for (const Vec3& force : forces) EXPECT_LT(length(minus(force, forces[0])), 1e-6 * length(forces[0]));
}

/// Cuts a cloth's springs after the given columns and rows, as a blade across the whole of it would.
void cut_after(Twin& twin, const std::vector<std::uint32_t>& columns, const std::vector<std::uint32_t>& rows) {
    CutTopology& topology = twin.topology(0);
    const Grid& grid = topology.grid();
    CutFindings found{std::vector<std::uint32_t>(2 * grid.cells().size(), 0),
                      std::vector<glsl::vec4>(grid.particle_count(), {-1, -1, -1, -1})};
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            glsl::vec4& fractions = found.fractions[grid.particle(column, row)];
            if (std::ranges::count(columns, column)) fractions.x = fractions.z = 0.5f;
            if (column > 0 && std::ranges::count(columns, column - 1)) fractions.w = 0.5f;
            if (std::ranges::count(rows, row)) fractions.y = fractions.z = fractions.w = 0.5f;
        }
    topology.apply(found);
}

TEST(WindShare, CutClothFallsAsFastAsWholeCloth) {
    const std::vector<std::uint32_t> all{0, 1, 2, 3, 4, 5, 6, 7};
    using Cuts = std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>;
    for (const auto& [columns, rows] : {Cuts{{}, {}}, {{3}, {}}, {{2, 5}, {4}}, {all, {}}, {{}, all}, {all, all}}) {
        // At the terminal velocity Cd rho v^2/2 = sigma g, the air carries each particle's own weight.
        const SceneDescription scene = level_square(9, 0.3, SolverMethod::line, 8);
        const SimulationModel model(scene);
        Twin twin(model);
        if (!columns.empty() || !rows.empty()) cut_after(twin, columns, rows);
        const double density = scene.cloths[0].areal_density, terminal = std::sqrt(2 * density * 9.81 / 1.2);
        move_all(model, twin, {0, -terminal, 0});
        const std::vector<Vec3> forces = wind_forces(model, twin);
        for (std::size_t i = 0; i < forces.size(); ++i) {
            const double weight = 9.81 * model.cloths[0].inner_mass / double(model.cloths[0].free_weight[i]);
            EXPECT_LT(length(minus(forces[i], {0, weight, 0})), 1e-5 * weight) << i;
        }
    }
}

TEST(WindShare, AThreadAndACrumbFaceTheWind) {
    // However they lie: a thread as what of the wind is square to it, a crumb wholly.
    const SceneDescription scene = [] {
        SceneDescription made = level_square(4, 0.3, SolverMethod::line, 8);
        made.wind.velocity = {1, 2, -0.5};
        made.wind.drag = made.wind.lift = 1;
        return made;
    }();
    const SimulationModel model(scene);
    const Vec3 wind = scene.wind.velocity;
    const double pressure = 0.6 * dot(wind, wind), cell = 0.01;
    for (const bool crumbs : {false, true}) {
        Twin twin(model);
        cut_after(twin, {0, 1, 2}, crumbs ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{});
        move_all(model, twin, {0, 0, 0});
        const Vec3 felt = wind_forces(model, twin)[5];  // an inner particle, with four quarters
        const Vec3 square = {wind[0], wind[1], 0};      // threads run along z
        const Vec3 stated =
            crumbs ? times(pressure * cell / length(wind), wind) : times(pressure * cell / length(square), square);
        EXPECT_LT(length(minus(felt, stated)), 1e-5 * length(stated)) << crumbs;
    }
}

}  // namespace
}  // namespace drape
