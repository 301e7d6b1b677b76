// The twin follows cloth that starts in a given shape, and cloth of cells that differ, by every method and kernel.
#include <gtest/gtest.h>

#include <cmath>

#include "drape/scene_reader.h"
#include "support/meshes.h"
#include "support/self_contact_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;

/// Gives a cloth a folded start: waves along its rows, the last third laid back over the middle one.
void fold(Cloth& cloth) {
    const auto [columns, rows] = cloth.grid;
    const double dx = cloth.size[0] / (columns - 1), dy = cloth.size[1] / (rows - 1);
    cloth.start.clear();
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t turn = 2 * columns / 3, along = column < turn ? column : 2 * turn - column;
            const double height = column < turn ? 0 : 0.04 + 0.01 * std::sin(0.3 * row);
            cloth.start.push_back(
                {0.95 * dx * along - 0.5, height + 0.02 * std::sin(0.7 * row + 0.2 * column), 0.97 * dy * row - 0.4});
        }
    cloth.placement = {};
}

/// Gives a cloth's cells stiffnesses down to a tenth, and densities up to five times its own.
void vary(Cloth& cloth) {
    const std::size_t count = std::size_t{cloth.grid[0] - 1} * (cloth.grid[1] - 1);
    cloth.cell_stiffness.clear();
    cloth.cell_density.clear();
    for (std::size_t cell = 0; cell < count; ++cell) {
        cloth.cell_stiffness.push_back(0.1f + 0.9f * static_cast<float>(cell * 37 % 101) / 100.0f);
        cloth.cell_density.push_back(1 + 4 * static_cast<float>(cell * 53 % 97) / 96.0f);
    }
}

/// Gives each particle of a cloth a velocity of its own, m/s.
void throw_apart(Cloth& cloth) {
    cloth.velocities.clear();
    for (std::uint32_t particle = 0; particle < cloth.grid[0] * cloth.grid[1]; ++particle)
        cloth.velocities.push_back({0.3 * std::sin(0.1 * particle), 0.01 * (particle % 7), 0.4 * std::cos(particle)});
}

/// Gives a cloth's particles frictions up to twice its own, and thicknesses down to nothing.
void vary_skin(Cloth& cloth) {
    cloth.particle_friction.clear();
    cloth.particle_thickness.clear();
    for (std::uint32_t particle = 0; particle < cloth.grid[0] * cloth.grid[1]; ++particle) {
        cloth.particle_friction.push_back(2 * static_cast<float>(particle * 37 % 101) / 100.0f);
        cloth.particle_thickness.push_back(static_cast<float>(particle * 53 % 97) / 96.0f);
    }
}

constexpr SolverMethod methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

TEST(TwinGivenTest, AFoldedStart) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        scene.cloths[0].stiffness.bend = 1e-4;
        fold(scene.cloths[0]);
        compare(scene);
    }
}

TEST(TwinGivenTest, AVelocityOfEachParticle) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        fold(scene.cloths[0]);
        throw_apart(scene.cloths[0]);
        compare(scene);
    }
}

/// Each spring then has a length at rest of its own, and each element that bends a difference. The cloth hangs on pins
/// that move and let go.
TEST(TwinGivenTest, AFoldedStartThatIsAtRest) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        if (method != SolverMethod::explicit_steps) scene.solver.iterations = 2;
        scene.cloths[0].stiffness.bend = 1e-4;
        fold(scene.cloths[0]);
        scene.cloths[0].rest = Rest::start;
        compare(scene);
        if (method != SolverMethod::line) continue;
        scene.colliders = {};  // of second order
        compare(scene);
    }
}

/// Grids that fill tiles and strips; their statistics, too.
TEST(TwinGivenTest, AFoldedStartThatIsAtRestAlone) {
    for (const SolverMethod method : methods)
        for (const auto& grid : {std::pair{32u, 32u}, {49u, 25u}}) {
            SceneDescription scene = test::thrown_sheet(grid, 8);
            scene.solver.method = method;
            fold(scene.cloths[0]);
            scene.cloths[0].rest = Rest::start;
            compare(scene, {}, test::gpu().device, {.drawing = true, .statistics = method == SolverMethod::relax});
        }
}

/// Those that rest as they start are simulated together, the flat one beside them.
TEST(TwinGivenTest, ClothsTogetherOfWhichSomeRestAsTheyStart) {
    SceneDescription scene = test::everything_in_lines();
    for (const char* const name : {"second", "third"}) {
        scene.cloths.push_back(scene.cloths[0]);
        scene.cloths.back().name = name;
        fold(scene.cloths.back());
        scene.cloths.back().rest = Rest::start;
    }
    for (Vec3& at : scene.cloths[2].start) at[1] *= 1.5;
    compare(scene);
}

TEST(TwinGivenTest, AFoldedStartThatMeetsItself) {
    SceneDescription scene = test::everything_in_lines();
    fold(scene.cloths[0]);
    scene.cloths[0].self_collision.emplace();
    EXPECT_GT(compare(scene).most_pairs, 0u);
}

/// All that gives springs and particles numbers of their own acts at once.
TEST(TwinGivenTest, AllThatDiffersAtOnce) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        Cloth& cloth = scene.cloths[0];
        cloth.stiffness.bend = 1e-4;
        fold(cloth);
        cloth.rest = Rest::start;
        cloth.stiffness_keys = {{0.004, 1}, {0.02, 0.25}, {0.1, 0.5}};
        vary(cloth);
        vary_skin(cloth);
        compare(scene);
        if (method != SolverMethod::line) continue;
        cloth.self_collision.emplace();
        EXPECT_GT(compare(scene).most_pairs, 0u);
    }
}

