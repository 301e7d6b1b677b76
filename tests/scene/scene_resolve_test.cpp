// A scene with its defaults written out is the same scene, whatever it left out. (Lights are given here, since the
// default direction becomes a unit vector when it is read.)
#include <gtest/gtest.h>

#include "drape/scene_reader.h"
#include "full_scene.h"

namespace drape {
namespace {

SceneDescription described(std::string_view text, std::span<const std::string> overrides = {}) {
    SceneResult result = read_scene_text(text, "scene", overrides);
    EXPECT_TRUE(result.scene.has_value()) << (result.errors.empty() ? "" : result.errors[0].text());
    return result.scene.value_or(SceneDescription{});
}

TEST(ResolvedScene, IsTheSameSceneWithEveryDefault) {
    const std::string least = R"({"cloths": [{"grid": [3, 2], "size": [1, 1]}], "lights": []})";
    const std::string text = resolved_scene(least);
    EXPECT_EQ(described(text), described(least));
    EXPECT_EQ(read_scene_text(text, "scene").warnings, std::vector<SceneError>{});
    for (const char* value : {"\"air_density\":1.2", "\"areal_density\":0.2", "\"fps\":60", "\"u\":"})
        EXPECT_NE(text.find(value), std::string::npos) << value << " in " << text;
}

TEST(ResolvedScene, KeepsWhatTheSceneSaysAndItsOverrides) {
    EXPECT_EQ(described(resolved_scene(testing::full_scene)), described(testing::full_scene));
    const std::vector<std::string> overrides{"/gravity=[0,-1,0]", "/solver={\"method\":\"relax\"}"};
    EXPECT_EQ(described(resolved_scene(testing::full_scene, overrides)), described(testing::full_scene, overrides));
}

// A default that contradicts a given value is left out: a capsule has one radius or two.
TEST(ResolvedScene, HasNoDefaultBesideItsAlternative) {
    const std::string text = R"({"cloths": [{"grid": [3, 2], "size": [1, 1]}], "lights": [],
        "colliders": {"capsules": [{"radii": [0.1, 0.2]}, {}]}})";
    EXPECT_EQ(described(resolved_scene(text)), described(text));
}

TEST(ResolvedScene, KeepsWhatAFabricSets) {
    for (const char* more :
         {"", ", \"stiffness\": {\"bend\": 1}", ", \"stiffness\": \"rigid\"", ", \"friction\": 0.1"}) {
        const std::string text = std::string(R"({"cloths": [{"fabric": "denim")") + more + "}], \"lights\": []}";
        EXPECT_EQ(described(resolved_scene(text)), described(text)) << text;
    }
    EXPECT_NE(resolved_scene(R"({"cloths": [{"fabric": "silk"}], "lights": []})").find("\"areal_density\":0.069"),
              std::string::npos);
}

TEST(ResolvedScene, OfWhatIsNoSceneIsItsErrors) { EXPECT_THROW(resolved_scene("{\"cloths\": 1}"), SceneFailure); }

}  // namespace
}  // namespace drape
