// The table of bounds tells who reads a message what was found and what to do, and is what the document says.
#include "control/bounds.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "support/sheets.h"
#include "twin/statistics.h"
#include "twin/twin.h"

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
        "Every frame that is simulated is held against these bounds, by any method, written or not. They follow from\n"
        "what the scene can do to its cloth, and are far above what it ever does. No verdict depends on which frames\n"
        "are written or where the scene ends. `engine/control/bounds.cpp` has the rows, with the reasons of their\n"
        "constants; a test writes this page from them.\n\n## A frame\n\n"
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

/// Returns the worst stretch error of a spring that hangs still over a D^2 N^2/(h K).
double share_of_lambda(std::uint32_t edges, std::uint32_t substeps, std::uint32_t iterations, bool by_a_corner) {
    SceneDescription scene = test::sheet(edges + 1, edges + 1, 1, 1, substeps, iterations);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.rigid = true;
    cloth.pins = {by_a_corner ? test::pin_box(0, 0, 0, 0) : test::pin_top(cloth)};
    cloth.damping = 6;  // it settles in time
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 120; ++frame) twin.run_frame(frame);
    const auto record = twin_statistics(model, 0, twin.cloth(0), frame_inputs(model, 120));
    const double step = 1 / (scene.time.fps * substeps), count = edges;
    const double lambda = 9.81 * step * step * count * count * count / iterations;
    return cloth_statistics(model, model.cloths[0], record).stretch_error_max / lambda;
}

TEST(Bounds, TheLawOfStretchIsThatOfSheetsThatHang) {
    for (const std::uint32_t edges : {4u, 8u, 16u})
        for (const std::uint32_t substeps : {2u, 16u})
            for (const std::uint32_t iterations : {1u, 4u}) {
                const double edge = share_of_lambda(edges, substeps, iterations, false);
                const double corner = share_of_lambda(edges, substeps, iterations, true);
                std::printf("[ measured ] %u edges, %u substeps x %u: %.3f Lambda by an edge, %.3f by a corner\n",
                            edges, substeps, iterations, edge, corner);
                EXPECT_LT(edge, 0.14);
                EXPECT_GT(corner, 0.36);
                EXPECT_LT(corner, 0.5);
            }
}

}  // namespace
}  // namespace drape