/// A disc with a hole, whose rim's cells are uneven: lengths, masses and constants of their own, and bending that is at
/// rest on the panel, not in the folded start.
TEST(TwinGivenTest, AnOutline) {
    const SceneDescription outlined = parse_scene(
        R"({"cloths": [{"outline": {"path": "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0ZM0-.1h.2v.2h-.2z", "spacing": 0.03},
            "placement": {"origin": [0, 0.1, 0], "v": [0, 0, 1]}, "stiffness": {"bend": 1e-4},
            "pins": [{"point": [0.4, 0.3], "release": 0.05}, {"point": [-0.4, 0.3]}]}]})");
    for (const SolverMethod method : methods)
        for (const bool folded : {false, true}) {
            SceneDescription scene = test::everything();
            scene.solver.method = method;
            scene.cloths = outlined.cloths;
            Cloth& cloth = scene.cloths[0];
            if (folded) fold(cloth);
            compare(scene, {}, test::gpu().device, {.drawing = true, .statistics = method == SolverMethod::relax});
        }
}

TEST(TwinGivenTest, StiffnessAndDensityByCell) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        scene.cloths[0].stiffness.bend = 1e-3;
        scene.cloths[0].stiffness.compression = 0.3;
        vary(scene.cloths[0]);
        compare(scene);
        if (method == SolverMethod::line) {
            scene.colliders = {};  // of second order
            compare(scene);
        }
    }
}

TEST(TwinGivenTest, StiffnessAndDensityByCellWithoutBendingInSeveralIterations) {
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::line}) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        scene.solver.iterations = 2;
        vary(scene.cloths[0]);
        scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{25, 15}, {26, 16}}};
        compare(scene);
    }
}

/// Grids that fill tiles and strips; their statistics, too.
TEST(TwinGivenTest, StiffnessAndDensityByCellAlone) {
    for (const SolverMethod method : methods)
        for (const auto& grid : {std::pair{32u, 32u}, {49u, 25u}}) {
            SceneDescription scene = test::thrown_sheet(grid, 8);
            scene.solver.method = method;
            vary(scene.cloths[0]);
            compare(scene, {}, test::gpu().device, {.drawing = true, .statistics = method == SolverMethod::relax});
        }
}

TEST(TwinGivenTest, FrictionAndThicknessByParticle) {
    for (const SolverMethod method : methods) {
        SceneDescription scene = test::everything();
        scene.solver.method = method;
        scene.cloths[0].thickness = 0.02;
        vary_skin(scene.cloths[0]);
        compare(scene);
        scene.colliders.push_back({test::mesh_of(test::box_mesh({0.1, 0.15, 0.1}), {0.1, -0.3, 0.1})});
        compare(scene);
        scene.cloths[0].contact = ContactOf::particles;
        scene.cloths[0].thickness = 0.05;
        compare(scene);
    }
}

/// Small and fast colliders, more than are read early, are met on the particles' ways.
TEST(TwinGivenTest, ThicknessByParticleOfClothThatGoesFar) {
    SceneDescription scene = test::everything_in_lines();
    scene.solver.substeps = 2;
    scene.colliders.clear();
    for (int k = 0; k < 12; ++k)
        scene.colliders.push_back({Sphere{{-0.5 + 0.09 * k, -0.15, 0.08 * (k % 5) - 0.2}, 0.02 + 0.002 * k}});
    scene.cloths[0].velocity = {0, -6, 0};
    scene.cloths[0].thickness = 0.03;
    vary_skin(scene.cloths[0]);
    compare(scene);
}

TEST(TwinGivenTest, FrictionAndThicknessBetweenLayers) {
    SceneDescription fold = test::fold(17, 0.5, SolverMethod::line, 16);
    fold.cloths[0].velocity = {0, -4, 0};
    vary_skin(fold.cloths[0]);
    EXPECT_GT(compare(fold).most_pairs, 20u);
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps}) {
        SceneDescription scene = test::layers(method, method == SolverMethod::line ? 16 : 40);
        for (Cloth& cloth : scene.cloths) cloth.velocity = {0, -2, 0};
        vary_skin(scene.cloths[1]);
        EXPECT_GT(compare(scene).most_pairs, 20u);
    }
}

TEST(TwinGivenTest, ClothsTogetherOfWhichEachHasItsOwnSkin) {
    SceneDescription scene = test::everything_in_lines();
    vary_skin(scene.cloths[0]);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    scene.cloths[1].friction = 0.7;
    scene.cloths[1].particle_thickness.clear();
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[2].name = "third";
    scene.cloths[2].thickness = 0.03;
    scene.cloths[2].particle_friction.assign(scene.cloths[2].particle_friction.size(), 0.5f);
    compare(scene);
}

TEST(TwinGivenTest, ClothsTogetherOfWhichEachHasItsOwnShape) {
    SceneDescription scene = test::everything_in_lines();
    vary(scene.cloths[0]);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    fold(scene.cloths[1]);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[2].name = "third";
    scene.cloths[2].cell_stiffness.assign(scene.cloths[2].cell_stiffness.size(), 0.5f);
    compare(scene);
}

}  // namespace
}  // namespace drape
