// `drape profile` and `drape compare` run as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/temporary_folder.h"
#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Profile, TellsStagesOrPassesAndWritesThreeFiles) {
    const SceneFolder folder(small_scene(4));
    const std::vector<std::string> common = {"profile", folder.scene(), "--validate", "-n", "4", "--warm-up", "1"};
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(),
                     {"--json", folder.out("p.json"), "--csv", folder.out("p.csv"), "--trace", folder.out("t.json")});
    const Outcome stages = drape(arguments);
    EXPECT_EQ(stages.code, 0) << stages.err;
    EXPECT_THAT(stages.out, AllOf(HasSubstr("\nsimulate "), HasSubstr("\nraster "), HasSubstr("memory: ")));
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"p.csv", "p.json", "scene.json", "t.json"}));
    arguments = common;
    arguments.insert(arguments.end(), {"--passes", "--simulate"});
    const Outcome passes = drape(arguments);
    EXPECT_EQ(passes.code, 0) << passes.err;
    EXPECT_THAT(passes.out,
                AllOf(HasSubstr("/force "), HasSubstr("of copy"), HasSubstr("GFLOP/s"), Not(HasSubstr("raster"))));
    const Outcome same = drape({"compare", folder.out("p.json"), folder.out("p.json")});
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_THAT(same.out, HasSubstr("within noise"));
}

TEST(Profile, ComparesOnlyProfiles) {
    const SceneFolder folder(small_scene(4));
    const Outcome outcome = drape({"compare", folder.scene(), folder.scene()});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("scene.json: no profile"));
    EXPECT_EQ(drape({"compare", folder.out("none.json"), folder.scene()}).code, 1);
    EXPECT_EQ(drape({"profile", folder.scene(), "-n", "0"}).code, 2);
    EXPECT_EQ(drape({"profile", folder.scene(), "--kernels", "fast"}).code, 2);
}

}  // namespace
}  // namespace drape
