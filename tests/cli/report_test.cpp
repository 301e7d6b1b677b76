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
                      HasSubstr("no crossing in any substep"), HasSubstr("class ClothMesh"),
                      HasSubstr("<tr><th>solver.substeps</th><td>4</td><td>8</td></tr>")));
    // No view in 3-D, and not what draws it.
    EXPECT_THAT(read_text(folder / "out/report.html"),
                AllOf(HasSubstr("--export npz"), Not(HasSubstr("class ClothMesh"))));
    EXPECT_EQ(run({"report", "out", "-o", "-"}).out, read_text(folder / "out/report.html"));
}

/// Decodes a page's arrays as space.h describes them and holds them against the archives: positions, strains, triangles
/// of the last frame and where colliders are; prints the arrays' shapes.
constexpr const char* space_reader = R"python(
import base64, json, sys, xml.etree.ElementTree as tree
import numpy
page, *archives = sys.argv[1:]
scripts = {script.get("id"): script.text for script in tree.parse(page).iter("script")}
space = json.loads(scripts["space0"])
def array(text, kind):
    return numpy.frombuffer(base64.b64decode(text, validate=True), kind)
def strains_of(x, scene):
    strains = numpy.zeros(x.shape[:3])
    for axis, size, count in ((2, scene["size"][0], scene["grid"][0]), (1, scene["size"][1], scene["grid"][1])):
        along = numpy.linalg.norm(numpy.diff(x, axis=axis), axis=-1) / (size / (count - 1)) - 1
        for end in (slice(0, -1), slice(1, None)):
            place = (slice(None),) * axis + (end,)
            strains[place] = numpy.maximum(strains[place], along)
    return strains
text = 0
for number, (cloth, path) in enumerate(zip(space["cloths"], archives, strict=True)):
    run = numpy.load(path)
    scene = json.loads(run["scene"].item())
    frames = [list(run["frames"]).index(frame) for frame in space["frames"]]
    rows, columns = ([*range(0, n - 1, cloth["stride"]), n - 1] for n in run["positions"].shape[1:3])
    places = numpy.ix_(frames, rows, columns)
    wanted, low, high = run["positions"][places], numpy.array(cloth["low"]), numpy.array(cloth["high"])
    positions = low + array(cloth["positions"], "<u2").reshape(wanted.shape) / 65535 * (high - low)
    assert (abs(positions - wanted) <= 0.501 * (high - low) / 65535 + 1e-7).all(), abs(positions - wanted).max()
    faces, last = {tuple(face) for face in run["faces"]}, run["faces"]
    cuts = [key for key in run.files if key.startswith("faces_")]
    if cuts:
        last = run[max(cuts)]
    else:
        strains = numpy.minimum(strains_of(run["positions"].astype(float), scene["cloths"][number])[places],
                                cloth["strain_range"])
        got = array(cloth["strain"], "u1").reshape(wanted.shape[:3]) / 255 * cloth["strain_range"]
        assert cloth["strain_range"] > 0 and abs(got - strains).max() <= 0.51 * cloth["strain_range"] / 255
    triangles = array(cloth["triangles"], "<u4").reshape(-1, 3)
    alive = numpy.unpackbits(array(cloth["changes"][-1]["alive"], "u1"), bitorder="little")[:len(triangles)]
    if cloth["stride"] == 1:
        assert {tuple(face) for face in triangles[alive == 1]} == {tuple(face) for face in last}
    assert triangles.max() < len(rows) * len(columns)
    text += len(cloth["positions"]) + len(cloth["strain"])
    print(cloth["name"], wanted.shape[:3], "of", run["positions"].shape[:3], len(triangles), "triangles,", alive.sum(), "left")
for collider in space["colliders"]:
    if collider["kind"] == "meshes":
        triangles = array(collider["triangles"], "<u4").reshape(-1, 3)
        low, high = numpy.array(collider["low"]), numpy.array(collider["high"])
        forms = low + array(collider["positions"], "<u2").reshape(-1, triangles.max() + 1, 3) / 65535 * (high - low)
        print(len(triangles), "triangles,", len(forms), "forms, one corner at",
              *(numpy.round(form.max(axis=0), 3).tolist() for form in forms[[0, -1]]))
    poses = array(collider["poses"], "<f4").reshape(-1, 12)
    print(collider["kind"], collider["size"], len(poses), "poses,", numpy.round(poses[-1, 9:], 3).tolist())
print(text, "bytes of text")
)python";

Outcome read_space_of(const std::string& page, std::vector<std::string> archives, const SceneFolder& folder) {
    archives.insert(archives.begin(), {"-c", space_reader, page});
    return Running("/usr/bin/python3", archives, {.folder = folder.path()}).wait();
}

constexpr const char* moving_box =
    R"(/colliders/boxes=[{"center": [3, 1, 0], "half_extents": [0.1, 0.2, 0.3], "path": [{"t": 0}, {"t": 0.1, "translate": [0, 0.5, 0]}]}])";

