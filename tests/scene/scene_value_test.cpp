// A well-formed scene becomes the right values.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "drape/fabric.h"
#include "drape/scene_reader.h"
#include "full_scene.h"
#include "mesh/mesh_sequence.h"
#include "world/cloth_keys.h"
#include "world/collider_pose.h"

namespace drape {
namespace {

SceneDescription scene_of(std::string_view text) {
    const SceneResult result = read_scene_text(text, "scene.json");
    for (const SceneError& error : result.errors) ADD_FAILURE() << error.text();
    return result.scene.value_or(SceneDescription{});
}

TEST(SceneValues, SettingsOfTheFullScene) {
    const SceneDescription scene = scene_of(testing::full_scene);
    EXPECT_EQ(scene.name, "everything");
    EXPECT_EQ(scene.time, (TimeSettings{30, 12}));
    EXPECT_EQ(scene.up, Up::z);
    EXPECT_EQ(scene.gravity, (Vec3{0.5, -1.62, 0.25}));
    EXPECT_EQ(scene.gravity_keys, (std::vector<VectorKey>{{0, {0.5, -1.5, 0.25}}, {1, {0, 0, -2}}}));
    EXPECT_EQ(scene.cloths[3].stiffness_keys, (std::vector<FactorKey>{{0.25, 1}, {1.5, 0.125}}));
    const std::vector<VectorKey> wind_keys{{0, {1, 2, 2}}, {0.5, {0, 4, 3}}};
    EXPECT_EQ(scene.wind, (Wind{{3, 0, 4}, {2, 1.5, 7}, 1.1, 0.9, 0.4, wind_keys}));
    EXPECT_EQ(scene.overlap, Overlap::refuse);
    EXPECT_TRUE(scene.forces);
    EXPECT_EQ(scene.solver,
              (SolverSettings{SolverMethod::relax, 11, 3, 0.01, 0.2, 0.03, false, CollideWhen::substep, true, 0.05}));
    EXPECT_EQ(
        scene.camera,
        (Camera{{1, 1.5, 2}, {0.5, 1, 0}, 55, {0, 1, 0}, {{0, {1, 2, 3}, {0, 1, 0}}, {2, {3, 2, 1}, {0, 0, 1}}}}));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0], (DirectionalLight{{0, -1, 0}, {1, 0.5, 0.25}, 0.75}));
    EXPECT_EQ(scene.ambient, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(scene.ambient_ground, (Vec3{0.3, 0.2, 0.1}));
    EXPECT_EQ(scene.image, (ImageSettings{{640, 360}, 1, {0, 0.5, 1}, false, false, true, 4}));
    ASSERT_EQ(scene.oracles.size(), 1u);
    EXPECT_EQ(scene.oracles[0],
              (Oracle{"falls", {{"cloth", 0}, {"from_row", 1}, {"until_frame", 10}, {"error", 1.05}}}));
}

TEST(SceneValues, ClothOfTheFullScene) {
    const SceneDescription scene = scene_of(testing::full_scene);
    ASSERT_EQ(scene.cloths.size(), 4u);
    const Cloth& cloth = scene.cloths[0];
    EXPECT_EQ(cloth.name, "banner");
    EXPECT_EQ(cloth.grid, (std::array<std::uint32_t, 2>{96, 64}));
    EXPECT_EQ(cloth.size, (std::array<double, 2>{1.5, 2.5}));
    EXPECT_EQ(cloth.placement, (Placement{{0.25, 20, 0}, {0, 0, 1}, {0, -1, 0}, {1.5, 0.5}, 0.001, 3}));
    EXPECT_EQ(cloth.areal_density, 0.15);
    EXPECT_EQ(cloth.stiffness, (Stiffness{false, {2000, 1500}, 150, {1e-5, 2e-5, 3e-5}}));
    EXPECT_EQ(cloth.damping, 0.1);
    EXPECT_EQ(cloth.friction, 0.35);
    EXPECT_EQ(cloth.thickness, 0.004);
    EXPECT_EQ(cloth.contact, ContactOf::particles);
    EXPECT_EQ(cloth.self_collision, (SelfCollision{0.006, 0.25}));
    EXPECT_EQ(cloth.velocity, (Vec3{1, 2, 3}));
    ASSERT_EQ(cloth.holes.size(), 1u);
    EXPECT_EQ(cloth.holes[0], (IndexBox{{40, 20}, {50, 30}}));
    Appearance look = cloth.appearance;
    ASSERT_TRUE(look.image);
    EXPECT_EQ(look.image->rgb.size(), std::size_t{3} * look.image->width * look.image->height);
    EXPECT_TRUE(look.texture.ends_with("cells.png"));
    look.image = nullptr, look.texture.clear();
    EXPECT_EQ(
        look,
        (Appearance{{0.1, 0.2, 0.3}, Vec3{0.4, 0.5, 0.6}, Pattern::stripes, {0.7, 0.8, 0.9}, 0.5, 0.4, 0.002, 0.03}));
    EXPECT_EQ(scene.cloths[2].tear, (Tear{{}, 300.0}));
    EXPECT_EQ(scene.cloths[3].tear, (Tear{0.4, {}}));
    EXPECT_TRUE(scene.cloths[1].stiffness.rigid);
    EXPECT_EQ(scene.cloths[1].name, "rigid-one");
}

TEST(SceneValues, LoadsOfTheFullScene) {
    const SceneDescription scene = scene_of(testing::full_scene);
    const std::vector<Load>& loads = scene.cloths[0].loads;
    ASSERT_EQ(loads.size(), 4u);
    EXPECT_EQ(loads[0].particles, (IndexBox{{95, 0}, {95, 63}}));
    EXPECT_EQ(loads[0].force, (Vec3{1, 2, -3}));
    EXPECT_FALSE(loads[0].presses());
    EXPECT_EQ(loads[1].particles, (IndexBox{{0, 0}, {95, 63}})) << "all, where nothing says which";
    EXPECT_EQ(loads[1].force_keys, (std::vector<VectorKey>{{0, {0, 0, 0}}, {0.5, {0, 0, 4}}}));
    EXPECT_EQ(loads[2].particles, (IndexBox{{5, 6}, {5, 6}}));
    EXPECT_EQ(loads[2].pressure, -2.5);
    EXPECT_EQ(loads[3].particles, (IndexBox{{1, 2}, {3, 4}}));
    EXPECT_EQ(loads[3].pressure_keys, (std::vector<NumberKey>{{0, 0}, {1, 7}}));
    EXPECT_TRUE(loads[3].presses());
    // Particles lie on the corners of its pixels.
    ASSERT_EQ(scene.cloths[3].loads[0].factors.size(), 15u);
    EXPECT_EQ(scene.cloths[3].loads[0].factors[1], 0.5f);
}

TEST(SceneValues, FullScenesHaveEveryKeyOfACloth) {
    std::array<bool, cloth_key_count> set{};
    std::vector<Cloth> cloths = scene_of(testing::full_scene).cloths;
    cloths.push_back(scene_of(testing::outlined_scene).cloths.at(0));
    for (const Cloth& cloth : cloths) {
        const auto differs = differences(cloth, Cloth{});
        for (std::size_t k = 0; k < set.size(); ++k) set[k] = set[k] || differs[k];
    }
    for (const ClothKey key : cloth_keys) EXPECT_TRUE(set[static_cast<std::size_t>(key)]) << pointer_of(key);
}

TEST(SceneValues, FilesOfTheFullScene) {
    const SceneDescription scene = scene_of(testing::full_scene);
    const Cloth& given = scene.cloths[2];
    ASSERT_EQ(given.start.size(), 15u);
    EXPECT_EQ(given.start[0], (Vec3{9, 9, 0}));
    EXPECT_EQ(given.start[8], (Vec3{10, 8.5, 0.125}));
    ASSERT_EQ(given.velocities.size(), 15u);
    EXPECT_EQ(given.velocities[8], (Vec3{0.5, 0.625, 0.75}));
    EXPECT_EQ(given.placement.v, (Vec3{0, 0, -1})) << "the default of a world with z up";
    // The picture's cells are 0, 1, 1, 1 over 1, 0.4, 1, 0.
    const Cloth& mapped = scene.cloths[3];
    EXPECT_EQ(mapped.holes, (std::vector<IndexBox>{{{0, 0}, {1, 1}}, {{1, 1}, {2, 2}}, {{3, 1}, {4, 2}}}));
    EXPECT_EQ(mapped.stiffness.stretch, WarpWeft(2 * Stiffness{}.stretch.warp)) << "the stiffest cell's";
    EXPECT_EQ(mapped.cell_stiffness, (std::vector<float>{0.25f, 1, 1, 1, 1, 0.55f, 1, 0.25f}));
    EXPECT_EQ(mapped.areal_density, 0.5 * Cloth{}.areal_density) << "the lightest cell's";
    EXPECT_EQ(mapped.cell_density, (std::vector<float>{6, 1, 1, 1, 1, 4, 1, 6}));
    EXPECT_EQ(mapped.cell_tear, (std::vector<float>{0.25f, 1.5f, 1.5f, 1.5f, 1.5f, 0.75f, 1.5f, 0.25f}));
    // Particles lie on the corners of its pixels.
    EXPECT_EQ(mapped.particle_friction,
              (std::vector<float>{0, 1, 2, 2, 2, 1, 1.2f, 1.7f, 1.5f, 1, 2, 1.4f, 1.4f, 1, 0}));
    EXPECT_EQ(mapped.thickness, 2 * Cloth{}.thickness) << "the thickest particle's";
    ASSERT_EQ(mapped.particle_thickness.size(), 15u);
    EXPECT_EQ(mapped.particle_thickness[0], 0.25f);
    EXPECT_EQ(mapped.particle_thickness[2], 1);
    EXPECT_EQ(mapped.particle_thickness[8], 0.8125f);
}

TEST(SceneValues, AFabricSetsWhatItsClothDoesNotSay) {
    for (const Fabric& fabric : fabrics) {
        const Cloth cloth = scene_of(R"({"cloths": [{"fabric": ")" + std::string(fabric.name) + "\"}]}").cloths[0];
        EXPECT_EQ(cloth.areal_density, fabric.areal_density);
        EXPECT_EQ(cloth.stiffness, fabric.stiffness);
        EXPECT_EQ(cloth.friction, fabric.friction);
        EXPECT_EQ(cloth.appearance.roughness, fabric.roughness);
        EXPECT_EQ(cloth.appearance.sheen, fabric.sheen);
        EXPECT_FALSE(fabric.source.empty());
    }
    const Cloth heavy =
        scene_of(R"({"cloths": [{"stiffness": {"bend": 1e-3}, "friction": 1, "fabric": "silk"}]})").cloths[0];
    const Fabric& silk = *find_fabric("silk");
    EXPECT_EQ(heavy.stiffness, (Stiffness{false, silk.stiffness.stretch, silk.stiffness.shear, 1e-3}));
    EXPECT_EQ(heavy.areal_density, silk.areal_density);
    EXPECT_EQ(heavy.friction, 1);
    EXPECT_TRUE(scene_of(R"({"cloths": [{"fabric": "denim", "stiffness": "rigid"}]})").cloths[0].stiffness.rigid);
}

