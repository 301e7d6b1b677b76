// Where cloths may have passed through each other, the run says so wherever a user may look, and from which frame on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "run/contact_proof.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A sheet's lower edge is carried through its upper half.
const std::string held_across_itself = R"({"name": "across", "gravity": [0, 0, 0], "time": {"frames": 31},
"cloths": [{"name": "sheet", "grid": [13, 13], "self_collision": {"thickness": 0.03}, "pins": [
  {"edge": "top"}, {"box": [[0, 6], [12, 6]]},
  {"edge": "bottom", "path": [{"t": 0}, {"t": 0.25, "translate": [0.1, 0.75, 0.2]},
                              {"t": 0.5, "translate": [0.2, 0.75, -0.3]}]}]}],
"solver": {"method": "line", "substeps": 8}})";

TEST(Crossings, OfHeldClothAreToldFromTheFrameOnInWhichTheProofEnds) {
    const SceneFolder folder(held_across_itself);
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--on-failure", "keep"});
    const Json::Value manifest = lasting_manifest(folder / "out"), &told = manifest["self_collision"];
    const int frame = told["first_unproved_frame"].asInt();
    EXPECT_GT(frame, 0);
    EXPECT_FALSE(told["proved"].asBool());
    const std::string from = "from frame " + std::to_string(frame) + " on ";
    EXPECT_THAT(told["certificate"].asString(), HasSubstr("not proved " + from.substr(0, from.size() - 1)));
    EXPECT_THAT(outcome.err, HasSubstr("warning: " + from + "it is not proved that no cloth passes through itself"));
    EXPECT_THAT(manifest["warnings"].toStyledString(), HasSubstr(from));
}

const std::string crossed_at_start = R"({"name": "crossed", "time": {"frames": 3},
"cloths": [{"name": "flat", "grid": [9, 9], "self_collision": true,
            "placement": {"origin": [-0.5, 0.5, -0.5], "v": [0, 0, 1]}},
           {"name": "upright", "grid": [7, 7], "placement": {"origin": [-0.4, 0.8, 0.03]}}],
"solver": {"method": "line", "substeps": 4}})";

TEST(Crossings, AtTheStartAreToldByNameNumberAndDepthOrRefused) {
    const SceneFolder folder(crossed_at_start);
    const std::string how = "cloths \"flat\" and \"upright\" start through each other (";
    const auto told = AllOf(HasSubstr("scene.json:4:61: /cloths/1/placement: "), HasSubstr(how),
                            HasSubstr(" pairs of triangles cross; moved by 0.3 m one would be off the other)"));
    EXPECT_THAT(drape({"check", folder.scene()}).err, told);
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(told, Not(HasSubstr("on it is not proved")),
                                   HasSubstr("warning: cloths that started through each other still are in the last")));
    const Json::Value manifest = lasting_manifest(folder / "out"), &contact = manifest["self_collision"];
    EXPECT_FALSE(contact["proved"].asBool());
    EXPECT_EQ(contact["certificate"].asString(),
              "not proved from frame 0 on: cloths that started through each other do not meet; of the others: no "
              "crossing in any substep");
    EXPECT_EQ(contact["crossed_at_start"][0][1].asString(), "upright");
    EXPECT_THAT(manifest["warnings"].toStyledString(), HasSubstr(" start through each other ("));
    for (const char* command : {"check", "simulate"}) {
        std::vector<std::string> arguments{command, folder.scene(), "--set", "/overlap=\"refuse\""};
        if (arguments[0] == "simulate") arguments.insert(arguments.end(), {"-o", folder.out("refused"), "-q"});
        const Outcome refused = drape(arguments);
        EXPECT_EQ(refused.code, 3) << command;
        EXPECT_THAT(refused.err, told) << command;
    }
}

TEST(Crossings, OfClothsThatCameApartAreToldUntilThen) {
    const SceneFolder folder(crossed_at_start);
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set", "/time/frames=61"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("they are led apart at 1 m/s and meet from then on"), Not(HasSubstr("still are"))));
    const Json::Value manifest = lasting_manifest(folder / "out"), &contact = manifest["self_collision"];
    const int since = contact["apart_since_frame"].asInt();
    EXPECT_GT(since, 10);
    EXPECT_LT(since, 40);
    EXPECT_EQ(contact["certificate"].asString(),
              "not proved before frame " + std::to_string(since) +
                  ": cloths that started through each other have come apart; since then, and of the others: no "
                  "crossing in any substep");
    EXPECT_FALSE(contact["proved"].asBool());
}

