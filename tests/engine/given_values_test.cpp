// What was put into a frame stands beside what came out of it.
#include "run/given_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "drape/scene_reader.h"
#include "world/gust.h"

namespace drape {
namespace {

using testing::HasSubstr;

constexpr const char* changing = R"({
  "time": {"fps": 10, "frames": 11},
  "wind": {"velocity": [3, 0, 4], "gust": {"amplitude": 2, "period": 1.5, "seed": 7}},
  "gravity_keys": [{"t": 0, "gravity": [0, -10, 0]}, {"t": 1, "gravity": [0, 0, 0]}],
  "cloths": [{"name": "sheet", "stiffness_keys": [{"t": 0, "factor": 1}, {"t": 1, "factor": 0.5}],
              "pins": [{"edge": "top", "release": 0.35,
                        "path": [{"t": 0}, {"t": 1, "translate": [0, 2, 0], "rotate": [0, 0, 90]}]}],
              "loads": [{"force_keys": [{"t": 0, "force": [0, 0, 0]}, {"t": 1, "force": [8, 0, 0]}]},
                        {"pressure": -3}]}],
  "colliders": {"spheres": [{"center": [0, -5, 0], "radius": 0.1,
                             "path": [{"t": 0}, {"t": 1, "translate": [0, 0, 6]}]}]}
})";

SceneDescription scene_of(const std::string& text) {
    SceneResult result = read_scene_text(text, "test", {});
    if (!result.scene) throw SceneFailure(std::move(result));
    return *result.scene;
}

TEST(GivenValues, AreThoseOfTheFramesTime) {
    const SceneDescription scene = scene_of(changing);
    const FrameValues values = given_values(scene, 5);
    const Vec3 wind = wind_velocity(scene.wind, 0.5);
    EXPECT_NE(wind[0], 3) << "a gust blows";
    EXPECT_EQ(values.at("given_wind_x_m_s"), wind[0]);
    EXPECT_EQ(values.at("given_wind_z_m_s"), wind[2]);
    EXPECT_EQ(values.at("given_gravity_y_m_s2"), -5);
    EXPECT_EQ(values.at("sheet/given_load_0_x_n"), 4);
    EXPECT_EQ(values.at("sheet/given_load_1_pa"), -3);
    // A leg from rest to rest is halfway in the middle.
    EXPECT_DOUBLE_EQ(values.at("sheet/given_pins_0_translate_y_m"), 1);
    EXPECT_DOUBLE_EQ(values.at("sheet/given_pins_0_rotate_z_deg"), 45);
    EXPECT_DOUBLE_EQ(values.at("given_collider_0_sphere_translate_z_m"), 3);
    EXPECT_EQ(values.at("sheet/given_pins_0_hold"), 0);
    EXPECT_EQ(given_values(scene, 3).at("sheet/given_pins_0_hold"), 1);
    EXPECT_LT(values.at("sheet/given_stiffness_factor"), 1);
    for (const auto& [name, value] : values) EXPECT_TRUE(is_given(name)) << name;
    EXPECT_FALSE(is_given("sheet/stretch_rms"));
}

TEST(GivenValues, AreNoneWhereNothingChanges) {
    EXPECT_TRUE(given_values(scene_of(R"({"cloths": [{"pins": [{"edge": "top"}]}]})"), 3).empty());
}

TEST(SetArrays, HaveNumbersAsNumbers) {
    const auto arrays = set_arrays({"/a=1", "/b=[1, 2.5]", "/c=\"word\"", "/d=plain", "/a=3"});
    ASSERT_EQ(arrays.size(), 4u);
    EXPECT_EQ(arrays[0].first, "set/a");
    EXPECT_THAT(arrays[0].second, HasSubstr("'descr': '<f8', 'fortran_order': False, 'shape': ()"));
    double last = 0;
    std::memcpy(&last, &arrays[0].second[arrays[0].second.size() - sizeof last], sizeof last);
    EXPECT_EQ(last, 3) << "the last one counts";
    EXPECT_THAT(arrays[1].second, HasSubstr("'shape': (2,)"));
    EXPECT_THAT(arrays[2].second, HasSubstr("<U6"));
    EXPECT_THAT(arrays[3].second, HasSubstr("<U7"));
}

}  // namespace
}  // namespace drape