TEST(SceneValues, WarpAndWeftMayDiffer) {
    const auto stiffness = [](const std::string& keys) {
        return scene_of(R"({"cloths": [{"fabric": "silk", "stiffness": {)" + keys + "}}]}").cloths[0].stiffness;
    };
    const Stiffness silk = find_fabric("silk")->stiffness;
    EXPECT_EQ(stiffness(R"("stretch": 500)").stretch, (WarpWeft{500, 500}));
    EXPECT_EQ(stiffness(R"("stretch": {"warp": 500})").stretch, (WarpWeft{500, silk.stretch.weft}));
    EXPECT_EQ(stiffness(R"("stretch": {"warp": 500, "weft": 0})").stretch, (WarpWeft{500, 0}));
    EXPECT_EQ(stiffness(R"("bend": 1e-5)").bend, (Rigidity{1e-5, 1e-5, 1e-5}));
    EXPECT_EQ(stiffness(R"("bend": {"warp": 4e-6, "weft": 1e-6})").bend, (Rigidity{4e-6, 1e-6, 2e-6}));
    EXPECT_EQ(stiffness(R"("bend": {"warp": 4e-6, "weft": 1e-6, "twist": 0})").bend, (Rigidity{4e-6, 1e-6, 0}));
}

TEST(SceneValues, WithoutFramesItMoves) { EXPECT_EQ(scene_of(R"({"cloths": [{}]})").time, (TimeSettings{60, 121})); }

