// The table of bounds tells who reads a message what was found and what to do, and is what the document says.
#include "control/bounds.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

namespace drape {
namespace {

using testing::HasSubstr;

std::string what_happens(Beyond beyond) {
    switch (beyond) {
        case Beyond::again:
            return "`auto` does the frame again; the run ends with exit code 5 at one that is kept";
        case Beyond::no_result:
            return "the run ends with exit code 5";
        case Beyond::warning:
            return "the run warns";
        case Beyond::unsettled:
            return "the run warns when it ends";
    }
    std::abort();
}

std::string document() {
    std::string text =
        "# Which bounds is a result held against?\n\n"
        "Every frame that is simulated is held against these bounds, by any method, written or not. They follow from "
        "what the\nscene can do to its cloth, and are far above what it ever does. No beyond depends on which frames "
        "are written or where\nthe scene ends. The rows stand in `engine/control/bounds.cpp`, with the reasons of "
        "their constants; a test writes this page\nfrom them.\n\n## A frame\n\n"
        "| what is bounded | the bound | beyond it | what helps |\n|---|---|---|---|\n";
    std::set<std::string> listed;
    for (const ClothBound& row : cloth_bounds())
        if (listed.insert(row.words.name).second)
            text += fmt::format("| {} | {} | {} | {} |\n", row.words.name, row.words.why, what_happens(row.beyond),
                                row.words.remedy);
    text +=
        "\n## A collider that may have passed between particles\n\n"
        "Contact is sure up to these bounds. Where more substeps help, `auto` takes them; beyond the bound the run "
        "warns.\n\n| what is bounded | the bound | what helps |\n|---|---|---|\n";
    for (const PassageBound& row : passage_bounds())
        text += fmt::format("| {} | {} | {} |\n", row.words.name, row.words.why, row.words.remedy);
    text +=
        "\n## A scene that no substeps follow\n\nWhere `auto` refuses a scene, it says whether one of these is the "
        "reason.\n\n| what is bounded | the bound | what helps |\n|---|---|---|\n";
    for (const SceneBound& row : scene_bounds())
        text += fmt::format("| {} | {} | {} |\n", row.words.name, row.words.why, row.words.remedy);
    return text;
}

TEST(Bounds, TheDocumentIsWhatTheTableSays) {
    const char* path = DRAPE_SOURCE_DIR "/engine/docs/bounds.md";
    if (std::getenv("DRAPE_WRITE_BOUNDS")) std::ofstream(path) << document();
    std::ifstream file(path);
    const std::string committed{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(committed == document()) << "DRAPE_WRITE_BOUNDS=1 build/tests/control/test_control "
                                            "--gtest_filter='Bounds.*'";
}

TEST(Bounds, EveryRowTellsWhatWasFoundAndWhatToDo) {
    const Finding found{
        .value = 0.75, .bound = 0.25, .cloth = "sheet", .collider = "one", .other = "other", .count = 7};
    std::vector<Words> rows;
    for (const ClothBound& row : cloth_bounds()) rows.push_back(row.words);
    for (const PassageBound& row : passage_bounds()) rows.push_back(row.words);
    for (const SceneBound& row : scene_bounds()) rows.push_back(row.words);
    for (const Words& words : rows) {
        const std::string text = told(words, found);
        EXPECT_THAT(text, testing::AnyOf(HasSubstr("0.75"), HasSubstr("75 %"), HasSubstr("0.25"))) << words.name;
        EXPECT_THAT(text, testing::EndsWith(words.remedy));
        EXPECT_GT(std::string(words.remedy).size(), 10u) << words.name;
        EXPECT_GT(std::string(words.why).size(), 10u) << words.name;
    }
}

}  // namespace
}  // namespace drape
