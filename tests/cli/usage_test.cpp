// The command line gives help, and refuses wrong usage with exit code 2.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "output/frame_writer.h"
#include "program.h"
#include "run/exit_code.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Help, IsDataAndNamesDefaultsUnitsExamplesAndExitCodes) {
    const Outcome general = drape({"--help"});
    EXPECT_EQ(general.code, 0);
    EXPECT_THAT(general.err, IsEmpty());
    const std::string document = read_text(DRAPE_SOURCE_DIR "/engine/docs/command_line.md");
    for (const char* command : {"new", "render", "simulate", "graph", "check", "schema", "devices", "bench", "verify",
                                "report", "sweep", "help", "completions", "man"}) {
        EXPECT_THAT(general.out, HasSubstr(std::string("\n  ") + command + " "));
        EXPECT_THAT(document, HasSubstr(std::string("`drape ") + command));
        const Outcome help = drape({command, "--help"});
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_THAT(help.err, IsEmpty()) << command;
        EXPECT_THAT(help.out, AllOf(HasSubstr(std::string("Usage: drape ") + command), HasSubstr("Example"),
                                    HasSubstr("Exit codes: 0 ok, 1 file")))
            << command;
    }
    EXPECT_THAT(drape({"render", "-h"}).out,
                AllOf(HasSubstr("--resume"), HasSubstr("default: 0, the initial state"), HasSubstr("in pixels")));
    EXPECT_THAT(drape({"simulate", "-h"}).out,
                AllOf(HasSubstr("float32 [frame,"), HasSubstr("  obj "), Not(HasSubstr(" png  "))));
}

TEST(Help, ExplainsEveryExitCode) {
    const std::string general = drape({"--help"}).out, of_a_command = drape({"check", "--help"}).out;
    for (const ExitCodeRow& row : exit_code_rows) {
        EXPECT_THAT(general, HasSubstr(row.meaning));
        EXPECT_THAT(of_a_command, HasSubstr(fmt::format("{} {}", static_cast<int>(row.code), row.name)));
    }
    EXPECT_THAT(read_text(DRAPE_SOURCE_DIR "/engine/docs/command_line.md"), HasSubstr(exit_code_table()));
}

/// Returns the subcommands that a help text lists.
std::vector<std::string> subcommands(const std::string& help) {
    std::vector<std::string> names;
    const std::size_t begin = help.find("\nSubcommands:\n");
    std::istringstream lines(begin == std::string::npos ? "" : help.substr(begin + 1));
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line) && !line.empty();)
        if (line.size() > 2 && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
    return names;
}

TEST(Help, FitsATerminalOf80Columns) {
    std::vector<std::vector<std::string>> commands{{}};
    for (std::size_t i = 0; i < commands.size(); ++i) {  // grows by the members of groups
        std::vector<std::string> asked = commands[i];
        asked.push_back("--help");
        const std::string help = drape(asked).out;
        std::istringstream lines(help);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(line.size(), 80u) << testing::PrintToString(asked) << ": " << line;
        for (const std::string& name : subcommands(help)) {
            commands.push_back(commands[i]);
            commands.back().push_back(name);
        }
    }
    EXPECT_GE(commands.size(), 20u);
}

/// A text with its words parted by one space each, wherever its lines end.
std::string in_one_line(const std::string& text) {
    std::istringstream words(text);
    std::string line;
    for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
    return line;
}

TEST(Help, FormatsAreThoseOfTheTable) {
    const std::string render = drape({"render", "--help"}).out;
    const std::string document = in_one_line(read_text(DRAPE_SOURCE_DIR "/engine/docs/export_formats.md"));
    for (const OutputFormat* format : output_formats()) {
        EXPECT_THAT(document,
                    HasSubstr(fmt::format(" - **`{}`**, `{}`: {}", format->name, format->files, format->holds)));
        if (!exported(*format, true)) continue;
        EXPECT_THAT(render, HasSubstr(fmt::format("{:6}", format->name)));
    }
}

