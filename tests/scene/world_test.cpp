// In a world with z up, every default that has a direction is turned, and nothing else.
#include <gtest/gtest.h>

#include "drape/scene_reader.h"
#include "world/up.h"

namespace drape {
namespace {

TEST(World, TurnsAboutX) {
    EXPECT_EQ(in_world(Up::z, {1, 2, 3}), (Vec3{1, -3, 2}));
    EXPECT_EQ(with_y_up(Up::z, in_world(Up::z, {1, 2, 3})), (Vec3{1, 2, 3}));
    EXPECT_EQ(in_world(Up::y, {1, 2, 3}), (Vec3{1, 2, 3}));
    EXPECT_EQ(in_world(Up::z, {0, 1, 0})[up_axis(Up::z)], 1);
    EXPECT_EQ(in_world(Up::y, {0, 1, 0})[up_axis(Up::y)], 1);
}

constexpr const char* members = R"("cloths": [{}, {"placement": {"origin": [5, 5, 5]}}],
    "colliders": {"planes": [{"offset": -9}]}, "camera": {"fov": 30}})";

TEST(World, DefaultsStandUprightInIt) {
    const SceneDescription scene = parse_scene(std::string(R"({"up": "z", )") + members);
    EXPECT_EQ(scene.up, Up::z);
    EXPECT_EQ(scene.gravity, (Vec3{0, 0, -9.81}));
    for (const Cloth& cloth : scene.cloths) {
        EXPECT_EQ(cloth.placement.u, (Vec3{1, 0, 0}));
        EXPECT_EQ(cloth.placement.v, (Vec3{0, 0, -1}));
    }
    EXPECT_EQ(std::get<Plane>(scene.colliders[0].shape).normal, (Vec3{0, 0, 1}));
    EXPECT_EQ(scene.camera->position, (Vec3{0, -3, 1.5}));
    EXPECT_EQ(scene.camera->target, (Vec3{0, 0, 1}));
    ASSERT_EQ(scene.lights.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(scene.lights[i].direction, in_world(Up::z, default_lights()[i].direction));
    const std::string lit = R"("cloths": [{}], "lights": [{}]})";
    const Vec3 here = parse_scene(R"({"up": "z", )" + lit).lights[0].direction,
               there = in_world(Up::z, parse_scene("{" + lit).lights[0].direction);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(here[k], there[k], 1e-15);
}

TEST(World, WithYUpIsTheDefault) {
    EXPECT_EQ(parse_scene(std::string(R"({"up": "y", )") + members), parse_scene(std::string("{") + members));
}

TEST(World, WhatASceneSaysIsNotTurned) {
    const SceneDescription scene = parse_scene(
        R"({"up": "z", "gravity": [0, -1, 0], "cloths": [{"placement": {"u": [0, 1, 0], "v": [-1, 0, 0]}}],
            "colliders": {"planes": [{"normal": [0, 1, 0], "offset": -9}]}, "lights": []})");
    EXPECT_EQ(scene.gravity, (Vec3{0, -1, 0}));
    EXPECT_EQ(scene.cloths[0].placement.u, (Vec3{0, 1, 0}));
    EXPECT_EQ(scene.cloths[0].placement.v, (Vec3{-1, 0, 0}));
    EXPECT_EQ(std::get<Plane>(scene.colliders[0].shape).normal, (Vec3{0, 1, 0}));
    EXPECT_TRUE(scene.lights.empty());
}

TEST(World, IsKeptWhereDefaultsAreWrittenOut) {
    for (const std::string more : {"", R"("gravity_keys": [{"t": 0, "gravity": [0, 0, -1]}], )",
                                   R"("wind": {"keys": [{"t": 0, "velocity": [1, 0, 0]}]}, )"}) {
        const std::string text = R"({"up": "z", "lights": [], )" + more + members;
        const std::string resolved = resolved_scene(text);
        EXPECT_EQ(parse_scene(resolved), parse_scene(text)) << resolved;
        EXPECT_TRUE(read_scene_text(resolved, "s").warnings.size() == read_scene_text(text, "s").warnings.size());
        EXPECT_EQ(resolved.find("\"gravity\":[0,0,-9.81") == std::string::npos, more.starts_with("\"gravity_keys"))
            << resolved;
    }
}

}  // namespace
}  // namespace drape
