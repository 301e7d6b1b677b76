// What a scene may not say of bodies that cloth moves.
#include <gtest/gtest.h>

#include "drape/scene_reader.h"

namespace drape {
namespace {

void expect_errors(const std::string& keys, const std::vector<std::string>& expected) {
    const SceneResult result = read_scene_text("{\"cloths\": [{}],\n" + keys + "}", "s");
    std::vector<std::string> texts;
    for (const SceneError& error : result.errors) texts.push_back(error.text());
    EXPECT_EQ(texts, expected);
}

TEST(BodyRules, ABodyHasNoPathAndWhatItHasNeedsAMass) {
    expect_errors(
        R"("colliders": {"spheres": [{"mass": 50, "path": [{"t": 0}]}, {"velocity": [1, 0, 0]}],
"boxes": [{"mass": 60, "inertia": [1, 1, 3]}]})",
        {"s:2:48: /colliders/spheres/0/path: expected no path beside a mass, with which gravity and cloth move the "
         "collider",
         "s:2:74: /colliders/spheres/1/velocity: expected a mass too, got none",
         "s:3:35: /colliders/boxes/0/inertia: expected moments none of which exceeds the sum of the others"});
}

TEST(BodyRules, ABodyWeighsMoreThanTheClothOnIt) {
    expect_errors(R"("colliders": {"spheres": [{"radius": 0.5, "mass": 0.1}]}, "solver": {"method": "line"})",
                  {"s:2:51: /colliders/spheres/0/mass: expected at least 1.26 kg, 2 times what cloth of 0.2 kg/m^2 "
                   "weighs that covers the body, got 0.1"});
}

}  // namespace
}  // namespace drape