TEST(Help, VersionIsData) {
    const Outcome outcome = drape({"--version"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out,
                testing::MatchesRegex("drape [0-9]+\\.[0-9]+\\.[0-9]+ \\(commit [0-9a-f]+(-modified)?\\)\n"));
}

struct WrongUsage {
    const char* name;
    std::vector<std::string> arguments;  ///< SCENE and OUT stand for the paths
    const char* message;
};

class Usage : public testing::TestWithParam<WrongUsage> {};

TEST_P(Usage, IsRefusedAndNothingIsTouched) {
    const SceneFolder folder(small_scene(4));
    std::vector<std::string> arguments = GetParam().arguments;
    for (std::string& argument : arguments) {
        if (argument == "SCENE") argument = folder.scene();
        if (argument == "OUT") argument = folder.out();
    }
    const auto before = everything_below(folder.path());
    const Outcome outcome = drape(arguments, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
    EXPECT_THAT(outcome.err, StartsWith("drape"));
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_EQ(everything_below(folder.path()), before);
}

const WrongUsage wrong_usages[] = {
    {"NoCommand",
     {},
     "no command given: expected one of new, pattern, render, simulate, camera, graph, check, schema, devices"},
    {"UnknownCommand", {"rendr", "SCENE"}, "unknown command 'rendr': did you mean 'render'?"},
    {"NoScene", {"render", "-o", "OUT"}, "drape render: SCENE is required"},
    {"NoOutput", {"render", "SCENE"}, "--output is required"},
    {"OutputWithoutFolder", {"render", "SCENE", "-o"}, "--output: 1 required DIR missing"},
    {"UnknownOption", {"render", "SCENE", "-o", "OUT", "--fast"}, "not expected: --fast"},
    {"SuperfluousArgument", {"render", "SCENE", "more", "-o", "OUT"}, "not expected: more"},
    {"Size", {"render", "SCENE", "-o", "OUT", "--size", "640"}, "--size: expected WIDTHxHEIGHT in pixels"},
    {"ZeroSize", {"render", "SCENE", "-o", "OUT", "--size", "0x48"}, "1 to 16384 each, got '0x48'"},
    {"HugeSize", {"render", "SCENE", "-o", "OUT", "--size", "16385x48"}, "got '16385x48'"},
    {"SignedSize", {"render", "SCENE", "-o", "OUT", "--size", "+64x+48"}, "got '+64x+48'"},
    {"SizeAndMore", {"render", "SCENE", "-o", "OUT", "--size", "64x48x2"}, "got '64x48x2'"},
    {"Samples", {"render", "SCENE", "-o", "OUT", "--samples", "2"}, "--samples: expected 1 or 4, got '2'"},
    {"View",
     {"render", "SCENE", "-o", "OUT", "--view", "heat"},
     "--view: expected shaded or stretch or warp or weft or wire or normals, got 'heat'"},
    {"ViewRange",
     {"render", "SCENE", "-o", "OUT", "--view", "warp", "--view-range", "0"},
     "--view-range: expected a strain in percent, above 0 and at most 1000, got '0'"},
    {"ViewRangeOfNoHeatMap",
     {"render", "SCENE", "-o", "OUT", "--view-range", "5"},
     "--view-range is for --view stretch, warp or weft"},
    {"SimulateHasNoView", {"simulate", "SCENE", "-o", "OUT", "--view", "wire"}, "not expected: "},
    {"SimulateHasNoSize", {"simulate", "SCENE", "-o", "OUT", "--size", "64x48"}, "not expected: "},
    {"NegativeStart",
     {"render", "SCENE", "-o", "OUT", "-s", "-1"},
     "--start: expected a whole number from 0 to 4294967295, got '-1'"},
    {"HugeEnd", {"render", "SCENE", "-o", "OUT", "-e", "4294967296"}, "--end: expected a whole number"},
    {"FractionalStart", {"render", "SCENE", "-o", "OUT", "-s", "1.5"}, "--start: expected a whole number"},
    {"ZeroStep", {"render", "SCENE", "-o", "OUT", "-j", "0"}, "--step: expected a whole number from 1"},
    {"StartAfterEnd",
     {"render", "SCENE", "-o", "OUT", "-s", "3", "-e", "2"},
     "no frame to write: --start 3 is after the last frame 2"},
    {"StartAfterTheScene", {"render", "SCENE", "-o", "OUT", "-s", "4"}, "--start 4 is after the last frame 3"},
    {"SetWithoutPointer", {"render", "SCENE", "-o", "OUT", "--set", "a=1"}, "--set: expected /json/pointer=value"},
    {"SetWithoutValue", {"check", "SCENE", "--set", "/time/fps"}, "expected /json/pointer=value, got '/time/fps'"},
    {"SetWithNothing", {"render", "SCENE", "-o", "OUT", "--set"}, "--set: 1 required /POINTER=VALUE missing"},
    {"OverwriteAndResume", {"render", "SCENE", "-o", "OUT", "--overwrite", "--resume"}, "excludes"},
    {"QuietAndVerbose", {"render", "SCENE", "-o", "OUT", "-q", "-v"}, "excludes"},
    {"Export",
     {"simulate", "SCENE", "-o", "OUT", "--export", "npy,fbx"},
     "expected npy, npz, pc2, obj, ply, usda, vtu, mgn, depth, normal, id, strain, depth16, normal16, id16, "
     "strain16, got 'fbx'"},
    {"ExportOfAnotherCommand", {"simulate", "SCENE", "-o", "OUT", "--export", "y4m"}, "id16, strain16, got 'y4m'"},
    {"StreamOfNoVideo", {"render", "SCENE", "-o", "-", "--export", "npy"}, "--export takes one of y4m, rgb"},
    {"StreamOfTwo", {"render", "SCENE", "-o", "-", "--export", "y4m,rgb"}, "--export takes one of y4m, rgb"},
    {"StreamOfArrays", {"simulate", "SCENE", "-o", "-"}, "only `drape render` writes to stdout"},
    {"ResumedStream", {"render", "SCENE", "-o", "-", "--resume"}, "a stream cannot be overwritten or resumed"},
    {"VerifyLimit", {"verify", "SCENE", "--stretch", "-1"}, "--stretch: expected a number, not negative, got '-1'"},
    {"Format", {"graph", "SCENE", "--format", "svg"}, "--format: expected text or json or dot, got 'svg'"},
};
INSTANTIATE_TEST_SUITE_P(Wrong, Usage, testing::ValuesIn(wrong_usages),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace drape
