// What cannot be sewn is told, with its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/scene_reader.h"
#include "world/seams.h"

namespace drape {
namespace {

using SeamTexts = std::vector<std::string>;

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
 {"a": {"cloth": "a", "edge": "left"}, "b": {"cloth": "a", "edge": "left"}},
 {"a": {"cloth": "a", "edge": "left"}, "b": {"cloth": "b", "from": [0, 0]}},
 {"a": {"cloth": "a", "edge": "left", "to": [0, 0]}, "b": {"cloth": "b", "edge": "left"}}]})"),
              (std::vector<std::string>{
                  "3: /seams/0: expected sides that start together, within 0.000125 m, or close, got a gap of 1 m at "
                  "particle [4, 0] of \"a\"",
                  "4: /seams/1: expected sides that start together, within 0.00025 m, or close, got a gap of 0.01 m at "
                  "particle [0, 4] of \"a\"",
                  "5: /seams/2/b/cloth: expected the name of a cloth of the scene, got \"q\"",
                  "6: /seams/3/b: expected another side than a, got the same",
                  "7: /seams/4/b: expected an edge, or two points from and to",
                  "8: /seams/5/a: expected an edge, or two points from and to"}));
}

TEST(SeamRules, TellWhereAPieceIsNotOnARim) {
    EXPECT_EQ(errors_of_seams(R"({"cloths": [{"name": "a", "grid": [5, 5], "holes": [[[1, 1], [2, 2]]]},
 {"name": "disc", "outline": {"path": "M 1 0 A 1 1 0 0 0 3 0 A 1 1 0 0 0 1 0 Z", "spacing": 0.1}}],
"seams": [{"a": {"cloth": "a", "edge": "left"}, "b": {"cloth": "disc", "from": [1, 0], "to": [2, 0.5]}},
 {"a": {"cloth": "a", "from": [0, 0], "to": [0.5, 0.5]}, "b": {"cloth": "a", "edge": "right"}},
 {"a": {"cloth": "a", "from": [0, 0], "to": [0.02, 0.05]}, "b": {"cloth": "a", "edge": "right"}}]})"),
              (std::vector<std::string>{
                  "3: /seams/0/b/to: expected a point on the rim of \"disc\", within half a cell of a particle, got "
                  "one at 0.5 m from it: the nearest is [2, 1]",
                  "4: /seams/1/a/to: expected a point on the same rim as from",
                  "5: /seams/2/a/to: expected a point nearest to another particle than from"}));
}

/// Returns the sewing of two sheets of 1 m whose top borders coincide, with these columns and sides.
Sewing sewing_of_tops(const std::string& columns, const std::string& a, const std::string& b) {
    const SceneResult read = read_scene_text(R"({"cloths": [{"name": "a", "grid": [9, 5]}, {"name": "b", "grid": [)" +
                                                 columns + R"(, 5]}], "seams": [{"a": {"cloth": "a", )" + a +
                                                 R"(}, "b": {"cloth": "b", )" + b + "}}]}",
                                             "s");
    EXPECT_TRUE(read.errors.empty()) << (read.errors.empty() ? "" : read.errors.front().message);
    return read.scene ? sewing_of(*read.scene) : Sewing{};
}

TEST(Sewing, LaysTheFinerSideBetweenTheCoarserByLength) {
    const std::string top = R"("edge": "top")";
    EXPECT_EQ(sewing_of_tops("9", top, top).stations.size(), 9u);
    const Sewing twice = sewing_of_tops("17", top, top);  // every second one meets a particle
    EXPECT_EQ(twice.stations.size(), 9u);
    ASSERT_EQ(twice.between.size(), 8u);
    for (const SewnBetween& each : twice.between) EXPECT_NEAR(each.weights[0], 0.5, 1e-12);
    const Sewing coarse = sewing_of_tops("4", top, top);  // the second cloth leads
    ASSERT_EQ(coarse.stations.size(), 4u);
    ASSERT_EQ(coarse.between.size(), 7u);
    EXPECT_EQ(coarse.stations[0].group.size(), 2u);
    const SewnMember second{0, 1};
    EXPECT_EQ(coarse.between[0].group, SewnGroup{second});
    EXPECT_NEAR(coarse.between[0].weights[1], 3.0 / 8, 1e-12) << "an eighth of the way, of pieces of a third";
}

