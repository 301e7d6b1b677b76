// What the documents promise a reader who follows them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "output/temporary_folder.h"
#include "program.h"

namespace drape {
namespace {

using testing::IsEmpty;

const std::filesystem::path repository = DRAPE_SOURCE_DIR;

/// The fenced blocks of a document in one language.
std::vector<std::string> blocks(const std::string& document, const std::string& language) {
    std::vector<std::string> found;
    const std::string open = "\n```" + language + "\n", close = "\n```\n";
    for (std::size_t begin = document.find(open); begin != std::string::npos; begin = document.find(open, begin)) {
        begin += open.size();
        found.push_back(document.substr(begin, document.find(close, begin) - begin + 1));
    }
    return found;
}

TEST(FirstScene, EveryStepsSceneIsGoodAndRendersToItsEnd) {
    const TemporaryFolder folder;
    const std::vector<std::string> scenes = blocks(read_text(repository / "engine/docs/first_scene.md"), "json");
    ASSERT_EQ(scenes.size(), 3u);
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

}  // namespace
}  // namespace drape