TEST(Report, HasThePositionsOfTheRunForItsViewInThreeDimensions) {
    const SceneFolder folder(small_scene(9));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set", moving_box}).code, 0);
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    const Outcome whole = read_space_of("out/report.html", {"out/positions.npz"}, folder);
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_THAT(whole.out, AllOf(HasSubstr("sheet (9, 6, 8) of (9, 6, 8) 70 triangles, 70 left"),
                                 HasSubstr("planes [0, 1, 0] 1 poses, [0.0, 0.0, 0.0]"),
                                 HasSubstr("boxes [0.1, 0.2, 0.3] 9 poses, [3.0, 1.5, 0.0]")));

    ASSERT_EQ(drape({"report", folder.out(), "--positions", "0.002"}).code, 0);
    const Outcome thinned = read_space_of("out/report.html", {"out/positions.npz"}, folder);
    EXPECT_EQ(thinned.code, 0) << thinned.err;
    EXPECT_THAT(thinned.out, HasSubstr("sheet (9, 4, 5) of (9, 6, 8) 24 triangles, 24 left"));
    EXPECT_THAT(thinned.out, HasSubstr("1680 bytes of text"));

    ASSERT_EQ(drape({"report", folder.out(), "--positions", "0"}).code, 0);
    EXPECT_THAT(read_text(folder / "out/report.html"), HasSubstr("Left out, as --positions 0 asks."));
}

TEST(Report, ShowsEveryFormOfAMeshThatDeforms) {
    const SceneFolder folder(small_scene(9));
    const std::string scenes = DRAPE_SOURCE_DIR "/tests/scene/";
    const std::string mesh = R"(/colliders/meshes=[{"file": ")" + scenes +
                             R"(box.obj", "position": [3, 1, 0], "frames": ")" + scenes +
                             R"(box_pose_#.obj", "frames_per_second": 60}])";
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set", mesh}).code, 0);
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    const Outcome whole = read_space_of("out/report.html", {"out/positions.npz"}, folder);
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_THAT(whole.out, HasSubstr("12 triangles, 9 forms, one corner at [0.3, 0.2, 0.5] [0.3, 0.4, 0.5]"));
    // The files are looked for beside the scene file, wherever the report is asked for.
    std::filesystem::create_directory(folder / "files");
    for (const char* name : {"box.obj", "box_pose_1.obj", "box_pose_2.obj"})
        std::filesystem::copy_file(scenes + name, folder / "files" / name);
    const std::string beside = R"(/colliders/meshes=[{"file": "files/box.obj", "position": [3, 1, 0]}])";
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--overwrite", "--set", beside}).code, 0);
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    EXPECT_THAT(read_space_of("out/report.html", {"out/positions.npz"}, folder).out,
                HasSubstr("12 triangles, 1 forms"));
    std::filesystem::remove_all(folder / "files");
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    EXPECT_THAT(read_text(folder / "out/report.html"), HasSubstr("the run's scene cannot be read here and now"));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--overwrite", "--set", mesh}).code, 0);
    // Half of so little has no room for 60 or all forms.
    ASSERT_EQ(drape({"report", folder.out(), "--positions", "0.001"}).code, 0);
    EXPECT_THAT(read_space_of("out/report.html", {"out/positions.npz"}, folder).out,
                HasSubstr("12 triangles, 1 forms, one corner at [0.3, 0.2, 0.5] [0.3, 0.2, 0.5]"));
}

