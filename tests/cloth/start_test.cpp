// Cloth starts at its place, stretched, scattered, or gathered on a line or a point and parted.
#include "world/start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/cloth_model.h"
#include "control/watch.h"
#include "drape/scene_reader.h"
#include "support/sheets.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// 5 x 4 particles, 0.25 m apart along rows (x), 0.5 m along columns (-y).
SceneDescription scene_with(std::array<double, 2> scale, double jitter = 0) {
    SceneDescription scene = test::sheet(5, 4, 1, 1.5, 4);
    scene.cloths[0].placement = {{1, 2, 3}, {1, 0, 0}, {0, -1, 0}, scale, jitter, 7};
    return scene;
}

std::vector<glsl::vec4> start_of(const SceneDescription& scene) { return ClothModel(scene, 0).position; }

TEST(StartTest, ScaleActsAlongRowsAndColumns) {
    const std::vector<glsl::vec4> start = start_of(scene_with({2, -0.5}));
    EXPECT_EQ(start[0].x, 1.0f);
    EXPECT_EQ(start[4].x, 3.0f);
    EXPECT_EQ(start[15].y, 2.75f);
    EXPECT_EQ(start[19].z, 3.0f);
    EXPECT_DOUBLE_EQ(start_strain(scene_with({2, -0.5}).cloths[0]), 1);
    EXPECT_EQ(start_strain(scene_with({1, -1}).cloths[0]), 0) << "turned over";
}

TEST(StartTest, JitterIsBoundedSeededAndLeavesPinsAlone) {
    SceneDescription scene = scene_with({1, 1}, 0.1);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    const std::vector<glsl::vec4> plain = start_of(scene_with({1, 1})), start = start_of(scene);
    double most = 0, sum = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
        for (const double apart : {start[i].x - plain[i].x, start[i].y - plain[i].y, start[i].z - plain[i].z}) {
            most = std::max(most, std::abs(apart));
            sum += apart;
            if (i < 5) {
                EXPECT_EQ(apart, 0) << "pinned particle " << i;
            }
        }
    EXPECT_LE(most, 0.1 + 1e-6);
    EXPECT_GT(most, 0.08);
    EXPECT_LT(std::abs(sum / 45), 0.04);
    const std::vector<glsl::vec4> again = start_of(scene);
    EXPECT_EQ(again[7].x, start[7].x);
    scene.cloths[0].placement.seed = 8;
    EXPECT_NE(start_of(scene)[7].x, start[7].x);
}

TEST(StartTest, WhatStartsOnALineOrAPointIsPartedByWhatSinglePrecisionResolves) {
    for (const std::array<double, 2> scale : {std::array{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1e-9, 1.0}}) {
        const SceneDescription scene = scene_with(scale);
        const double jitter = start_jitter(scene.cloths[0]);
        EXPECT_GT(jitter, 1e-7);
        EXPECT_LT(jitter, 1e-5);
        const std::vector<glsl::vec4> start = start_of(scene);
        EXPECT_NE(start[6].z, start[7].z) << "out of the line and of its plane";
        EXPECT_NEAR(start[6].z, 3, 1e-5);
    }
    EXPECT_EQ(start_jitter(scene_with({1, 1}).cloths[0]), 0);
    EXPECT_EQ(start_jitter(scene_with({1e-3, 1}).cloths[0]), 0) << "flat, but a sheet";
    EXPECT_EQ(start_jitter(scene_with({0, 0}, 0.2).cloths[0]), 0.2) << "parted already";
}

TEST(StartTest, TheReaderSaysThatItParts) {
    const auto warned = [](const char* placement) {
        const SceneResult result =
            read_scene_text(std::string(R"({"cloths": [{"placement": )") + placement + "}]}", "scene.json");
        EXPECT_TRUE(result.scene);
        std::string text;
        for (const SceneError& warning : result.warnings) text += warning.text();
        return text;
    };
    EXPECT_THAT(
        warned(R"({"scale": [0, 0]})"),
        HasSubstr("/cloths/0/placement: the cloth starts on a point, which no force would part: its particles"));
    EXPECT_THAT(warned(R"({"scale": [1, 0]})"), HasSubstr("starts on a line"));
    EXPECT_THAT(warned(R"({"scale": [1, 0.1]})"), IsEmpty());
    EXPECT_THAT(warned(R"({"scale": [0, 0], "jitter": 0.1})"), IsEmpty());
}

