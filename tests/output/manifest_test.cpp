#include "output/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <sstream>
#include <utility>

#include "output/json_text.h"
#include "temporary_folder.h"

namespace drape {
namespace {

using testing::HasSubstr;

using Rows = std::vector<Manifest::FrameStatistics>;

std::function<void(const Manifest::FrameVisitor&)> listed(Rows rows) {
    return [rows = std::move(rows)](const Manifest::FrameVisitor& take) { std::ranges::for_each(rows, take); };
}

std::string manifest_json(const Manifest& manifest) {
    std::string text;
    put_manifest(manifest, [&](std::string_view piece) { text += piece; });
    return text;
}

Manifest example() {
    Manifest manifest;
    manifest.program_version = "0.1.0";
    manifest.program_commit = "89ab-modified";
    manifest.scene = {"scenes/flag.json", "flag \"red\"\n", "0123456789abcdef0123456789abcdef", {"/gravity/1=-1.62"}};
    manifest.device = {"llvmpipe (LLVM 15.0.6, 256 bits)", "llvmpipe", "Mesa 22.3.6", "1.3.230", "6d657361"};
    manifest.frames = {0, 239, 2, 120, 60};
    manifest.run_key = "00112233445566778899aabbccddeeff";
    manifest.picture = Manifest::Picture{1280, 720, 4};
    manifest.solver = {"line", "buffer_store", 20, 8, true, "auto", "the laws expect it", 0.01, 0.0075};
    manifest.validation = {true, 0};
    manifest.skipped = {{"collision", "the scene has no collider"}};
    manifest.warnings = {"the scene ends at frame 239: --end 300 is clamped"};
    manifest.compromises = {{"flag/stiffness", "80 of 100 N/m", 23}, {"flag/bending", "none", 0}};
    manifest.files = {{"frame_0000.png", 12345678901, "00ff"}, {"frame_0002.png", 1, "11ff"}};
    manifest.statistics = listed({{0, {{"kinetic_energy", 0.0}, {"max_stretch", 1.0625}}},
                                  {2, {{"kinetic_energy", 1e-300}, {"max_stretch", 0.1}}}});
    manifest.created = "2024-05-31T12:00:00Z";
    manifest.command_line = {"drape", "render", "scenes/flag.json"};
    manifest.frame_time = Manifest::FrameTime{33.5, 30, 120.25};
    manifest.stage_median_ms = {{"raster", 12.5}};
    return manifest;
}

constexpr const char* golden = R"json({
  "compromises": [
    {"enough_substeps": 23, "reason": "80 of 100 N/m", "what": "flag/stiffness"},
    {"reason": "none", "what": "flag/bending"}
  ],
  "device": {
    "api_version": "1.3.230",
    "driver": "llvmpipe",
    "driver_version": "Mesa 22.3.6",
    "name": "llvmpipe (LLVM 15.0.6, 256 bits)",
    "uuid": "6d657361"
  },
  "files": [
    {"bytes": 12345678901, "hash": "00ff", "name": "frame_0000.png"},
    {"bytes": 1, "hash": "11ff", "name": "frame_0002.png"}
  ],
  "format": "drape manifest 1",
  "frames": {"count": 120, "end": 239, "fps": 60, "start": 0, "step": 2},
  "picture": {"height": 720, "samples": 4, "width": 1280},
  "program_commit": "89ab-modified",
  "program_version": "0.1.0",
  "run": {
    "command_line": ["drape", "render", "scenes/flag.json"],
    "created": "2024-05-31T12:00:00Z",
    "frame_ms": {"max": 120.25, "median": 33.5, "min": 30},
    "stage_median_ms": {"raster": 12.5}
  },
  "run_key": "00112233445566778899aabbccddeeff",
  "scene": {
    "hash": "0123456789abcdef0123456789abcdef",
    "name": "flag \"red\"\n",
    "overrides": ["/gravity/1=-1.62"],
    "path": "scenes/flag.json"
  },
  "skipped": [{"reason": "the scene has no collider", "what": "collision"}],
  "solver": {
    "asked": "auto",
    "choice": "the laws expect it",
    "iterations": 8,
    "kernels": "buffer_store",
    "method": "line",
    "stretch_error_rms": 0.0075,
    "substeps": 20,
    "tethers": true,
    "tolerance": 0.01
  },
  "statistics": [
    {"frame": 0, "kinetic_energy": 0, "max_stretch": 1.0625},
    {"frame": 2, "kinetic_energy": 1e-300, "max_stretch": 0.1}
  ],
  "status": "done",
  "validation": {"enabled": true, "messages": 0},
  "warnings": ["the scene ends at frame 239: --end 300 is clamped"]
}
)json";

Json::Value parse(const std::string& text) {
    std::istringstream stream(text);
    Json::Value value;
    std::string errors;
    if (!Json::parseFromStream(Json::CharReaderBuilder(), stream, &value, &errors)) throw std::runtime_error(errors);
    return value;
}

TEST(Manifest, Golden) {
    EXPECT_EQ(manifest_json(example()), golden);
    EXPECT_EQ(parse(golden)["scene"]["name"].asString(), "flag \"red\"\n");
}