TEST(SceneValues, PinsOfTheFullScene) {
    const SceneDescription scene = scene_of(testing::full_scene);
    ASSERT_EQ(scene.cloths[0].pins.size(), 4u);
    const std::vector<Pin>& pins = scene.cloths[0].pins;
    EXPECT_EQ(pins[0], (Pin{{{0, 63}, {95, 63}}, std::nullopt, {}, std::nullopt}));
    EXPECT_EQ(pins[1], (Pin{{{95, 0}, {95, 0}}, 2.5, {}, std::nullopt}));
    const MotionPath path{{{0, {0, 0, 0}, {0, 0, 0}}, {1.5, {0.2, 0, 0.1}, {0, 720, 5}}}};
    EXPECT_EQ(pins[2], (Pin{{{10, 3}, {10, 3}}, std::nullopt, path, Vec3{7, 8, 9}}));
    EXPECT_EQ(pins[3], (Pin{{{1, 2}, {3, 4}}, std::nullopt, {}, std::nullopt}));
}

TEST(SceneValues, CollidersOfTheFullScene) {
    Mesh mesh{DRAPE_SOURCE_DIR "/tests/scene/box.obj",        0.5,  {1, 2, 3}, 0.25, 0.125,
              DRAPE_SOURCE_DIR "/tests/scene/box_pose_#.obj", 12.5, 0.25,      true};
    read_file(mesh);
    ASSERT_TRUE(mesh.sequence);
    EXPECT_EQ(mesh.sequence->count(), 2u);
    Mesh strict{.file = DRAPE_SOURCE_DIR "/tests/scene/box.obj", .solid = Solid::strict};
    read_file(strict);
    const auto collider = [](ColliderShape shape, double friction, Vec3 rotate, MotionKey key, double red) {
        return Collider{shape, friction, rotate, {{key}}, {red, 0.1, 0.2}};
    };
    const std::vector<Collider> expected{
        collider(Plane{{0, 0, 1}, -0.5}, 0.6, {1, 2, 3}, {0, {}, {}}, 0.1),
        collider(Sphere{{0, 1, 0.5}, 0.3}, 0.1, {4, 5, 6}, {1, {1, 1, 1}, {}}, 0.2),
        collider(Box{{0, 0.5, 0}, {0.3, 0.1, 0.2}}, 0.2, {0, 30, 0}, {2, {}, {1, 1, 1}}, 0.3),
        collider(Ellipsoid{{0, 1, 0}, {0.4, 0.2, 0.1}}, 0.4, {7, 8, 9}, {3, {}, {}}, 0.4),
        collider(Capsule{{0, 1, 0.25}, {1, 2, 3}, {0.2, 0.1}}, 0.7, {1, 8, 9}, {4, {}, {}}, 0.5),
        {.shape = Capsule{{-0.5, 0, 0}, {0.5, 0, 0}, {0.125, 0.125}},
         .mass = 40,
         .inertia = Vec3{3, 1, 3.5},
         .velocity = {1, 0, -2},
         .angular_velocity = {0, 0.5, 0}},
        collider(mesh, 0.8, {2, 4, 6}, {5, {}, {}}, 0.6),
        {strict}};
    EXPECT_EQ(scene_of(testing::full_scene).colliders, expected);
}

