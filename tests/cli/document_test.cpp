// The documents keep their promises to a reader who follows them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "output/temporary_folder.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::IsEmpty;

const std::filesystem::path repository = DRAPE_SOURCE_DIR;

/// Returns the fenced blocks of a document in one language.
std::vector<std::string> blocks(const std::string& document, const std::string& language) {
    std::vector<std::string> found;
    const std::string open = "\n```" + language + "\n", close = "\n```\n";
    for (std::size_t begin = document.find(open); begin != std::string::npos; begin = document.find(open, begin)) {
        begin += open.size();
        found.push_back(document.substr(begin, document.find(close, begin) - begin + 1));
    }
    return found;
}

TEST(FirstScene, EveryDocumentsSceneIsGoodAndRendersToItsEnd) {
    const TemporaryFolder folder;
    std::vector<std::string> scenes = blocks(read_text(repository / "README.md"), "json");
    ASSERT_EQ(scenes.size(), 1u);
    for (const std::string& scene : blocks(read_text(repository / "engine/docs/first_scene.md"), "json"))
        scenes.push_back(scene);
    ASSERT_EQ(scenes.size(), 5u);
    for (const std::string& scene : scenes) {
        SCOPED_TRACE(scene);
        write_text(folder / "my.json", scene);
        const Outcome check = drape({"check", folder / "my.json"});
        EXPECT_EQ(check.code, 0);
        EXPECT_THAT(check.err, IsEmpty());
        const Outcome render = drape({"render", folder / "my.json", "-o", folder / "out", "--overwrite", "-q", "-j",
                                      "60", "--size", "64x36", "--samples", "1"});
        EXPECT_EQ(render.code, 0) << render.err;
        EXPECT_TRUE(std::filesystem::exists(folder / "out/manifest.json"));
    }
}

TEST(EngineReadme, BeginsWithTheSmallestProgramme) {
    const std::vector<std::string> programmes = blocks(read_text(repository / "engine/README.md"), "cpp");
    ASSERT_EQ(programmes.size(), 1u);
    EXPECT_EQ(programmes[0], read_text(repository / "tests/documents/smallest.cpp"));
}

/// Collects the names of all members, without the cloth that a statistic belongs to.
void collect_names(const Json::Value& value, std::set<std::string>& names) {
    if (value.isObject()) {
        for (const std::string& name : value.getMemberNames()) {
            names.insert(name.substr(name.rfind('/') + 1));
            if (name != "stage_median_ms") collect_names(value[name], names);
        }
    } else if (value.isArray()) {
        for (const Json::Value& element : value) collect_names(element, names);
    }
}

TEST(Manifest, EveryKeyIsDocumented) {
    const SceneFolder folder(small_scene(4));
    const std::string cutter =
        R"(/cutters=[{"triangle": [[-9, 1.2, -9], [9, 1.2, -9], [0, 1.2, 9]], "active": [0, 1], "path": [{"t": 0}, {"t": 1, "translate": [0, 0.1, 0]}]}])";
    const std::vector<std::vector<std::string>> runs = {
        {"render", "--set", cutter},
        {"render", "--view", "stretch", "--set", "/cloths/0/self_collision=true"},
        {"simulate", "--set", "/solver/method=auto", "-e", "9"},
        {"simulate", "--set", "/solver/tolerance=1e-9"}};
    std::set<std::string> names;
    for (std::vector<std::string> run : runs) {
        run.insert(run.end(), {folder.scene(), "-o", folder.out(std::to_string(names.size())), "-q"});
        const Outcome outcome = drape(run);
        EXPECT_TRUE(outcome.code == 0 || outcome.code == 8) << outcome.err;
        Json::Value manifest;
        std::istringstream(read_text(std::filesystem::path(run.end()[-2]) / "manifest.json")) >> manifest;
        collect_names(manifest, names);
    }
    for (const char* expected : {"triangles", "proved", "choice", "strain_range", "bound", "penetration_m"})
        EXPECT_TRUE(names.contains(expected)) << expected;
    const std::string document = read_text(repository / "engine/docs/manifest.md");
    for (const std::string& name : names) EXPECT_THAT(document, testing::HasSubstr("`" + name + "`"));
}

}  // namespace
}  // namespace drape