TEST(Report, ShowsWhatACutLeavesOfTwoCloths) {
    const SceneFolder folder(small_scene(6));
    const std::string second =
        R"(/cloths/-={"name": "napkin", "grid": [4, 5], "size": [0.3, 0.4], "placement": {"origin": [2, 1.5, 0]}})";
    const std::string cutter =
        R"(/cutters=[{"triangle": [[-9, 1.2, -9], [9, 1.2, -9], [0, 1.2, 9]], "active": [0, 1], "path": [{"t": 0}, {"t": 1, "translate": [0, 0.1, 0]}]}])";
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set", second, "--set", cutter}).code, 0);
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    // The scene's order, which is not that of the names.
    const std::vector<std::string> archives{"out/positions_sheet.npz", "out/positions_napkin.npz"};
    const Outcome page = read_space_of("out/report.html", archives, folder);
    EXPECT_EQ(page.code, 0) << page.err;
    EXPECT_THAT(page.out, AllOf(HasSubstr("napkin (6, 5, 4) of"), HasSubstr("70 triangles, "),
                                Not(HasSubstr("70 triangles, 70 left"))));

    const std::string archive = read_text(folder / archives[1]);
    write_text(folder / archives[1], archive.substr(0, archive.size() / 2));
    const Outcome broken = drape({"report", folder.out()});
    EXPECT_EQ(broken.code, 1);
    EXPECT_THAT(broken.err, HasSubstr(archives[1]));
    std::filesystem::copy_file(folder / archives[0], folder / archives[1],
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_THAT(drape({"report", folder.out()}).err, HasSubstr("its positions are of another grid or of other frames"));
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Report, OfASweepShowsTheLastPictures) {
    const SceneFolder folder(small_scene(3));
    write_text(
        folder / "spec.json",
        R"({"scene": "scene.json", "count": 2, "seed": 1, "vary": {"/cloths/0/areal_density": {"grid": [0.1, 0.2]}}})");
    const auto run = [&](std::vector<std::string> arguments) { return drape(arguments, {.folder = folder.path()}); };
    ASSERT_EQ(run({"sweep", "spec.json", "-o", "out", "-q", "--pictures"}).code, 0);
    ASSERT_EQ(run({"report", "out"}).code, 0);
    const std::string page = read_text(folder / "out/report.html");
    EXPECT_THAT(page,
                AllOf(HasSubstr("<img alt=\"0000: frame_0002.png\""), HasSubstr("<img alt=\"0001: frame_0002.png\"")));
    EXPECT_EQ(occurrences(page, "<img "), 2);
}

TEST(Report, OfASweepHasALinePerRun) {
    const SceneFolder folder(small_scene(3));
    write_text(
        folder / "spec.json",
        R"({"scene": "scene.json", "count": 3, "seed": 1, "vary": {"/cloths/0/areal_density": {"grid": [0.1, 0.2, -1]}}})");
    const auto run = [&](std::vector<std::string> arguments) { return drape(arguments, {.folder = folder.path()}); };
    ASSERT_EQ(run({"sweep", "spec.json", "-o", "out", "-q", "--index", "0-1"}).code, 0);
    ASSERT_EQ(run({"report", "out/runs/0001"}).code, 0);
    ASSERT_EQ(run({"report", "out"}).code, 0);
    const std::string page = read_text(folder / "out/report.html");
    EXPECT_THAT(page, AllOf(HasSubstr("2 done, 0 failed, 1 missing, of 3 runs of scene.json"),
                            HasSubstr("<a href=\"runs/0000/\">0000</a>"),
                            HasSubstr("<a href=\"runs/0001/report.html\">0001</a>"),
                            HasSubstr("<th>/cloths/0/areal_density</th>"), HasSubstr("<td class=\"number\">0.2</td>"),
                            HasSubstr("<th>stretch_max_worst</th>"), Not(HasSubstr("Last pictures")),
                            HasSubstr("<title>stretch_max_worst by /cloths/0/areal_density</title>")));
    EXPECT_EQ(occurrences(page, "<title>runs</title>"), occurrences(page, " by /cloths/0/areal_density</title>"));
    const char* parse = "import sys, xml.etree.ElementTree as tree; tree.parse(sys.argv[1])";
    EXPECT_EQ(Running("/usr/bin/python3", {"-c", parse, "out/report.html"}, {.folder = folder.path()}).wait().code, 0);

    ASSERT_EQ(run({"sweep", "spec.json", "-o", "out", "-q", "--index", "2"}).code, 3);
    ASSERT_EQ(run({"report", "out"}).code, 0);
    EXPECT_THAT(read_text(folder / "out/report.html"),
                AllOf(HasSubstr("2 done, 1 failed, 0 missing"), HasSubstr("<td class=\"bad\">scene</td>"),
                      HasSubstr("areal_density: expected a number")));
    EXPECT_EQ(run({"report", "out", "out/runs/0001"}).code, 2);
    write_text(folder / "out/jobs/0001.json", "{\"seconds\": \"seven\"}");
    const Outcome broken = run({"report", "out"});
    EXPECT_EQ(broken.code, 1);
    EXPECT_THAT(broken.err, HasSubstr("jobs/0001.json'"));
}

TEST(Report, OfARunThatIsNotFinishedHasThePicturesSoFar) {
    const SceneFolder folder(small_scene(9));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q"}).code, 0);
    for (const char* name : {"manifest.json", "frame_0007.png", "frame_0008.png"})
        std::filesystem::remove(folder / "out" / name);
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    const std::string page = read_text(folder / "out/report.html");
    EXPECT_THAT(page, AllOf(HasSubstr("not finished"), HasSubstr("It has drawn 7 pictures, frames 0 to 6."),
                            HasSubstr("frame_0006.png"), HasSubstr("<title>kinetic</title>"),
                            HasSubstr(">frame</text>"), HasSubstr("Known when the run has ended.")));
}

TEST(Report, OfAFailedRunSaysSo) {
    const SceneFolder folder(small_scene(9));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q", "--export", "npz", "--on-failure", "keep",
                     "--set", "/solver/tolerance=1e-9"})
                  .code,
              8);
    ASSERT_EQ(drape({"report", folder.out()}).code, 0);
    EXPECT_THAT(read_text(folder / "out/report.html"), HasSubstr("<span class=\"bad\">tolerance missed</span>"));
    const Outcome space = read_space_of("out/report.html", {"out/positions.npz"}, folder);
    EXPECT_EQ(space.code, 0) << space.err;
}

TEST(Report, OfAFolderWithoutARunIsRefused) {
    const SceneFolder folder(small_scene(2));
    const auto report = [&](const std::string& name) { return drape({"report", name}, {.folder = folder.path()}); };
    EXPECT_EQ(report("absent").code, 1);
    EXPECT_THAT(report(".").err, HasSubstr("'.' has no manifest.json and no pictures: no run is there"));
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
