// The report's page needs no other file, is well-formed, and says what the manifest says.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <set>

#include "output/json_file.h"
#include "output/json_text.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Parses the page as XML, decodes its pictures, compares its texts with the manifests; prints what it counted.
constexpr const char* reader = R"python(
import base64, json, sys, xml.etree.ElementTree as tree
page, folders = tree.parse(sys.argv[1]), sys.argv[2:]
text = " ".join(page.getroot().itertext())
pictures = [image.get("src") for image in page.iter("img") if image.get("src")]
for picture in pictures:
    assert picture.startswith("data:image/png;base64,"), picture[:40]
    assert base64.b64decode(picture[22:], validate=True)[:8] == b"\x89PNG\r\n\x1a\n"
for folder in folders:
    manifest = json.load(open(folder + "/manifest.json"))
    for value in (manifest["status"], manifest["run_key"], manifest["scene"]["hash"], manifest["device"]["name"],
                  manifest["solver"]["method"], str(manifest["frames"]["count"]), manifest["run"]["created"],
                  "%.3f" % manifest["run"]["frame_ms"]["median"], *manifest["run"]["stage_median_ms"],
                  *manifest["warnings"], manifest.get("self_collision", {}).get("certificate", "")):
        assert value in text, value
for element in page.iter():
    for name in ("src", "href"):
        assert not element.get(name, "data:").startswith(("http", "//", "file")), element.get(name)
curves = [title.text for title in page.iter("{http://www.w3.org/2000/svg}title")]
print(len(pictures), "pictures;", "; ".join(curves))
)python";

Outcome read_page(const std::string& page, std::vector<std::string> folders, const SceneFolder& folder) {
    folders.insert(folders.begin(), {"-c", reader, page});
    return Running("/usr/bin/python3", folders, {.folder = folder.path()}).wait();
}

TEST(Report, OfARunAndOfTwoSideBySide) {
    const SceneFolder folder(small_scene(9));
    const auto run = [&](std::vector<std::string> arguments) { return drape(arguments, {.folder = folder.path()}); };
    ASSERT_EQ(run({"render", "scene.json", "-o", "out", "-q"}).code, 0);
    ASSERT_EQ(run({"simulate", "scene.json", "-o", "calm<&>", "-q", "--set", "/solver/substeps=8", "-e", "99", "--set",
                   "/cloths/0/self_collision=true"})
                  .code,
              0);
    const Outcome made = run({"report", "out"});
    EXPECT_EQ(made.code, 0) << made.err;
    const Outcome page = read_page("out/report.html", {"out"}, folder);
    EXPECT_EQ(page.code, 0) << page.err;
    EXPECT_THAT(page.out, AllOf(HasSubstr("9 pictures; Stretch; largest; RMS; error, RMS; Energy; kinetic;"),
                                HasSubstr("Penetration; deepest")));

    EXPECT_EQ(run({"report", "out", "calm<&>", "-o", "both.html", "--frames", "4", "--width", "32"}).code, 0);
    const Outcome both = read_page("both.html", {"out", "calm<&>"}, folder);
    EXPECT_EQ(both.code, 0) << both.err;
    EXPECT_THAT(both.out, AllOf(HasSubstr("4 pictures; "), HasSubstr("A kinetic; "), HasSubstr("B kinetic; ")));
    EXPECT_THAT(read_text(folder / "both.html"),
                AllOf(HasSubstr("This run drew no pictures."), HasSubstr("--end 99 is clamped"),
                      HasSubstr("no crossing in any substep"),
                      HasSubstr("<tr><th>solver.substeps</th><td>4</td><td>8</td></tr>")));
    EXPECT_EQ(run({"report", "out", "-o", "-"}).out, read_text(folder / "out/report.html"));
}

TEST(Report, OfNoFinishedRunIsRefused) {
    const SceneFolder folder(small_scene(2));
    const auto report = [&](const std::string& name) { return drape({"report", name}, {.folder = folder.path()}); };
    EXPECT_EQ(report("absent").code, 1);
    EXPECT_THAT(report(".").err, HasSubstr("'.' has no manifest.json: no finished run is there"));
    std::filesystem::create_directory(folder / "other");
    write_text(folder / "other/manifest.json", "{\"name\": \"web app\"}");
    EXPECT_THAT(report("other").err, HasSubstr("is no manifest of this program"));
    EXPECT_THAT(names_in(folder / "other"), testing::ElementsAre("manifest.json"));
}

/// Pointers of everything in a value, parents first.
void collect(const Json::Value& value, const std::string& at, std::vector<std::string>& pointers) {
    if (!at.empty()) pointers.push_back(at);
    for (auto child = value.begin(); child != value.end(); ++child)
        collect(*child, at + (value.isArray() ? fmt::format("[{}]", child.index()) : "." + child.name()), pointers);
}

TEST(Report, AManifestOfWrongTypesIsRefusedByNameAndPlace) {
    const SceneFolder folder(small_scene(1));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    const Json::Value good = read_json(folder / "out/manifest.json", {});
    std::vector<std::string> pointers;
    collect(good, "", pointers);
    std::set<std::string> refused;
    for (const std::string& pointer : pointers) {
        Json::Value wrong = good;
        Json::Value& place = Json::Path(pointer).make(wrong);
        place = place.isString() ? Json::Value(Json::arrayValue) : Json::Value(place.isNumeric() ? "seven" : "\x1b");
        write_text(folder / "out/manifest.json", json_text(wrong));
        const Outcome outcome = drape({"report", folder.out(), "-o", "-"});
        if (outcome.code == 0) continue;
        EXPECT_EQ(outcome.code, 1) << pointer << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("manifest.json'")) << pointer;
        refused.insert(pointer);
    }
    for (const char* pointer :
         {".format", ".scene.name", ".run.command_line", ".run.command_line[0]", ".files[0]", ".files[0].name",
          ".statistics", ".statistics[0].frame", ".frames.fps", ".solver", ".validation.messages"})
        EXPECT_TRUE(refused.contains(pointer)) << pointer;
    for (const char* text : {"[1, 2]", "7", "null", "{", "{\"format\": 3}"}) {
        write_text(folder / "out/manifest.json", text);
        const Outcome outcome = drape({"report", folder.out(), "-o", "-"});
        EXPECT_EQ(outcome.code, 1) << text;
        EXPECT_THAT(outcome.err, HasSubstr("manifest.json'")) << text;
    }
}

TEST(Report, APictureThatCannotBeReadIsNamed) {
    const SceneFolder folder(small_scene(2));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    write_text(folder / "out/frame_0001.png", read_text(folder / "out/frame_0001.png").substr(0, 400));
    const Outcome outcome = drape({"report", folder.out()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("out/frame_0001.png': PNG: "));
}

}  // namespace
}  // namespace drape