TEST(SceneValues, PosesFollowTheClock) {
    Mesh mesh{.file = DRAPE_SOURCE_DIR "/tests/scene/box.obj",
              .frames = DRAPE_SOURCE_DIR "/tests/scene/box_pose_#.obj",
              .frames_per_second = 8,
              .frames_start = 0.5};
    read_file(mesh);
    for (const auto& [time, pose] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.5625, 0.5}, {0.625, 1.0}, {9.0, 1.0}})
        EXPECT_NEAR(pose_number(mesh, time), pose, 1e-9) << time;
    mesh.loop = true;
    for (const auto& [time, pose] : {std::pair{0.5, 0.0}, {0.6875, 1.5}, {0.75, 0.0}, {0.4375, 1.5}})
        EXPECT_NEAR(pose_number(mesh, time), pose, 1e-9) << time;
    const Collider collider{mesh};
    EXPECT_NEAR(deformed(collider, 0.5, 0.5625), deformed(collider, 0.5, 0.625) / 2, 1e-9);
    EXPECT_GT(deformed(collider, 0.5, 0.625), 0.01);
    EXPECT_EQ(shape_geometry(formed(collider, 0.5).shape).center, shape_geometry(mesh).center);
}

TEST(SceneValues, FilesLieBesideTheScene) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(::testing::TempDir()) / "drape scenes with meshes";
    fs::create_directories(folder / "bodies");
    fs::copy_file(DRAPE_SOURCE_DIR "/tests/scene/box.obj", folder / "bodies" / "box.obj",
                  fs::copy_options::overwrite_existing);
    const std::string text =
        R"({"cloths": [{"grid": [4, 3]}], "colliders": {"meshes": [{"file": "bodies/box.obj", "scale": 0.5}]}})";
    const std::string path = (folder / "scene.json").string(), body = (folder / "bodies" / "box.obj").string();
    std::ofstream(path) << text;
    const SceneDescription scene = load_scene(path);
    const Mesh& mesh = std::get<Mesh>(scene.colliders.at(0).shape);
    EXPECT_EQ(mesh.file, body);
    ASSERT_TRUE(mesh.shape);
    EXPECT_NEAR(mesh.shape->middle()[0], 0.5, 1e-6);
    EXPECT_NEAR(mesh.shape->half_extents()[0], 0.15, 1e-6);
    const SceneResult again = read_scene_text(resolved_scene(text, {}, folder.string()), "again", {}, folder.string());
    EXPECT_EQ(again.scene.value().colliders, scene.colliders);
    EXPECT_EQ(again.files, std::vector<std::string>{"bodies/box.obj"});
    EXPECT_THROW(parse_scene(text), SceneFailure);
}