TEST(Crossings, OfAClothThatWouldStartThroughItselfAreUntied) {
    const SceneFolder folder(R"({"name": "crushed", "time": {"frames": 3}, "solver": {"method": "line", "substeps": 4},
"cloths": [{"name": "sheet", "grid": [9, 9], "self_collision": true, "placement": {"jitter": 0.2}}]})");
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--on-failure", "keep"});
    EXPECT_THAT(outcome.err, HasSubstr("cloth \"sheet\" would start through itself by its jitter"));
    const Json::Value manifest = lasting_manifest(folder / "out"), &contact = manifest["self_collision"];
    EXPECT_TRUE(contact["proved"].asBool());
    EXPECT_EQ(contact["certificate"].asString(), "no crossing in any substep");
    EXPECT_EQ(drape({"check", folder.scene(), "--set", "/overlap=\"refuse\""}).code, 3);
}

const std::string cut_across_a_box = R"({"name": "cut", "time": {"frames": 13},
"cloths": [{"name": "sheet", "grid": [9, 9], "self_collision": true, "thickness": 0.025,
            "placement": {"origin": [-0.5, 0.5, -0.5], "v": [0, 0, 1]}}],
"colliders": {"boxes": [{"half_extents": [0.3, 0.3, 0.3]}]},
"cutters": [{"triangle": [[0.06, -9, -9], [0.03, -9, 9], [0.05, 9, 0]], "active": [0.075, 0.075]}],
"solver": {"method": "line", "substeps": 4}})";

TEST(Crossings, OfTrianglesThatCuttersSplitAreNotDenied) {
    const SceneFolder folder(cut_across_a_box);
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    // The blade cuts in frame 5, and passes through 8 rows of cells, one triangle each at least.
    const Json::Value manifest = lasting_manifest(folder / "out"), &contact = manifest["self_collision"];
    ASSERT_EQ(manifest["cuts"].size(), 1u);
    const Json::Value count = manifest["cuts"][0]["triangles"];
    EXPECT_GE(count.asUInt(), 8u);
    const std::string split = count.asString() + " triangles of cloth 'sheet' that were split from frame 6 on";
    EXPECT_TRUE(contact["proved"].asBool());
    EXPECT_EQ(contact["certificate"].asString(),
              "no crossing of whole triangles in any substep; not covered: " + split);
    for (const Json::Value& list : {contact["not_covered"], manifest["collider_edges"]["not_covered"]}) {
        ASSERT_EQ(list.size(), 1u);
        EXPECT_EQ(list[0]["cloth"].asString(), "sheet");
        EXPECT_EQ(list[0]["first_frame"].asInt(), 6);
        EXPECT_EQ(list[0]["triangles"], count);
    }
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("note: " + split + " meet no cloth and no edge of a collider; a finer grid"),
                      Not(HasSubstr("warning"))));
    EXPECT_EQ(drape({"report", folder.out()}).code, 0);
    EXPECT_THAT(read_text(folder / "out/report.html"),
                HasSubstr("Not covered: " + count.asString() + " triangles of cloth 'sheet', from frame 6 on."));
}

TEST(Crossings, TrianglesThatCuttersSplitFeelTheWind) {
    const SceneFolder folder(cut_across_a_box);
    const auto said = [&](const std::vector<std::string>& overrides) {
        std::vector<std::string> arguments{"simulate", folder.scene(), "-o", folder.out(), "--overwrite"};
        for (const std::string& each : overrides) arguments.insert(arguments.end(), {"--set", each});
        const Outcome outcome = drape(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err;
    };
    const std::string blows = "/wind/velocity=[0,3,0]";
    EXPECT_THAT(said({blows}), HasSubstr(" meet no cloth and no edge of a collider; a finer grid"));
    EXPECT_THAT(said({blows, "/cloths/0/self_collision=false", "/colliders={}"}), Not(HasSubstr("note: ")));
    EXPECT_EQ(lasting_manifest(folder / "out")["cuts"].size(), 1u);
}

TEST(Crossings, AreProvedOfAllTrianglesBeforeACutActs) {
    const SceneFolder folder(cut_across_a_box);
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "-e", "5"});
    const Json::Value manifest = lasting_manifest(folder / "out");
    EXPECT_EQ(manifest["cuts"].size(), 1u);
    EXPECT_EQ(manifest["self_collision"]["certificate"].asString(), "no crossing in any substep");
    EXPECT_FALSE(manifest.isMember("collider_edges"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("note: ")));
}

