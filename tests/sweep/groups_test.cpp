// Runs of one shape find each other.
#include "sweep/groups.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/temporary_folder.h"

namespace drape::sweep {
namespace {

class Groups : public testing::Test, public TemporaryFolder {
  protected:
    Groups() {
        write_text(*this / "scene.json", R"({"gravity": [0, 0, 0], "cloths": [{"grid": [4, 4]}],
            "solver": {"method": "line", "substeps": 1}})");
    }
    GroupedRun run(std::uint32_t index, const std::string& value) const {
        GroupedRun run{index, {}};
        run.request.scene.path = (*this / "scene.json").string();
        run.request.scene.overrides = {value};
        run.request.formats = {"npz"};
        return run;
    }
    static std::vector<std::vector<std::uint32_t>> indices_of(std::vector<GroupedRun> runs,
                                                              DeviceKind device = DeviceKind::cpu) {
        std::vector<std::vector<std::uint32_t>> indices;
        for (const std::vector<GroupedRun>& group : groups_of(std::move(runs), device)) {
            indices.emplace_back();
            for (const GroupedRun& run : group) indices.back().push_back(run.index);
        }
        return indices;
    }
};

using Lists = std::vector<std::vector<std::uint32_t>>;

TEST_F(Groups, AreOfRunsThatAreNoNeighbours) {
    std::vector<GroupedRun> runs;
    for (const std::uint32_t index : {0, 1, 2, 3, 4, 5})
        runs.push_back(run(index, fmt::format("/cloths/0/grid=[4, {}]", 4 + index % 2)));
    EXPECT_EQ(indices_of(runs), (Lists{{0, 2, 4}, {1, 3, 5}}));
}

TEST_F(Groups, LeaveAloneWhatCannotShare) {
    EXPECT_EQ(indices_of({run(0, "/cloths/0/damping=-1"), run(1, "/cloths/0/damping=1"), run(2, "/cloths/0/tear={}"),
                          run(3, "/cloths/0/damping=2"), run(4, "/cloths/0/tear={}")}),
              (Lists{{0}, {1, 3}, {2}, {4}}));
}

/// On a CPU a dispatch costs little beside the work on a large cloth, and members by `auto` wait for each other.
TEST_F(Groups, OfMethodAutoAreOfSmallClothsOnACpu) {
    for (const auto& [grid, device, together] : {std::tuple{"[24, 24]", DeviceKind::cpu, true},
                                                 {"[24, 25]", DeviceKind::cpu, false},
                                                 {"[24, 25]", DeviceKind::gpu, true}}) {
        std::vector<GroupedRun> runs;
        for (const std::uint32_t index : {0, 1}) {
            runs.push_back(run(index, fmt::format("/cloths/0/grid={}", grid)));
            runs.back().request.scene.overrides.push_back(R"(/solver={"method": "auto"})");
        }
        EXPECT_EQ(indices_of(runs, device), (together ? Lists{{0, 1}} : Lists{{0}, {1}})) << grid;
    }
}

TEST_F(Groups, OfMethodAutoAreOfThoseForWhichItChoosesTheSame) {
    std::vector<GroupedRun> runs;
    for (const auto& [index, stretch] : {std::pair{0u, "1"}, {1u, "100000"}, {2u, "2"}, {3u, "200000"}}) {
        runs.push_back(run(index, R"(/solver={"method": "auto"})"));
        runs.back().request.scene.overrides.push_back(fmt::format("/cloths/0/stiffness/stretch={}", stretch));
    }
    EXPECT_EQ(indices_of(runs), (Lists{{0, 2}, {1, 3}}));
}

TEST_F(Groups, HaveAMostAndTheNextOfTheShapeBeginAnother) {
    std::vector<GroupedRun> runs;
    for (std::uint32_t index = 0; index < most_grouped + 2; ++index) runs.push_back(run(index, "/cloths/0/damping=1"));
    const Lists lists = indices_of(runs);
    ASSERT_EQ(lists.size(), 2u);
    EXPECT_EQ(lists[0].size(), most_grouped);
    EXPECT_THAT(lists[1], testing::ElementsAre(most_grouped, most_grouped + 1));
}

}  // namespace
}  // namespace drape::sweep