/// Writes two tetrahedra with edges of 1 m, the second one moved, along x most of all, and returns the scene that has
/// them.
std::string two_bodies(double apart, const std::string& more) {
    const std::string path = ::testing::TempDir() + "two_bodies.obj";
    std::ofstream file(path);
    for (const double x : {0.0, apart})
        file << fmt::format("v {0} {2} {3}\nv {1} {2} {3}\nv {0} {4} {3}\nv {0} {2} {5}\n", x, x + 1, 5 + x / 4, x / 3,
                            6 + x / 4, 1 + x / 3);
    for (const int first : {1, 5})
        file << fmt::format("f {0} {2} {1}\nf {0} {1} {3}\nf {1} {2} {3}\nf {0} {3} {2}\n", first, first + 1, first + 2,
                            first + 3);
    return R"({"cloths": [{"grid": [4, 3]}], "colliders": {"meshes": [{"file": ")" + path + "\"" + more + "}]}}";
}

TEST(SceneValues, AMeshThatCrossesItselfIsWarnedOf) {
    const SceneResult crossed = read_scene_text(two_bodies(0.25, ""), "s");
    ASSERT_EQ(crossed.warnings.size(), 1u);
    EXPECT_THAT(crossed.warnings[0].text(),
                ::testing::StartsWith("s:1:66: /colliders/meshes/0/file: the surface crosses itself ("));
    EXPECT_TRUE(read_scene_text(two_bodies(1.25, ""), "s").warnings.empty());
    EXPECT_TRUE(read_scene_text(two_bodies(0.25, ", \"shell\": 0.1"), "s").warnings.empty());
}

