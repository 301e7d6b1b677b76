// Contact with triangle meshes on the device against the twin, by every method.
#include "support/meshes.h"
#include "support/self_contact_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;
using test::everything;
using test::mesh_of;

/// A ring that turns and rises, a box at rest, and an open bowl, beside some analytic kinds.
std::vector<Collider> meshes() {
    Collider ring{mesh_of(test::torus_mesh(0.2, 0.08, 24), {-0.2, -0.2, 0.05})};
    ring.path.keys = {{0, {0, 0, 0}, {}}, {0.3, {0.05, 0.1, 0}, {20, 90, 10}}};
    Collider bowl{mesh_of(test::ball_mesh(0.15, 16), {0.3, -0.25, -0.2}, 0.02)};
    bowl.rotate = {10, 0, 30};
    const Collider box{mesh_of(test::box_mesh({0.1, 0.15, 0.1}), {0.25, -0.3, 0.25})};
    return {ring, box, bowl, {Sphere{{-0.35, -0.3, -0.3}, 0.1}}, {Plane{{0, 1, 0}, -0.4}}};
}

SceneDescription everything_on_meshes(SolverMethod method) {
    SceneDescription scene = everything();
    scene.solver.method = method;
    scene.colliders = meshes();
    return scene;
}

TEST(TwinMeshTest, Relax) { compare(everything_on_meshes(SolverMethod::relax)); }
TEST(TwinMeshTest, Line) { compare(everything_on_meshes(SolverMethod::line)); }

TEST(TwinMeshTest, Explicit) {
    SceneDescription scene = everything_on_meshes(SolverMethod::explicit_steps);
    scene.solver.substeps = 60;
    compare(scene);
}

/// A ball that becomes longer and turns on a path, a ring that swells, and a bowl that tilts, beside meshes that keep
/// their form.
std::vector<Collider> deforming_meshes() {
    Collider ball{
        test::deforming_mesh(test::ball_mesh(0.15, 16), {-0.2, -0.2, 0.05}, 8, 24, [](const Vec3& at, auto k) {
            return Vec3{at[0] * (1 + 0.1 * double(k)), at[1] * (1 + 0.05 * double(k)),
                        at[2] + 0.3 * double(k) * at[0] * at[0]};
        })};
    ball.path.keys = {{0, {0, 0, 0}, {}}, {0.3, {0.05, 0.1, 0}, {20, 90, 10}}};
    const auto swollen = [](const Vec3& at, auto k) { return Vec3{at[0], at[1] * (1 + 0.2 * double(k)), at[2]}; };
    Mesh ring = test::deforming_mesh(test::torus_mesh(0.2, 0.06, 24), {0.25, -0.2, 0.25}, 3, 30, swollen);
    ring.loop = true;
    ring.frames_start = 0.05;
    const auto tilted = [](const Vec3& at, auto k) { return Vec3{at[0], at[1] + 0.1 * double(k) * at[0], at[2]}; };
    const Mesh bowl = test::deforming_mesh(test::ball_mesh(0.15, 16), {0.3, -0.25, -0.2}, 12, 60, tilted, 0.02);
    std::vector<Collider> all = meshes();
    all.insert(all.begin() + 1, {ball, {ring}, {bowl}});
    return all;
}

SceneDescription everything_on_deforming(SolverMethod method) {
    SceneDescription scene = everything_on_meshes(method);
    scene.colliders = deforming_meshes();
    return scene;
}

/// By the default device's kernels alone, since every run makes the meshes' forms of its own, which takes long.
void compare_deforming(const SceneDescription& scene) {
    compare(scene, {}, test::gpu().device, {.drawing = true}, stream_kernels);
}

TEST(TwinMeshTest, DeformingByRelax) { compare_deforming(everything_on_deforming(SolverMethod::relax)); }
TEST(TwinMeshTest, DeformingByLine) { compare(everything_on_deforming(SolverMethod::line)); }

TEST(TwinMeshTest, DeformingByExplicit) {
    SceneDescription scene = everything_on_deforming(SolverMethod::explicit_steps);
    scene.solver.substeps = 60;
    compare_deforming(scene);
}

TEST(TwinMeshTest, DeformingOnALongWay) {
    SceneDescription scene = everything_on_deforming(SolverMethod::line);
    scene.solver.substeps = 2;
    scene.cloths[0].velocity = {0, -12, 0};
    scene.cloths[0].thickness = 0.002;
    compare_deforming(scene);
}

TEST(TwinMeshTest, WithEdgesOfABox) {
    SceneDescription scene = everything_on_meshes(SolverMethod::line);
    scene.colliders.push_back({Box{{0, -0.2, -0.3}, {0.1, 0.05, 0.1}}, 0.3, {10, 20, 30}});
    compare(scene);
}

TEST(TwinMeshTest, MoreCollidersThanAreReadEarly) {
    SceneDescription scene = everything_on_meshes(SolverMethod::line);
    for (int k = 0; k < 8; ++k)
        scene.colliders.push_back({mesh_of(test::ball_mesh(0.05, 8), {-0.4 + 0.1 * k, -0.25, 0.1 * (k % 3)})});
    compare(scene);
}

/// Thin walls, and particles that move by many times their thickness in a substep.
TEST(TwinMeshTest, OnALongWay) {
    SceneDescription scene = everything_on_meshes(SolverMethod::line);
    scene.solver.substeps = 2;
    scene.cloths[0].velocity = {0, -12, 0};
    scene.cloths[0].thickness = 0.002;
    compare(scene);
}

TEST(TwinMeshTest, ClothThatMeetsItself) {
    SceneDescription scene = test::fold(17, 0.5, SolverMethod::line, 16);
    scene.cloths[0].velocity = {0, -4, 0};
    scene.colliders.push_back({mesh_of(test::torus_mesh(0.15, 0.06, 24), {0, 0.1, 0})});
    EXPECT_GT(compare(scene).most_pairs, 20u) << "nothing met";
}

/// Colliders that bounds say are farther away are left out, to the same bits.
TEST(TwinMeshTest, WithoutSkips) {
    ModelOptions all;
    all.skip = false;
    compare(everything_on_meshes(SolverMethod::line), all);
}

}  // namespace
}  // namespace drape
