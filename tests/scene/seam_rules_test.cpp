// What cannot be sewn is told, with its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/scene_reader.h"

namespace drape {
namespace {

std::vector<std::string> errors_of_seams(const std::string& text) {
    std::vector<std::string> texts;
    for (const SceneError& error : read_scene_text(text, "s").errors)
        texts.push_back(std::to_string(error.line) + ": " + error.pointer + ": " + error.message);
    return texts;
}

TEST(SeamRules, TellWhatCannotBeSewn) {
    EXPECT_EQ(errors_of_seams(R"({"cloths": [{"name": "a", "grid": [5, 5]}, {"name": "b", "grid": [5, 9]},
 {"name": "c", "grid": [5, 5], "placement": {"origin": [0, -1.01, 0]}}],
"seams": [{"a": {"cloth": "a", "edge": "right"}, "b": {"cloth": "b", "edge": "left"}},
 {"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "c", "edge": "top"}},
 {"a": {"cloth": "a", "edge": "left"}, "b": {"cloth": "q", "edge": "top"}},
 {"a": {"cloth": "a", "edge": "left"}, "b": {"cloth": "a", "edge": "left"}}]})"),
              (std::vector<std::string>{
                  "3: /seams/0: expected edges of as many particles, got 5 and 9",
                  "4: /seams/1: expected edges that start together, within 0.00025 m (a thousandth of a cell), got a "
                  "gap of 0.01 m at particle [0, 4] of \"a\"",
                  "5: /seams/2/b/cloth: expected the name of a cloth of the scene, got \"q\"",
                  "6: /seams/3/b: expected another edge than that of a, got the same"}));
}

TEST(SeamRules, TellWhatSeamsDoNotGoWith) {
    const auto with = [](const std::string& of_a, const std::string& of_b, const std::string& of_scene) {
        return errors_of_seams(
            R"({"cloths": [{"name": "a", "grid": [5, 5])" + of_a +
            R"(}, {"name": "b", "grid": [5, 5], "placement": {"origin": [0, -1, 0]})" + of_b + "}]" + of_scene +
            ",\n"
            R"("seams": [{"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "b", "edge": "top"}}]})");
    };
    using SeamTexts = std::vector<std::string>;
    EXPECT_EQ(with("", "", ""), SeamTexts{});
    EXPECT_EQ(
        with(R"(, "self_collision": true)", "", ""),
        SeamTexts{"2: /seams: expected no seams where cloths have self_collision: contact does not know them yet"});
    EXPECT_EQ(
        with("", "", R"(, "solver": {"method": "line"}, "colliders": {"spheres": [{"mass": 9, "center": [9, 0, 0]}]})"),
        SeamTexts{"2: /seams: expected no seams beside a body with a mass: what a seam evens out, the body would "
                  "not get back"});
    EXPECT_EQ(with("", "", R"(, "forces": true)"),
              SeamTexts{"2: /seams: expected no seams beside forces: what a seam transmits is not told yet"});
    EXPECT_EQ(
        with(R"(, "pins": [{"edge": "bottom"}])", R"(, "pins": [{"corner": "top_left", "release": 1}])", ""),
        SeamTexts{"2: /seams: expected one pin alone where it moves or lets go, got 2 at the sewn particle [0, 4] of "
                  "\"a\""});
}

}  // namespace
}  // namespace drape
