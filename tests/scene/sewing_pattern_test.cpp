// A sewing pattern becomes cloths and seams; what is wrong with one is told, with its place.
#include "scene/sewing_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "input/svg_path.h"

namespace drape {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;
using ::testing::SizeIs;

/// Two panels, sewn at their slanted sides: the front has an arc for a hem and is turned, the back is straight.
constexpr const char* skirt = R"({
"pattern": {"panels": {
 "front": {"translation": [10, 100, 20], "rotation": [0, 90, 0], "vertices": [[0, 0], [-20, -60], [60, -60], [40, 0]],
  "edges": [{"endpoints": [0, 1]},
            {"endpoints": [1, 2], "curvature": {"type": "circle", "params": [50, 0, 1]}},
            {"endpoints": [2, 3]},
            {"endpoints": [3, 0], "curvature": {"type": "quadratic", "params": [[0.5, 0.1]]}}]},
 "back": {"translation": [0, 100, -20], "rotation": [0, 0, 0], "vertices": [[0, 0], [40, 0], [60, -60], [-20, -60]],
  "edges": [{"endpoints": [0, 1], "curvature": {"type": "cubic", "params": [[0.25, 0], [0.75, 0.2]]}},
            {"endpoints": [1, 2]}, {"endpoints": [2, 3]}, {"endpoints": [3, 0]}]}},
 "stitches": [[{"panel": "front", "edge": 0}, {"panel": "back", "edge": 3}],
              [{"panel": "front", "edge": 2}, {"panel": "back", "edge": 1}]]},
"properties": {"curvature_coords": "relative", "units_in_meter": 100}})";

Json::Value scene_of(const std::string& text, const PatternOptions& options = {}) {
    const PatternResult result = read_sewing_pattern_text(text, "p", options);
    for (const SceneError& error : result.errors) ADD_FAILURE() << error.text();
    Json::Value scene;
    std::istringstream(result.scene) >> scene;
    return scene;
}

std::vector<double> numbers(const Json::Value& array) {
    std::vector<double> list;
    for (const Json::Value& each : array) list.push_back(each.asDouble());
    return list;
}

TEST(SewingPattern, PanelsBecomeClothsWithOutlines) {
    const Json::Value scene = scene_of(skirt, {0.02, 0.5, "wool", {"figure.obj"}});
    ASSERT_EQ(scene["cloths"].size(), 2u);
    const Json::Value &back = scene["cloths"][0], &front = scene["cloths"][1];
    EXPECT_EQ(back["name"], "back");
    EXPECT_EQ(back["fabric"], "wool");
    EXPECT_EQ(back["outline"]["spacing"], 0.02);
    EXPECT_THAT(numbers(back["placement"]["origin"]), ElementsAre(0, 1, -0.2));
    EXPECT_EQ(front["name"], "front");
    // A quarter turn about y takes x to -z.
    EXPECT_THAT(numbers(front["placement"]["u"]), Pointwise(DoubleNear(1e-12), {0., 0., -1.}));
    EXPECT_THAT(numbers(front["placement"]["v"]), ElementsAre(0, 1, 0));
    EXPECT_EQ(scene["colliders"]["meshes"][0]["file"], "figure.obj");
    EXPECT_EQ(scene["time"]["frames"], 168);
    EXPECT_EQ(scene["gravity_keys"][1]["t"], 0.5);
}

/// The lowest point of the hem's arc is below its chord by what a circle's segment is high.
TEST(SewingPattern, CurvesAreWherePatternsHaveThem) {
    const Json::Value scene = scene_of(skirt);
    const auto front = input::read_path(scene["cloths"][1]["outline"]["path"].asString(), 1e-6);
    ASSERT_EQ(front.size(), 1u);
    double lowest = 0, waist = 0;
    for (const auto& [x, y] : front[0].points) {
        lowest = std::min(lowest, y);
        if (std::abs(x - 0.2) < 0.005) waist = std::max(waist, y);
    }
    EXPECT_NEAR(lowest, -0.6 - (0.5 - std::sqrt(0.25 - 0.16)), 1e-5);
    // The waist goes from right to left, so that what is left of it is below; its middle is half as low as its control.
    double below = 0;
    for (const auto& [x, y] : front[0].points)
        if (y > -0.03 && x > 0.15 && x < 0.25) below = std::min(below, y);
    EXPECT_NEAR(below, -0.02, 1e-4);
    EXPECT_LE(waist, 0);
    const auto back = input::read_path(scene["cloths"][0]["outline"]["path"].asString(), 1e-6);
    double highest = 0;
    for (const auto& [x, y] : back[0].points) highest = std::max(highest, y);
    // 3 (1 - t) t^2 0.2 is greatest at t = 2/3, of a waist that is 0.4 m long.
    EXPECT_NEAR(highest, 0.4 * 0.2 * 4 / 9, 1e-5);
}