TEST(SceneValues, WhatWasMendedOfAMeshIsTold) {
    // A box of 1 m x 2 m x 3 m without a triangle of 1 m x 2 m: a hole of 1 of 21 m^2, or of 1.5 m^2 of another face.
    const std::string path = ::testing::TempDir() + "open_box.obj";
    const auto scene = [&](std::size_t left_out, const std::string& more) {
        std::ofstream file(path);
        for (const double z : {0, 3})
            for (const double y : {0, 2})
                for (const double x : {0, 1}) file << fmt::format("v {} {} {}\n", x, y, z);
        const std::array<std::array<int, 3>, 12> faces{{{1, 3, 4},
                                                        {1, 4, 2},
                                                        {5, 6, 8},
                                                        {5, 8, 7},
                                                        {1, 5, 7},
                                                        {1, 7, 3},
                                                        {2, 4, 8},
                                                        {2, 8, 6},
                                                        {1, 2, 6},
                                                        {1, 6, 5},
                                                        {3, 7, 8},
                                                        {3, 8, 4}}};
        for (std::size_t k = 0; k < faces.size(); ++k)
            if (k != left_out) file << fmt::format("f {} {} {}\n", faces[k][0], faces[k][1], faces[k][2]);
        file.close();
        return read_scene_text(
            R"({"cloths": [{"grid": [4, 3]}], "colliders": {"meshes": [{"file": ")" + path + "\"" + more + "}]}}", "s");
    };
    const SceneResult small = scene(0, "");
    ASSERT_EQ(small.warnings.size(), 1u);
    EXPECT_EQ(small.warnings[0].text(),
              "s:1:66: /colliders/meshes/0/file: the mesh was mended to be a body: 1 hole closed (3 edges, 1 m^2)");
    const SceneResult large = scene(9, "");
    ASSERT_EQ(large.errors.size(), 1u);
    EXPECT_THAT(
        large.errors[0].text(),
        ::testing::StartsWith("s:1:66: /colliders/meshes/0/file: expected a closed surface, got one with 3 edges "
                              "of one triangle alone, one at ("));
    EXPECT_EQ(scene(9, R"(, "solid": "filled")").warnings.size(), 1u);
    EXPECT_EQ(scene(0, R"(, "solid": "strict")").errors.size(), 1u);
    EXPECT_TRUE(scene(12, R"(, "solid": "strict")").warnings.empty());
    const SceneResult both = scene(9, R"(, "solid": "filled", "shell": 0.01)");
    ASSERT_EQ(both.errors.size(), 1u);
    EXPECT_THAT(both.errors[0].text(), ::testing::HasSubstr("expected shell or solid, got both"));
}

TEST(SceneValues, EveryEdgeAndCorner) {
    const SceneDescription scene = scene_of(R"({"cloths": [{"grid": [4, 3], "pins": [
        {"edge": "left"}, {"edge": "right"}, {"edge": "top"}, {"edge": "bottom"},
        {"corner": "top_left"}, {"corner": "top_right"}, {"corner": "bottom_left"}, {"corner": "bottom_right"}]}]})");
    const std::vector<IndexBox> expected{{{0, 0}, {0, 2}}, {{3, 0}, {3, 2}}, {{0, 0}, {3, 0}}, {{0, 2}, {3, 2}},
                                         {{0, 0}, {0, 0}}, {{3, 0}, {3, 0}}, {{0, 2}, {0, 2}}, {{3, 2}, {3, 2}}};
    ASSERT_EQ(scene.cloths[0].pins.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(scene.cloths[0].pins[i].particles, expected[i]) << i;
}

TEST(SceneValues, NamesTheNameless) {
    const SceneDescription scene = scene_of(R"({"cloths": [{}, {"placement": {"origin": [9, 0, 0]}}]})");
    EXPECT_EQ(scene.cloths[0].name, "cloth");
    EXPECT_EQ(scene.cloths[1].name, "cloth2");
}