// Two sheets hang on each other, their seam has 9 and 7 particles.
const std::string sewn_of_unlike_sides = R"({"name": "sewn", "time": {"frames": 4},
"cloths": [{"name": "upper", "grid": [9, 5], "size": [1, 0.5], "self_collision": true, "pins": [{"edge": "top"}],
            "placement": {"origin": [-0.5, 1, 0]}},
           {"name": "lower", "grid": [7, 5], "size": [1, 0.5], "self_collision": true,
            "placement": {"origin": [-0.5, 0.5, 0]}}],
"seams": [{"a": {"cloth": "upper", "edge": "bottom"}, "b": {"cloth": "lower", "edge": "top"}}],
"solver": {"method": "line", "substeps": 4}})";

TEST(Crossings, OfTrianglesBesideSeamsAreNotDenied) {
    const SceneFolder folder(sewn_of_unlike_sides);
    const auto contact_with = [&](const std::vector<std::string>& overrides) {
        std::vector<std::string> arguments{"simulate", folder.scene(), "-o", folder.out(), "-q", "--overwrite"};
        for (const std::string& each : overrides) arguments.insert(arguments.end(), {"--set", each});
        const Outcome outcome = drape(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return lasting_manifest(folder / "out")["self_collision"];
    };
    // Six of the upper one's nine lie between two: each is a corner of triangles in two cells, which share some.
    const Json::Value unlike = contact_with({});
    ASSERT_EQ(unlike["beside_seams"].size(), 1u);
    EXPECT_EQ(unlike["beside_seams"][0]["cloth"].asString(), "upper");
    EXPECT_EQ(unlike["beside_seams"][0]["triangles"].asUInt(), 14u);
    EXPECT_EQ(unlike["beside_seams"][0]["closing"].asUInt(), 0u);
    EXPECT_TRUE(unlike["proved"].asBool());
    EXPECT_EQ(
        unlike["certificate"].asString(),
        "no crossing of covered triangles in any substep; not covered: 14 triangles beside seams of unlike sides");

    const Json::Value alike = contact_with({"/cloths/1/grid=[9,5]"});
    EXPECT_FALSE(alike.isMember("beside_seams"));
    EXPECT_EQ(alike["certificate"].asString(), "no crossing in any substep");

    const Json::Value closing = contact_with({"/cloths/1/grid=[9,5]", "/seams/0/close=0.5"});
    ASSERT_EQ(closing["beside_seams"].size(), 2u);
    EXPECT_EQ(closing["beside_seams"][1]["triangles"].asUInt(), 0u);
    EXPECT_EQ(closing["beside_seams"][1]["closing"].asUInt(), 16u);
    EXPECT_THAT(closing["certificate"].asString(),
                HasSubstr("; not covered: 32 triangles beside seams that close, the last at 0.5 s"));
}

TEST(Crossings, AreCountedByClothFromTheFirstFrameOn) {
    const std::vector<Manifest::Cut> cuts{
        {3, "a", 2, 0, 0, 1}, {4, "b", 9, 0, 5, 1}, {7, "a", 3, 3, 1, 1}, {8, "b", 9, 0, 6, 2}, {9, "a", 3, 0, 4, 1}};
    const auto split = split_triangles(cuts, 9);
    ASSERT_EQ(split.size(), 2u);
    EXPECT_EQ(split[0].cloth, "b");
    EXPECT_EQ(split[0].first_frame, 5);
    EXPECT_EQ(split[0].count, 11u);
    EXPECT_EQ(split[1].first_frame, 8);
    EXPECT_EQ(split[1].count, 1u) << "the cut of the last frame acts after it";
    EXPECT_EQ(triangles_text(split), "12 triangles");
    EXPECT_TRUE(split_triangles(cuts, 4).empty());
}

}  // namespace
}  // namespace drape