TEST(SewingPattern, StitchesBecomeSeams) {
    const Json::Value scene = scene_of(skirt, {0.02, 0.5});
    ASSERT_EQ(scene["seams"].size(), 2u);
    const Json::Value& seam = scene["seams"][0];
    EXPECT_EQ(seam["close"], 0.5);
    EXPECT_EQ(seam["a"]["cloth"], "front");
    EXPECT_THAT(numbers(seam["a"]["from"]), ElementsAre(0, 0));
    EXPECT_THAT(numbers(seam["a"]["to"]), ElementsAre(-0.2, -0.6));
    EXPECT_FALSE(seam["a"].isMember("way"));
    EXPECT_EQ(seam["b"]["cloth"], "back");
    EXPECT_THAT(numbers(seam["b"]["from"]), ElementsAre(-0.2, -0.6));
}

/// A control point in the panel's own axes is the same curve as one along the edge.
TEST(SewingPattern, CoordinatesOfCurvesMayBeAbsolute) {
    const std::string panel = R"({"pattern": {"panels": {"a": {"vertices": [[0, 0], [2, 0], [2, 2]], "edges": [
        {"endpoints": [0, 1], "curvature": )";
    const std::string rest = R"(}, {"endpoints": [1, 2]}, {"endpoints": [2, 0]}]}}},
        "properties": {"units_in_meter": 1, "curvature_coords": ")";
    const Json::Value absolute = scene_of(panel + "[1, -0.4]" + rest + "absolute\"}}");
    const Json::Value relative = scene_of(panel + "[0.5, -0.2]" + rest + "relative\"}}");
    EXPECT_EQ(absolute["cloths"][0]["outline"]["path"], relative["cloths"][0]["outline"]["path"]);
}

/// An edge that is most of the rim is the longer way round it.
TEST(SewingPattern, LongEdgesGoTheLongerWay) {
    const Json::Value scene = scene_of(R"({"pattern": {"panels": {"disc": {"vertices": [[0, 0], [0.2, 0], [0.2, 0.2]],
        "edges": [{"endpoints": [0, 1], "curvature": {"type": "circle", "params": [1, true, false]}},
                  {"endpoints": [1, 2]}, {"endpoints": [2, 0]}]}},
        "stitches": [[{"panel": "disc", "edge": 0}, {"panel": "disc", "edge": 1}]]},
        "properties": {"units_in_meter": 1}})");
    EXPECT_EQ(scene["seams"][0]["a"]["way"], "longer");
    EXPECT_FALSE(scene["seams"][0]["b"].isMember("way"));
}

std::vector<std::string> errors_of_pattern(const std::string& text) {
    std::vector<std::string> texts;
    const PatternResult result = read_sewing_pattern_text(text, "p", {});
    EXPECT_TRUE(result.scene.empty() != result.errors.empty());
    for (const SceneError& error : result.errors) texts.push_back(error.text());
    return texts;
}

TEST(SewingPattern, WhatIsWrongIsTold) {
    EXPECT_THAT(errors_of_pattern("{"), SizeIs(1));
    EXPECT_THAT(errors_of_pattern("[]"),
                ElementsAre("p:1:1: /pattern/panels: expected an object of 1 to 1000 panels, by name, got nothing"));
    const auto panel = [](const std::string& edges, const std::string& stitches = "[]") {
        return "{\"pattern\": {\"panels\": {\"a\": {\"vertices\": [[0, 0], [1, 0], [0, 1]],\n\"edges\": " + edges +
               "}},\n\"stitches\": " + stitches + "}}";
    };
    EXPECT_THAT(
        errors_of_pattern(panel(R"([{"endpoints": [0, 1]}, {"endpoints": [2, 0]}])")),
        ElementsAre("p:2:48: /pattern/panels/a/edges/1/endpoints: expected the edge to begin at vertex 1, where "
                    "the one before it ends, got 2"));
    EXPECT_THAT(errors_of_pattern(panel(R"([{"endpoints": [0, 3]}, {"endpoints": [1, 0]}])")),
                ElementsAre("p:2:29: /pattern/panels/a/edges/0/endpoints/1: expected an integer from 0 to 2, got 3"));
    EXPECT_THAT(
        errors_of_pattern(panel(R"([{"endpoints": [0, 1], "curvature": {"type": "spline"}}, {"endpoints": [1, 0]}])")),
        ElementsAre("p:2:55: /pattern/panels/a/edges/0/curvature/type: expected \"quadratic\" or \"cubic\" or "
                    "\"circle\", got \"spline\""));
    EXPECT_THAT(errors_of_pattern(panel(R"([{"endpoints": [0, 1]}, {"endpoints": [1, 0]}])",
                                        R"([[{"panel": "a", "edge": 0}, {"panel": "b", "edge": 1}]])")),
                ElementsAre("p:3:52: /pattern/stitches/0/1/panel: expected the name of a panel, got \"b\""));
}

}  // namespace
}  // namespace drape