TEST(Manifest, WithoutFramesTheStatisticsAreAnEmptyArray) {
    Manifest manifest = example();
    for (const auto& none : {listed({}), decltype(manifest.statistics)()}) {
        manifest.statistics = none;
        const Json::Value json = parse(manifest_json(manifest));
        EXPECT_TRUE(json["statistics"].isArray());
        EXPECT_EQ(json["statistics"].size(), 0u);
        EXPECT_EQ(json["run_key"], "00112233445566778899aabbccddeeff");
    }
}

// Words of a program's text must not be taken for the place of the statistics.
TEST(Manifest, TextThatLooksLikeTheStatisticsIsText) {
    Manifest manifest = example();
    const std::string mark = "\n  \"statistics\": [";
    manifest.failure = manifest.scene.name = mark;
    manifest.command_line = {mark};
    const Json::Value json = parse(manifest_json(manifest));
    EXPECT_EQ(json["failure"].asString(), mark);
    EXPECT_EQ(json["statistics"].size(), 2u);
}

TEST(Manifest, TimesAndCommandLineTouchOnlyTheRunKey) {
    Manifest other = example();
    other.created = "2031-01-01T00:00:00Z";
    other.command_line.push_back("--overwrite");
    other.frame_time.reset();
    other.stage_median_ms = {{"spring", 1}};
    Json::Value first = parse(manifest_json(example())), second = parse(manifest_json(other));
    EXPECT_NE(first, second);
    first.removeMember("run");
    second.removeMember("run");
    EXPECT_EQ(first, second);
    EXPECT_GT(first.size(), 9u);
}

TEST(Manifest, RefusesNumbersThatAreNone) {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Manifest manifest = example();
        manifest.statistics = listed({{2, {{"max_stretch", value}}}});
        EXPECT_THAT(error_text<OutputError>([&] { manifest_json(manifest); }),
                    HasSubstr("statistic 'max_stretch' of frame 2 is not a finite number"));
        manifest = example();
        manifest.stage_median_ms["raster"] = value;
        EXPECT_THAT(error_text<OutputError>([&] { manifest_json(manifest); }), HasSubstr("stage 'raster'"));
        manifest = example();
        manifest.frames.fps = value;
        EXPECT_THROW(manifest_json(manifest), OutputError);
    }
    Manifest manifest = example();
    manifest.statistics = listed({{0, {{"frame", 3}}}});
    EXPECT_THROW(manifest_json(manifest), OutputError);
}

TEST(Manifest, DoublesReadBackExactlyAndAreShort) {
    std::mt19937_64 random(11);
    Json::Value numbers(Json::arrayValue);
    for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 123456789.0})
        numbers.append(value);
    while (numbers.size() < 2000) {
        const std::uint64_t bits = random();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        if (std::isfinite(value)) numbers.append(value);
    }
    const std::string text = json_text(numbers);
    EXPECT_THAT(text, testing::StartsWith("[\n  0.1,\n  0.3333333333333333,\n  5e-324,"));
    const Json::Value back = parse(text);
    ASSERT_EQ(back.size(), numbers.size());
    for (Json::ArrayIndex i = 0; i < numbers.size(); ++i) EXPECT_EQ(back[i].asDouble(), numbers[i].asDouble());
}

TEST(Manifest, AnyTextIsEscaped) {
    Manifest manifest = example();
    manifest.command_line = {"a\\b", "\x01", "tab\t", "\xc3\xa9t\xc3\xa9", "</script>"};
    const Json::Value json = parse(manifest_json(manifest));
    for (Json::ArrayIndex i = 0; i < 5; ++i) {
        EXPECT_EQ(json["run"]["command_line"][i].asString(), manifest.command_line[i]);
    }
    manifest.command_line = {"\xff\xfe"};  // not UTF-8; the file must stay readable
    EXPECT_TRUE(parse(manifest_json(manifest))["run"]["command_line"][0].isString());
}

TEST(Manifest, SummarizesFrameTimes) {
    EXPECT_FALSE(summarize_frame_times({}));
    const auto odd = summarize_frame_times(std::vector<double>{5, 1, 3});
    EXPECT_EQ(odd->median, 3);
    EXPECT_EQ(odd->minimum, 1);
    EXPECT_EQ(odd->maximum, 5);
    EXPECT_EQ(summarize_frame_times(std::vector<double>{4, 1, 2, 9})->median, 3);
}

TEST(Manifest, TimestampIsUtc) {
    EXPECT_EQ(utc_timestamp(std::chrono::system_clock::from_time_t(1717156800)), "2024-05-31T12:00:00Z");
}

TEST(Manifest, WrittenFileLetsTheNextRunOverwrite) {
    const TemporaryFolder temporary;
    {
        OutputFolder folder(temporary / "out");
        write_manifest(folder, example());
        EXPECT_EQ(read_text(temporary / "out/manifest.json"), golden);
    }
    OutputFolder folder(temporary / "out", ExistingFiles::overwrite);
    EXPECT_THAT(folder.files_to_remove(), testing::ElementsAre("manifest.json"));
}

TEST(Manifest, AnUnwritableNumberLeavesNoFile) {
    const TemporaryFolder temporary;
    OutputFolder folder(temporary.path());
    Manifest manifest = example();
    manifest.statistics = listed({{0, {{"x", 1}}}, {1, {{"x", std::numeric_limits<double>::infinity()}}}});
    EXPECT_THROW(write_manifest(folder, manifest), OutputError);
    EXPECT_TRUE(names_in(temporary.path()).empty());
}

}  // namespace
}  // namespace drape
