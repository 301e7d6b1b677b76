// Gravity and wind that keys change.
#include "world/weather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "world/gust.h"

namespace drape {
namespace {

const std::vector<VectorKey> keys{{1, {2, 0, -4}}, {3, {4, 8, -4}}, {4, {0, 0, 0}}};

TEST(Weather, GoesStraightFromKeyToKeyAndRestsOutside) {
    for (const double time : {-10.0, 0.999, 1.0}) EXPECT_EQ(value_at(keys, {9, 9, 9}, time), (Vec3{2, 0, -4}));
    EXPECT_EQ(value_at(keys, {}, 2), (Vec3{3, 4, -4}));
    EXPECT_EQ(value_at(keys, {}, 3), (Vec3{4, 8, -4}));
    EXPECT_EQ(value_at(keys, {}, 3.75), (Vec3{1, 2, -1}));
    for (const double time : {4.0, 1e6}) EXPECT_EQ(value_at(keys, {}, time), (Vec3{0, 0, 0}));
    EXPECT_EQ(value_at({}, {9, 8, 7}, 2), (Vec3{9, 8, 7}));
}

TEST(Weather, IsSteadyOnlyWhereNoKeyChangesIt) {
    EXPECT_TRUE(is_steady(std::vector<VectorKey>{}, 0, 9));
    EXPECT_TRUE(is_steady(keys, -1, 1));
    EXPECT_FALSE(is_steady(keys, 0, 1.1));
    EXPECT_TRUE(is_steady(keys, 4, 9));
    const std::vector<VectorKey> there_and_back{{0, {1, 0, 0}}, {1, {2, 0, 0}}, {2, {1, 0, 0}}};
    EXPECT_FALSE(is_steady(there_and_back, 0, 2));
    EXPECT_FALSE(is_steady(there_and_back, -5, 5));
}

TEST(Weather, TheStrongestIsThatOfAKey) {
    SceneDescription scene;
    EXPECT_EQ(strongest_gravity(scene), scene.gravity);
    EXPECT_FALSE(has_weather(scene));
    scene.gravity_keys = {{0, {0, -2, 0}}, {1, {0, -2, 0}}};
    EXPECT_FALSE(gravity_changes(scene));
    EXPECT_EQ(gravity_at(scene, 0.3), (Vec3{0, -2, 0}));
    scene.gravity_keys[1].value = {0, 3, 0};
    EXPECT_TRUE(gravity_changes(scene) && has_weather(scene));
    EXPECT_EQ(strongest_gravity(scene), (Vec3{0, 3, 0}));
    scene.wind.velocity = {50, 0, 0};  // of no effect beside keys
    scene.wind.keys = keys;
    EXPECT_EQ(fastest_steady_wind(scene.wind), std::hypot(4, 8, -4));
}

TEST(Weather, AFrameHasTheStiffnessAtItsMiddle) {
    SceneDescription scene;
    scene.time.fps = 10;
    Cloth cloth;
    EXPECT_EQ(stiffness_factor(scene, cloth, 7), 1);
    cloth.stiffness_keys = {{0.1, 1}, {0.3, 0.5}};
    EXPECT_EQ(stiffness_factor(scene, cloth, 0), 1);
    EXPECT_EQ(stiffness_factor(scene, cloth, 1), 1);  // until .1 s, its middle is at .05 s
    EXPECT_NEAR(stiffness_factor(scene, cloth, 2), 0.875, 1e-12);
    EXPECT_NEAR(stiffness_factor(scene, cloth, 3), 0.625, 1e-12);
    EXPECT_EQ(stiffness_factor(scene, cloth, 4), 0.5);
    cloth.stiffness_keys = {{-1, 0.25}};
    EXPECT_EQ(stiffness_factor(scene, cloth, 0), 0.25);
}

TEST(Weather, GustsBlowAlongTheWindOfTheirTime) {
    const Wind wind{.gust = {2, 0.7, 5}, .keys = keys};
    for (const double time : {0.0, 2.5, 3.5}) {
        const Vec3 steady = value_at(keys, {}, time), blows = wind_velocity(wind, time);
        const double share = 1 + gust_speed(wind.gust, time) / std::hypot(steady[0], steady[1], steady[2]);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(blows[k], share * steady[k], 1e-12) << time;
    }
    EXPECT_EQ(wind_velocity(wind, 5), (Vec3{0, 0, 0}));
    EXPECT_TRUE(wind.blows());
    EXPECT_FALSE((Wind{.velocity = {1, 0, 0}, .keys = {{0, {0, 0, 0}}}}.blows()));
}

}  // namespace
}  // namespace drape