/// A sheet bent by a right angle along its middle column.
TEST(StartTest, AGivenShapeIsWhereEveryParticleStarts) {
    SceneDescription scene = scene_with({1, 1});
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {};
    for (std::uint32_t row = 0; row < 4; ++row)
        for (std::uint32_t column = 0; column < 5; ++column)
            cloth.start.push_back({0.25 * std::min(column, 2u), -0.5 * row, column > 2 ? 0.25 * (column - 2) : 0});
    cloth.pins = {test::pin_top(cloth)};
    cloth.pins[0].path.keys = {{0, {}, {}}, {1, {0, 1, 0}, {}}};
    const ClothModel model(scene, 0);
    for (std::size_t i = 0; i < cloth.start.size(); ++i) {
        EXPECT_EQ(model.position[i].x, cloth.start[i][0]);
        EXPECT_EQ(model.position[i].z, cloth.start[i][2]);
    }
    EXPECT_EQ(model.start_strain, 0) << "bent, not stretched";
    EXPECT_EQ(model.pinned.at(4).rest.z, 0.5f);
    EXPECT_NEAR(model.dynamic_pins.at(0).pivot[0], (0.25 + 3 * 0.5) / 5, 1e-12);
    EXPECT_NEAR(model.dynamic_pins.at(0).pivot[2], 0.75 / 5, 1e-12);
    EXPECT_EQ(model.start_direction(6, 0), (Vec3{1, 0, 0}));
    EXPECT_EQ(model.start_direction(9, 0), (Vec3{0, 0, 1}));
    EXPECT_EQ(model.start_direction(9, 1), (Vec3{0, -1, 0}));
    EXPECT_EQ(start_box(cloth).high, (Vec3{0.5, 0, 0.5}));
    EXPECT_NEAR(start_normal(cloth)[0] / start_normal(cloth)[2], -1, 1e-12);
    EXPECT_EQ(start_jitter(cloth), 0);
}

TEST(StartTest, TheWatchKnowsWhatTheStartStrains) {
    const SimulationModel stretched(scene_with({3, 1})), plain(scene_with({1, 1}));
    ClothStatistics statistics;
    statistics.mass = 1;
    statistics.stretch_error_rms = 1.8;  // a scale of 3 leaves 2
    statistics.potential_energy = -100;
    EXPECT_FALSE(Watch(stretched).implausible(1, {statistics}));
    const auto criterion = [&](const SimulationModel& model, std::uint32_t frame) {
        const auto found = Watch(model).implausible(frame, {statistics});
        return found ? found->criterion : "";
    };
    EXPECT_EQ(criterion(plain, 1), "stretch error, RMS");
    const auto long_after = static_cast<std::uint32_t>(20 * stretched.scene.time.fps);
    EXPECT_EQ(criterion(stretched, long_after), "stretch error, RMS");
}

/// Contact takes particles to be no farther apart than the springs are long at rest, the watch cloth to be no smaller.
TEST(StartTest, AClothThatRestsAsItStartsIsOfThatSize) {
    for (const double scale : {0.5, 2.0}) {
        SceneDescription scene = scene_with({1, 1});
        Cloth& cloth = scene.cloths[0];
        cloth.self_collision.emplace();
        const SimulationModel flat(scene);
        for (const glsl::vec4& at : flat.cloths[0].position) cloth.start.push_back({scale * at.x, scale * at.y, 0});
        cloth.placement = {};
        cloth.rest = Rest::start;
        const SimulationModel model(scene);
        EXPECT_TRUE(model.cloths[0].starts_masked);
        EXPECT_FLOAT_EQ(model.cloths[0].rest_length(0.25f, 0, 0), static_cast<float>(0.25 * scale));
        EXPECT_FLOAT_EQ(model.cloths[0].reach(), flat.cloths[0].reach() * std::max(1.0f, static_cast<float>(scale)));
        const auto &contact = model.self_contact->cloths[0], &before = flat.self_contact->cloths[0];
        const auto least = static_cast<float>(std::min(1.0, scale));
        EXPECT_FLOAT_EQ(contact.spacing.x, least * before.spacing.x);
        EXPECT_FLOAT_EQ(contact.spacing.y, least * before.spacing.y);
        EXPECT_FLOAT_EQ(contact.least_flat, least * before.least_flat);
    }
}

}  // namespace
}  // namespace drape
