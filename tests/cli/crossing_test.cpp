// Where cloths may have passed through each other, the run says so wherever a user may look, and from which frame on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
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

TEST(Crossings, OfAClothThatStartsThroughItselfLeaveNothingProved) {
    const SceneFolder folder(R"({"name": "crushed", "time": {"frames": 3}, "solver": {"method": "line", "substeps": 4},
"cloths": [{"name": "sheet", "grid": [9, 9], "self_collision": true, "placement": {"jitter": 0.2}}]})");
    const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--on-failure", "keep"});
    EXPECT_THAT(outcome.err, HasSubstr("cloth \"sheet\" starts through itself"));
    const Json::Value manifest = lasting_manifest(folder / "out"), &contact = manifest["self_collision"];
    EXPECT_FALSE(contact["proved"].asBool());
    EXPECT_EQ(contact["certificate"].asString(), "not proved from frame 0 on: a cloth started through itself");
    EXPECT_EQ(drape({"check", folder.scene(), "--set", "/overlap=\"refuse\""}).code, 3);
}

}  // namespace
}  // namespace drape
