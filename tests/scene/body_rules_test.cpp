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

TEST(BodyRules, AnEllipsoidMeetsNoBox) {
    expect_errors(
        R"("colliders": {"ellipsoids": [{"mass": 60}],
"boxes": [{}]})",
        {"s:2:39: /colliders/ellipsoids/0/mass: expected no ellipsoid beside a box, which have no contact with "
         "each other where one has a mass: ellipsoids meet planes, spheres and capsules"});
}

TEST(BodyRules, AShellAndAMeshThatDeformsHaveNoMass) {
    const std::string box = "\"file\": \"" DRAPE_SOURCE_DIR "/tests/scene/box";
    for (const char* const rest :
         {".obj\", \"shell\": 0.05",
          ".obj\", \"frames\": \"" DRAPE_SOURCE_DIR "/tests/scene/box_pose_#.obj\", \"frames_per_second\": 10"})
        expect_errors("\"colliders\": {\"meshes\": [{" + box + rest + R"(,
"mass": 60}]})",
                      {"s:3:9: /colliders/meshes/0/mass: expected no mass of a mesh that is a shell or deforms"});
}

TEST(BodyRules, PairsAreAtMost4096) {
    std::string spheres = R"({"radius": 0.01, "mass": 50})";
    for (int k = 1; k < 65; ++k) spheres += ",\n{\"radius\": 0.01, \"mass\": 50}";
    expect_errors("\"colliders\": {\"spheres\": [\n" + spheres + "]}",
                  {"s:66:26: /colliders/spheres/63/mass: expected at most 4096 pairs of a body and a collider, a body "
                   "counting once with each"});
}

TEST(BodyRules, ABodyWeighsATenthOfTheClothOnIt) {
    expect_errors(R"("colliders": {"spheres": [{"radius": 0.5, "mass": 0.01}]}, "solver": {"method": "line"})",
                  {"s:2:51: /colliders/spheres/0/mass: expected at least 0.0628 kg, 0.1 times what the heaviest cloth "
                   "weighs that covers the body, got 0.01"});
}

}  // namespace
}  // namespace drape