TEST(Sewing, TakesPiecesOfRimsOnEitherWay) {
    const std::string piece = R"("from": [0.25, 0], "to": [0.75, 0])";
    const Sewing shorter = sewing_of_tops("9", piece, piece);
    ASSERT_EQ(shorter.stations.size(), 5u);
    EXPECT_EQ(shorter.stations.front().group, (SewnGroup{{0, 2}, {1, 2}}));
    EXPECT_EQ(shorter.stations.back().group, (SewnGroup{{0, 6}, {1, 6}}));
    const std::string way = piece + R"(, "way": "longer")";
    const Sewing longer = sewing_of_tops("9", way, way);
    EXPECT_EQ(longer.stations.size(), 24u - 3u) << "all of the rim but what lies on the shorter way";
}

TEST(Sewing, FindsPointsOfAnOutlineInItsCoordinates) {
    const SceneResult read = read_scene_text(
        R"({"cloths": [{"name": "a", "outline": {"path": "M 3 5 H 4 V 6 H 3 Z", "spacing": 0.1},
  "placement": {"u": [1, 0, 0], "v": [0, 0, 1]}},
 {"name": "b", "outline": {"path": "M -1 -1 H 0 V 0 H -1 Z", "spacing": 0.25},
  "placement": {"origin": [4, 0, 6], "u": [1, 0, 0], "v": [0, 0, 1]}}],
"seams": [{"a": {"cloth": "a", "from": [3, 5], "to": [4, 5]}, "b": {"cloth": "b", "from": [-1, -1], "to": [0, -1]}}]})",
        "s");
    ASSERT_TRUE(read.errors.empty()) << read.errors.front().message;
    const Sewing sewing = sewing_of(*read.scene);
    EXPECT_EQ(sewing.stations.size(), 5u);
    EXPECT_EQ(sewing.between.size(), 8u) << "of eleven particles the ends and the middle meet others";
}

TEST(SeamRules, TellWhatLiesBetweenOthersTwice) {
    EXPECT_EQ(errors_of_seams(R"({"cloths": [{"name": "a", "grid": [5, 5]}, {"name": "b", "grid": [8, 5]},
 {"name": "c", "grid": [12, 5], "pins": [{"edge": "top"}]}],
"seams": [{"a": {"cloth": "a", "edge": "top"}, "b": {"cloth": "b", "edge": "top"}},
 {"a": {"cloth": "b", "edge": "top"}, "b": {"cloth": "c", "edge": "top"}}]})"),
              std::vector<std::string>{"4: /seams/1: expected no particle that other seams lay between others too, got "
                                       "particle [1, 0] of \"b\": sew the finer sides to the coarsest"});
    EXPECT_EQ(
        errors_of_seams(R"({"cloths": [{"name": "a", "grid": [5, 5]},
 {"name": "c", "grid": [12, 5], "pins": [{"edge": "top"}]}],
"seams": [
 {"a": {"cloth": "a", "edge": "top"}, "b": {"cloth": "c", "edge": "top"}}]})"),
        std::vector<std::string>{"4: /seams/0: expected pins of the coarser side where the finer one is held, got "
                                 "none of particle [1, 0] of \"a\" beside particle [1, 0] of \"c\""});
}

TEST(SeamRules, TellWhatSeamsDoNotGoWith) {
    const auto with = [](const std::string& of_a, const std::string& of_b, const std::string& of_scene) {
        return errors_of_seams(
            R"({"cloths": [{"name": "a", "grid": [5, 5])" + of_a +
            R"(}, {"name": "b", "grid": [5, 5], "placement": {"origin": [0, -1, 0]})" + of_b + "}]" + of_scene +
            ",\n"
            R"("seams": [{"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "b", "edge": "top"}}]})");
    };
    EXPECT_EQ(with("", "", ""), SeamTexts{});
    EXPECT_EQ(with(R"(, "self_collision": true)", "", ""), SeamTexts{});
    const auto beside_body = [&](const std::string& of_a, const std::string& method) {
        return with(of_a, "",
                    R"(, "solver": {"method": ")" + method +
                        R"("}, "colliders": {"spheres": [{"mass": 9, "center": [9, 0, 0]}]})");
    };
    for (const char* method : {"line", "relax"}) EXPECT_EQ(beside_body("", method), SeamTexts{});
    for (const char* method : {"explicit", "auto"})
        EXPECT_EQ(beside_body("", method),
                  SeamTexts{"2: /seams: expected method line or relax where seams are beside a body with a mass: by "
                            "others they do not keep the momentum of both"});
    EXPECT_EQ(beside_body(R"(, "self_collision": true)", "relax"),
              SeamTexts{"2: /seams: expected no seams beside a body with a mass where cloths have self_collision: all "
                        "that is sewn touches it at once, and it would get back the sum"});
    EXPECT_EQ(errors_of_seams(R"({"cloths": [{"name": "a", "grid": [5, 5]}, {"name": "b", "grid": [8, 5]}],
"solver": {"method": "relax"}, "colliders": {"spheres": [{"mass": 9, "center": [9, 0, 0]}]},
"seams": [{"a": {"cloth": "a", "edge": "top"}, "b": {"cloth": "b", "edge": "top"}}]})"),
              SeamTexts{"3: /seams/0: expected sides of as many particles each beside a body with a mass: what lies "
                        "between others would touch it, and not move"});
    EXPECT_EQ(with("", "", R"(, "forces": true)"), SeamTexts{});
    EXPECT_EQ(
        with(R"(, "self_collision": true)", "", R"(, "forces": true)"),
        SeamTexts{"2: /seams: expected no seams beside forces where cloths have self_collision: what contact gives "
                  "to what is sewn is not told yet"});
    EXPECT_EQ(
        with("", "", R"(, "forces": true, "colliders": {"planes": [{}]})"),
        SeamTexts{
            "2: /seams: expected method line or relax where seams are beside forces and colliders: by others what "
            "touches at a seam is not all told"});
    EXPECT_EQ(
        with(R"(, "pins": [{"edge": "bottom"}])", R"(, "pins": [{"corner": "top_left", "release": 1}])", ""),
        SeamTexts{"2: /seams: expected one pin alone where it moves or lets go, got 2 at the sewn particle [0, 4] of "
                  "\"a\""});
}

