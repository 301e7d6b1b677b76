// What does not close gas in is told, with its place; what does is found, with its sides.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "drape/scene_reader.h"
#include "support/gas_scenes.h"
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

using Sides = std::array<std::string, 2>;

std::string side(const std::string& cloth, const std::string& edge) {
    return R"({"cloth": ")" + cloth + R"(", "edge": ")" + edge + "\"}";
}

/// Squares of 1 m whose sides are sewn as `seams` says.
std::string sewn_together(const std::vector<std::string>& cloths, const std::vector<Sides>& seams,
                          const std::string& gas) {
    std::string text = R"({"cloths": [)", comma;
    for (const std::string& cloth : cloths)
        text += std::exchange(comma, ", ") + R"({"name": ")" + cloth + R"(", "grid": [5, 5]})";
    text += R"(], "seams": [)";
    comma.clear();
    for (const auto& [a, b] : seams) text += std::exchange(comma, ", ") + R"({"a": )" + a + R"(, "b": )" + b + "}";
    return text + "],\n\"gas\": [" + gas + "]}";
}

/// The seams by which two squares lie on each other.
std::vector<Sides> on_each_other(const std::string& a, const std::string& b) {
    std::vector<Sides> seams;
    for (const std::string edge : {"left", "right", "top", "bottom"}) seams.push_back({side(a, edge), side(b, edge)});
    return seams;
}

TEST(GasRules, TellWhatIsNotOneBody) {
    std::vector<Sides> seams = on_each_other("a", "b");
    for (const Sides& seam : on_each_other("c", "d")) seams.push_back(seam);
    EXPECT_EQ(errors_of_gas(sewn_together({"a", "b", "c", "d"}, seams,
                                          R"({"cloths": ["a", "b", "c", "d"], "volume": 1, "outside": "front"})")),
              (GasTexts{"2: /gas/0/cloths: expected cloths that are all sewn together, got \"c\", which nothing "
                        "sews to \"a\""}));
    seams.push_back({side("b", "left"), side("c", "left")});
    EXPECT_EQ(errors_of_gas(sewn_together({"a", "b", "c", "d"}, seams,
                                          R"({"cloths": ["a", "b"], "volume": 1, "outside": "front"},
{"cloths": ["c", "d"], "volume": 1, "outside": "front"})")),
              (GasTexts{"3: /gas/1/cloths: expected no seam with a cloth of another gas, got one of \"c\""}));
}

TEST(GasRules, TellASideThatIsInside) {
    SceneDescription scene = test::gas_cushion(SolverMethod::line, 5, 1, 0.1);
    for (const auto& [side, faults] : {std::pair{ClothSide::front, 1u}, std::pair{ClothSide::back, 0u}}) {
        scene.gas[0].outside = side;
        EXPECT_EQ(gas_faults(scene).size(), faults);
    }
    scene.gas[0].outside = ClothSide::front;
    const GasFault fault = gas_faults(scene).at(0);
    EXPECT_EQ(fault.below, "/0/outside");
    EXPECT_EQ(fault.text,
              "expected the side of \"top\" that is outside where the cloths start, got that which is inside");
}

TEST(GasRules, TellWhatHasNoInside) {
    // Two squares make a ring of tubes. Its ends meet as a torus has them or, as their places say, turned over.
    SceneDescription scene = test::gas_cushion(SolverMethod::line, 5, 1, 0.1);
    scene.seams = {{{"top", SeamEdge::right}, {"bottom", SeamEdge::left}},
                   {{"top", SeamEdge::top}, {"top", SeamEdge::bottom}},
                   {{"bottom", SeamEdge::top}, {"bottom", SeamEdge::bottom}},
                   {{"bottom", SeamEdge::right}, {"top", SeamEdge::left}}};
    scene.gas[0].outside = {};
    EXPECT_EQ(gas_faults(scene).size(), 0u);
    for (std::size_t row = 0; row < 5; ++row) scene.cloths[0].start[5 * row][2] *= -1;
    const std::vector<GasFault> faults = gas_faults(scene);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].below, "/0/cloths");
    EXPECT_EQ(faults[0].text, "expected a surface with an inside, got \"top\" and \"bottom\" sewn to a one-sided one");
}

}  // namespace
}  // namespace drape
