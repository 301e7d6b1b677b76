// What does not close gas in is told, with its place; what does is found, with its sides.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/scene_reader.h"
#include "world/gas.h"

namespace drape {
namespace {

std::vector<std::string> errors_of_gas(const std::string& text) {
    std::vector<std::string> texts;
    for (const SceneError& error : read_scene_text(text, "s").errors)
        texts.push_back(std::to_string(error.line) + ": " + error.pointer + ": " + error.message);
    return texts;
}

/// Two flat squares whose borders are sewn as `seams` says, and other keys of the scene.
std::string sewn_squares(const std::string& gas, const std::string& more = "",
                         const std::vector<std::string>& edges = {"left", "right", "top", "bottom"},
                         const std::string& of_seam = "") {
    std::string seams;
    for (const std::string& edge : edges)
        seams += std::string(seams.empty() ? "" : ", ") + R"({"a": {"cloth": "a", "edge": ")" + edge +
                 R"("}, "b": {"cloth": "b", "edge": ")" + edge + "\"}" + of_seam + "}";
    return R"({"cloths": [{"name": "a", "grid": [5, 5]}, {"name": "b", "grid": [5, 5]}], "seams": [)" + seams + "],\n" +
           more + "\"gas\": [" + gas + "]}";
}

using GasTexts = std::vector<std::string>;

TEST(GasRules, TakeWhatIsClosed) {
    const SceneResult read = read_scene_text(
        sewn_squares(R"({"cloths": ["a", "b"], "volume_keys": [{"t": 0, "volume": 0}, {"t": 1, "volume": 0.2}],
                    "ambient": 5e4, "outside": "back"})"),
        "s");
    ASSERT_TRUE(read.errors.empty()) << read.errors.front().message;
    const SceneDescription& scene = *read.scene;
    EXPECT_EQ(scene.gas[0].ambient, 5e4);
    EXPECT_DOUBLE_EQ(gas_at(scene.gas[0], 0.25), 0.05);
    EXPECT_EQ(gas_walls(scene, scene.gas[0]), (std::vector<GasWall>{{0, -1}, {1, 1}}));
    EXPECT_EQ(start_volume(scene, gas_walls(scene, scene.gas[0])), 0);
}

TEST(GasRules, TellWhatOpensIt) {
    const std::string gas = R"({"cloths": ["a", "b"], "volume": 1, "outside": "front"})";
    EXPECT_EQ(errors_of_gas(sewn_squares(gas, "", {"left", "right", "top"})),
              (GasTexts{"2: /gas/0/cloths: expected a closed surface, got \"a\" open along its edge bottom"}));
    EXPECT_EQ(errors_of_gas(sewn_squares(gas, "", {"left", "right", "top", "bottom"}, ", \"rip\": 3")),
              (GasTexts{"2: /gas/0/cloths/0: expected no seam that rips around gas, got one of \"a\""}));
    EXPECT_EQ(
        errors_of_gas(sewn_squares(gas, "", {"left", "right", "top", "bottom"}, ", \"close\": 3")),
        (GasTexts{"2: /gas/0/cloths/0: expected seams around gas that are closed from the start on, got one of \"a\" "
                  "that closes later"}));
    EXPECT_EQ(errors_of_gas(
                  sewn_squares(gas, R"("cutters": [{"triangle": [[0, 1, 0], [1, 1, 0], [0, 2, 0.5]], "active": [0, 1]}],
)")),
              (GasTexts{"3: /gas: expected no gas beside cutters, which would let it out"}));
    std::string torn = sewn_squares(gas);
    torn.replace(torn.find("[5, 5]"), 6, R"([5, 5], "tear": {"strain": 9})");
    EXPECT_EQ(errors_of_gas(torn),
              (GasTexts{"2: /gas/0/cloths/0: expected no cloth that tears around gas, got \"a\""}));
    std::string holed = sewn_squares(gas);
    holed.replace(holed.find("[5, 5]"), 6, R"([5, 5], "holes": [[[1, 1], [3, 3]]])");
    EXPECT_EQ(errors_of_gas(holed),
              (GasTexts{"2: /gas/0/cloths: expected a closed surface, got \"a\" open along its rim at "
                        "particle [2, 1]"}));
}

TEST(GasRules, TellWhatTheyDoNotKnow) {
    EXPECT_EQ(errors_of_gas(sewn_squares(R"({"cloths": ["a", "c"], "volume": 1})")),
              (GasTexts{"2: /gas/0/cloths/1: expected the name of a cloth of the scene, got \"c\""}));
    EXPECT_EQ(errors_of_gas(sewn_squares(R"({"cloths": ["a", "b"], "volume": 1, "outside": "front"},
 {"cloths": ["b"], "volume": 1})")),
              (GasTexts{"3: /gas/1/cloths/0: expected a cloth that closes in no other gas, got \"b\" again"}));
    EXPECT_EQ(
        errors_of_gas(sewn_squares(R"({"cloths": ["a", "b"], "volume": 1})")),
        (GasTexts{"2: /gas/0: expected outside, front or back, where the cloths start flat and close nothing in"}));
    EXPECT_EQ(errors_of_gas(sewn_squares(R"({"cloths": ["a", "b"], "outside": "front"})")),
              (GasTexts{"2: /gas/0: expected a volume or volume_keys"}));
    EXPECT_EQ(errors_of_gas(sewn_squares(R"({"cloths": ["a"], "volume": 1})")),
              (GasTexts{"2: /gas/0/cloths: expected a closed surface, got \"a\" open along its edge top"}));
    EXPECT_EQ(errors_of_gas(sewn_squares(R"({"cloths": ["a", "b"], "volume": -1, "ambient": 0})")).size(), 2u);
}

TEST(GasRules, TellWhereMoreThanTwoSidesMeet) {
    std::string ring =
        R"({"cloths": [{"name": "a", "grid": [5, 5]}, {"name": "b", "grid": [5, 5]}, {"name": "c", "grid": [5, 5]}], "seams": [)";
    for (const std::string edge : {"left", "right", "top", "bottom"})
        for (const std::string other : {"b", "c"})
            ring += std::string(ring.ends_with('[') ? "" : ", ") + R"({"a": {"cloth": "a", "edge": ")" + edge +
                    R"("}, "b": {"cloth": ")" + other + R"(", "edge": ")" + edge + "\"}}";
    EXPECT_EQ(
        errors_of_gas(ring +
                      "],\n\"gas\": [{\"cloths\": [\"a\", \"b\", \"c\"], \"volume\": 1, \"outside\": \"front\"}]}"),
        (GasTexts{"2: /gas/0/cloths: expected two sides of the surface at each place of its seams, got more at \"c\" "
                  "along its edge top"}));
}

}  // namespace
}  // namespace drape