TEST(SceneValues, NormalisesTinyAndHugeDirections) {
    const SceneDescription scene = scene_of(R"({"cloths": [{}], "colliders": {"planes": [
        {"normal": [3e-300, 4e-300, 0]}, {"normal": [0, 3e38, 3e38]}]}})");
    EXPECT_DOUBLE_EQ(std::get<Plane>(scene.colliders[0].shape).normal[0], 0.6);
    EXPECT_DOUBLE_EQ(std::get<Plane>(scene.colliders[0].shape).normal[1], 0.8);
    EXPECT_DOUBLE_EQ(std::get<Plane>(scene.colliders[1].shape).normal[2], std::sqrt(0.5));
}

TEST(SceneValues, AcceptsBomBlockCommentsCarriageReturnsAndIntegralReals) {
    const SceneDescription scene =
        scene_of("\xEF\xBB\xBF/* a */{\r\n\"name\": \"\xC3\xA4\", \"cloths\": [{\"grid\": [3.0, 1e1]}] // b\r\n}");
    EXPECT_EQ(scene.name, "\xC3\xA4");
    EXPECT_EQ(scene.cloths[0].grid, (std::array<std::uint32_t, 2>{3, 10}));
}

TEST(SceneValues, EmptyLightListMeansNoLightAndNoCameraNone) {
    const SceneDescription scene = scene_of(R"({"cloths": [{}], "lights": []})");
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_FALSE(scene.camera);
}

TEST(SceneValues, AcceptsThePublishedExtremes) {
    scene_of(R"({"cloths": [{"grid": [2, 16384]}, {"grid": [4000, 3990], "placement": {"origin": [0, 0, 5]}}]})");
    scene_of(R"({"cloths": [{"stiffness": {"stretch": 0, "shear": 0}, "friction": 0, "thickness": 0}],
                 "time": {"fps": 10000, "frames": 1000000}, "solver": {"substeps": 4096, "iterations": 1024}})");
}

std::vector<std::string> warnings_of(std::string_view text) {
    const SceneResult result = read_scene_text(text, "s");
    EXPECT_TRUE(result.scene.has_value());
    std::vector<std::string> texts;
    for (const SceneError& warning : result.warnings) texts.push_back(warning.text());
    return texts;
}

TEST(SceneWarnings, ClothsSetToTouch) {
    const std::vector<std::string> expected{
        "s:2:1: /cloths/1: cloths \"a\" and \"b\" are set to touch, but will pass through each other: "
        "only with self_collision in one of a scene's cloths do they meet"};
    EXPECT_EQ(warnings_of("{\"cloths\": [{\"name\": \"a\"},\n{\"name\": \"b\", \"placement\": {\"origin\": "
                          "[0.5, 0.5, 0]}}]}"),
              expected);
    EXPECT_TRUE(warnings_of(R"({"cloths": [{}, {"placement": {"origin": [0, 0, 0.1]}}]})").empty());
    EXPECT_TRUE(warnings_of(R"({"cloths": [{}, {"placement": {"origin": [1.1, 0, 0]}}]})").empty());
}

// 0.6 m over 12 edges are a little less than 0.05 m; a scene that says 0.05 means one edge.
TEST(SceneValues, AThicknessOfOneEdgeIsOneThoughItIsRounded) {
    for (const char* thickness : {"0.05", "0.005"}) {
        const std::string text = fmt::format(
            R"({{"cloths": [{{"grid": [13, 9], "size": [0.6, 0.4], "self_collision": {{"thickness": {}}}}}]}})",
            thickness);
        EXPECT_TRUE(scene_of(text).cloths.at(0).self_collision.has_value());
    }
    const SceneResult more = read_scene_text(
        R"({"cloths": [{"grid": [13, 9], "size": [0.6, 0.4], "self_collision": {"thickness": 0.0501}}]})", "s");
    ASSERT_EQ(more.errors.size(), 1u);
    EXPECT_NE(more.errors[0].text().find("a coarser grid allows more"), std::string::npos);
}

