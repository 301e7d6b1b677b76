// Bad scenes end with every error and its place on stderr and the documented exit code; no file is touched, no memory
// taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <sstream>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct BadScene {
    const char* name;
    std::string text;
    std::vector<std::string> messages;  ///< lines of stderr, after the file's name
};

std::string cloth(const std::string& members) { return "{\"cloths\": [{\n" + members + "}]}"; }

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, AreRefusedAndNothingIsTouched) {
    const SceneFolder folder(GetParam().text);
    const auto before = everything_below(folder.path());
    std::string expected;
    for (const std::string& message : GetParam().messages) expected += "scene.json:" + message + "\n";
    for (const char* command : {"render", "simulate", "graph", "check"}) {
        std::vector<std::string> arguments{command, "scene.json"};
        if (std::string_view("render simulate").find(command) != std::string_view::npos)
            arguments.insert(arguments.end(), {"-o", "out/deep"});
        const Outcome outcome = drape(arguments, {.folder = folder.path()});
        EXPECT_EQ(outcome.code, 3) << command;
        EXPECT_EQ(outcome.err, expected) << command;
        EXPECT_THAT(outcome.out, IsEmpty()) << command;
        EXPECT_LT(outcome.peak_memory_kib, 200 << 10) << command;
        EXPECT_EQ(everything_below(folder.path()), before) << command;
    }
}

std::string many_bad_pins(int count) {
    std::string pins;
    for (int k = 0; k < count; ++k) pins += std::string(k > 0 ? "," : "") + "{\"edge\": \"up\"}";
    return cloth("\"pins\": [" + pins + "]");
}

TEST(SceneErrorText, TellsTheFirstHundredErrorsAndCountsTheRest) {
    const SceneFolder folder(many_bad_pins(100000));
    const Outcome outcome = drape({"check", "scene.json"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("/cloths/0/pins/0/edge: "));
    EXPECT_THAT(outcome.err, HasSubstr("/cloths/0/pins/99/edge: "));
    EXPECT_THAT(outcome.err, testing::Not(HasSubstr("/cloths/0/pins/100/edge: ")));
    EXPECT_THAT(outcome.err, testing::EndsWith("scene.json: and 99900 more\n"));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 101);
}

TEST(SceneErrorText, LetsNoControlCharacterReachTheTerminal) {
    const SceneFolder folder(
        "{\"cloths\": [{\"name\": \"a\"}, {\"name\": \"\\u001b[2Ja\", \"grid\": 1}], \"\\u0007\": 1}");
    const Outcome outcome = drape({"check", "scene.json"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 3);
    for (const char c : outcome.err) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("\\x07"));
}