TEST(SeamRules, TellWhatSeamsThatRipDoNotGoWith) {
    const auto with = [](const std::string& of_a, const std::string& of_scene, const std::string& of_seam) {
        return errors_of_seams(
            R"({"cloths": [{"name": "a", "grid": [5, 5])" + of_a +
            R"(}, {"name": "b", "grid": [5, 5], "placement": {"origin": [0, -1, 0]}},
 {"name": "c", "grid": [5, 5], "placement": {"origin": [0, -1, 0]}}])" +
            of_scene +
            ",\n"
            R"("seams": [{"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "b", "edge": "top"}, "rip": 100)" +
            of_seam + "}]}");
    };
    EXPECT_EQ(with("", "", ""), SeamTexts{});
    EXPECT_EQ(with(R"(, "pins": [{"edge": "top"}])", "", ""), SeamTexts{});
    EXPECT_EQ(with(R"(, "pins": [{"at": [2, 4]}])", "", ""),
              SeamTexts{"3: /seams/0/rip: expected no pin at a seam that rips, got one of particle [2, 4] of \"a\""});
    EXPECT_EQ(with("", "", R"(, "close": 1)"),
              SeamTexts{"3: /seams/0/rip: expected no rip of a seam that is closed later"});
    EXPECT_EQ(with("", R"(, "colliders": {"planes": [{}]})", ""),
              SeamTexts{"3: /seams/0/rip: expected no colliders beside a seam that rips"});
    EXPECT_EQ(with(R"(, "self_collision": true)", "", ""),
              SeamTexts{"3: /seams/0/rip: expected no self_collision beside a seam that rips"});
    EXPECT_EQ(with("", R"(, "solver": {"tethers": true})", ""),
              SeamTexts{"3: /seams/0/rip: expected no tethers beside a seam that rips"});
    EXPECT_EQ(
        with("", "", R"(}, {"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "c", "edge": "top"}, "rip": 50)"),
        SeamTexts{"3: /seams/1/rip: expected two particles at each place of a seam that rips, got 3 at the sewn "
                  "particle [0, 4] of \"a\""});
    EXPECT_EQ(with("", "", "").size(), 0u);
}

TEST(Sewing, SharesTheLengthOfASeamThatRips) {
    const SceneResult read = read_scene_text(R"({"cloths": [{"name": "a", "grid": [5, 5], "size": [2, 1]},
 {"name": "b", "grid": [5, 5], "size": [2, 1], "placement": {"origin": [0, -1, 0]}}],
"seams": [{"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "b", "edge": "top"}, "rip": 100}]})",
                                             "s");
    ASSERT_TRUE(read.scene);
    const Sewing sewing = sewing_of(*read.scene);
    ASSERT_EQ(sewing.stations.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(sewing.stations[k].rip.length, k % 4 == 0 ? 0.25 : 0.5, 1e-12);
        EXPECT_NEAR(sewing.stations[k].rip.load, k % 4 == 0 ? 25 : 50, 1e-9);
    }
}

}  // namespace
}  // namespace drape