TEST(SceneValues, EachMethodByItsName) {
    const auto method = [](const std::string& name) {
        return scene_of(R"({"cloths": [{}], "solver": {"method": ")" + name + "\"}}").solver.method;
    };
    EXPECT_EQ(method("auto"), SolverMethod::automatic);
    EXPECT_EQ(method("relax"), SolverMethod::relax);
    EXPECT_EQ(method("explicit"), SolverMethod::explicit_steps);
    EXPECT_EQ(method("line"), SolverMethod::line);
}

TEST(SceneWarnings, SettingsThatDoNothing) {
    const std::vector<std::string> explicit_ignores{
        "s:1:65: /solver/iterations: iterations is ignored by method explicit: a micro-step solves nothing"};
    EXPECT_EQ(warnings_of(R"({"cloths": [{}], "solver": {"method": "explicit", "iterations": 3}})"), explicit_ignores);
    EXPECT_EQ(warnings_of(R"({"cloths": [{}], "solver": {"method": "relax", "strain_damping": 0.1}})"),
              std::vector<std::string>{"s:1:66: /solver/strain_damping: strain_damping is ignored by method relax"});
    EXPECT_EQ(warnings_of(R"({"cloths": [{}], "solver": {"method": "line", "strain_damping": 0.1}})"),
              std::vector<std::string>{"s:1:65: /solver/strain_damping: strain_damping is ignored by method line"});
    EXPECT_EQ(warnings_of(R"({"cloths": [{}], "wind": {"gust": {"amplitude": 1}}})"),
              std::vector<std::string>{
                  "s:1:35: /wind/gust: the gust does nothing: it blows along the wind's velocity, which is zero"});
    EXPECT_EQ(
        warnings_of(R"({"cloths": [{}], "solver": {"method": "auto", "substeps": 9, "iterations": 2}})"),
        (std::vector<std::string>{
            "s:1:59: /solver/substeps: substeps is ignored by method auto, which chooses: name a method to set it",
            "s:1:76: /solver/iterations: iterations is ignored by method auto, which chooses: name a method to set "
            "it"}));
    EXPECT_TRUE(warnings_of(R"({"cloths": [{}]})").empty());
}

TEST(SceneFile, IsReadFromDisk) {
    const std::string path = ::testing::TempDir() + "drape_scene_reader_test.json";
    std::ofstream(path) << testing::full_scene;
    const SceneResult result = read_scene(path);
    std::remove(path.c_str());
    ASSERT_TRUE(result.scene.has_value());
    EXPECT_EQ(*result.scene, scene_of(testing::full_scene));
}

TEST(SceneFile, UnreadableIsNotASceneError) {
    const SceneResult result = read_scene("/no/such/scene.json");
    EXPECT_TRUE(result.unreadable);
    ASSERT_EQ(result.errors.size(), 1u);
    EXPECT_EQ(result.errors[0].text(), "/no/such/scene.json: cannot read: No such file or directory");
    EXPECT_TRUE(read_scene("/").unreadable);
    EXPECT_FALSE(read_scene_text("", "s").unreadable);
}

TEST(SceneFile, RefusesMoreThanItsLimit) {
    const SceneResult endless = read_scene("/dev/zero");
    ASSERT_EQ(endless.errors.size(), 1u);
    EXPECT_EQ(endless.errors[0].text(), "/dev/zero: expected a file of at most 16777216 bytes, got at least 16777217");
    EXPECT_FALSE(endless.unreadable);
    std::string padded = R"({"cloths": [{}]})";
    padded.resize(scene_file_byte_limit, ' ');
    EXPECT_TRUE(read_scene_text(padded, "s").errors.empty());
    padded.push_back(' ');
    EXPECT_EQ(read_scene_text(padded, "s").errors.size(), 1u);
}

/// Holes may take any number of cells in all as long as one is left, here in the lower right.
TEST(SceneValues, HolesMayLieOnEachOther) {
    const SceneResult result = read_scene_text(
        R"({"cloths": [{"grid": [3, 3], "holes": [[[0, 0], [2, 1]], [[0, 0], [2, 1]], [[0, 0], [1, 2]]]}]})", "holes");
    EXPECT_TRUE(result.scene.has_value());
}

}  // namespace
}  // namespace drape