const BadScene bad_scenes[] = {
    {"Malformed", "{\"cloths\": [{}],\n 7: 1}", {"2:2: Missing '}' or object member name"}},
    {"TrailingComma", "{\"cloths\": [{}]\n,}", {"2:1: expected no comma after the last member"}},
    {"UnknownKey",
     "{\"cloths\": [{}],\n \"gravty\": [0, 0, 0]}",
     {"2:2: /gravty: expected \"gravity\", got the unknown key \"gravty\""}},
    {"WrongType",
     "{\"cloths\": [{}],\n \"gravity\": \"down\"}",
     {"2:13: /gravity: expected an array of 3 numbers, got \"down\""}},
    {"NotANumber", cloth("\"areal_density\": NaN"), {"2:18: Syntax error: value, object or array expected"}},
    {"NegativeMass",
     cloth("\"areal_density\": -0.2"),
     {"2:18: /cloths/0/areal_density: expected a number > 0 (single precision), got -0.2"}},
    {"ZeroGrid", cloth("\"grid\": [0, 8]"), {"2:10: /cloths/0/grid/0: expected an integer from 2 to 16384, got 0"}},
    {"BillionParticles",
     cloth("\"grid\": [40000, 25000]"),
     {"2:9: /cloths/0/grid: expected at most 16000000 particles in all cloths together, got 1000000000",
      "2:10: /cloths/0/grid/0: expected an integer from 2 to 16384, got 40000",
      "2:17: /cloths/0/grid/1: expected an integer from 2 to 16384, got 25000"}},
    {"SeveralErrors",
     cloth("\"size\": [1, 0],\n\"friction\": -1,\n\"colour\": 3"),
     {"2:13: /cloths/0/size/1: expected a number > 0 (single precision), got 0",
      "3:13: /cloths/0/friction: expected a number >= 0 (single precision), got -1",
      "4:1: /cloths/0/colour: expected \"appearance\" ({\"front\": [r, g, b], ...}), got the unknown key \"colour\""}},
};
INSTANTIATE_TEST_SUITE_P(All, BadScenes, testing::ValuesIn(bad_scenes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SceneErrors, AMissingFileIsAFileError) {
    const SceneFolder folder(small_scene(2));
    const auto before = everything_below(folder.path());
    for (const char* path : {"absent.json", "scene.json/below", "."}) {
        const Outcome outcome = drape({"render", path, "-o", "out"}, {.folder = folder.path()});
        EXPECT_EQ(outcome.code, 1) << path;
        EXPECT_THAT(outcome.err, HasSubstr(std::string(path) + ": cannot read: ")) << path;
    }
    EXPECT_EQ(everything_below(folder.path()), before);
}

TEST(SceneErrors, AnOverrideIsCheckedLikeTheFile) {
    const SceneFolder folder(small_scene(2));
    const auto refusal = [&](const std::string& value) {
        const Outcome outcome = drape({"render", "scene.json", "-o", "out", "--set", value}, {.folder = folder.path()});
        EXPECT_EQ(outcome.code, 3) << value;
        return outcome.err;
    };
    EXPECT_EQ(refusal("/cloths/0/areal_density=-1"),
              "--set '/cloths/0/areal_density=-1': /cloths/0/areal_density: expected a number > 0 (single "
              "precision), got -1\n");
    EXPECT_THAT(refusal("/cloths/3/damping=1"),
                HasSubstr("expected an index into the 1 elements of /cloths, or - for a new one, got \"3\""));
    EXPECT_THAT(refusal("/gravity=NaN"), HasSubstr("/gravity: expected an array of 3 numbers, got \"NaN\""));
    EXPECT_THAT(refusal("/solver/substep=3"), HasSubstr("expected \"substeps\", got the unknown key \"substep\""));
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
}

TEST(Check, ReportsEveryFile) {
    const SceneFolder folder(small_scene(2));
    write_text(folder / "bad.json", "{\"cloths\": []}");
    const Outcome outcome = drape({"check", "scene.json", "bad.json"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.out, "scene.json: ok\n");
    EXPECT_THAT(outcome.err, HasSubstr("bad.json:1:12: /cloths: expected an array"));
    // A missing file weighs more than a wrong one.
    EXPECT_EQ(drape({"check", "absent.json", "bad.json"}, {.folder = folder.path()}).code, 1);
    const Outcome quiet = drape({"check", "-q", "scene.json"}, {.folder = folder.path()});
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Check, SpeaksJson) {
    const SceneFolder folder(small_scene(2));
    write_text(folder / "bad.json", "{\"cloths\": [],\n\"time\": 1}");
    const Outcome outcome = drape({"check", "--json", "scene.json", "bad.json"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, IsEmpty());
    std::istringstream stream(outcome.out);
    Json::Value report;
    std::string errors;
    ASSERT_TRUE(Json::parseFromStream(Json::CharReaderBuilder(), stream, &report, &errors)) << errors;
    ASSERT_EQ(report.size(), 2u);
    EXPECT_TRUE(report[0]["ok"].asBool());
    EXPECT_FALSE(report[1]["ok"].asBool());
    ASSERT_EQ(report[1]["errors"].size(), 2u);
    EXPECT_EQ(report[1]["errors"][1]["line"], 2);
    EXPECT_EQ(report[1]["errors"][1]["column"], 9);
    EXPECT_EQ(report[1]["errors"][1]["pointer"], "/time");
}

TEST(Check, TakesAFolderForTheScenesInIt) {
    const SceneFolder folder(small_scene(4));
    write_text(folder / "bad.json", "{}");
    write_text(folder / "notes.txt", "no scene");
    std::filesystem::create_directory(folder / "empty");
    const Outcome outcome = drape({"check", "."}, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.out, "./scene.json: ok\n");
    EXPECT_THAT(outcome.err, testing::StartsWith("./bad.json:1:1: "));
    const Outcome empty = drape({"check", "scene.json", "empty"}, {.folder = folder.path()});
    EXPECT_EQ(empty.code, 2);
    EXPECT_THAT(empty.err, HasSubstr("no .json file in empty"));
    EXPECT_THAT(empty.out, IsEmpty());
}

}  // namespace
}  // namespace drape
