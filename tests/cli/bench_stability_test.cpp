// `drape bench stability` runs as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "output/temporary_folder.h"
#include "program.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(BenchStability, JudgesExtremesAndGoesOnWhereItEnded) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments = {
        "bench", "stability",    "--short", "--validate",      "--filter", "^single/(base|start point|mass 0)/",
        "-o",    folder / "out", "--json",  folder / "s.json", "--csv",    folder / "s.csv",
        "--svg", folder / "maps"};
    const Outcome first = drape(arguments);
    EXPECT_EQ(first.code, 0) << first.err;
    // Cloth that starts on a point finds its way out, too, by every method.
    EXPECT_THAT(first.out, AllOf(HasSubstr("base                    A     holds       holds       holds       holds"),
                                 HasSubstr("start point             B     holds       holds       holds       holds"),
                                 HasSubstr("mass 0                  C     refuses     refuses     refuses     refuses"),
                                 HasSubstr("silent garbage: 0"), Not(HasSubstr("short of"))));
    EXPECT_THAT(first.err, AllOf(HasSubstr("12 cases run, 0 kept"), Not(HasSubstr("VUID"))));
    EXPECT_THAT(read_text(folder / "s.json"), HasSubstr("/cloths/0/placement/scale=[0,0]"));
    EXPECT_THAT(read_text(folder / "s.csv"), HasSubstr("\nsingle/start point/line,B,holds,"));
    EXPECT_EQ(names_in(folder / "maps").size(), 4u);
    const Outcome second = drape(arguments);
    EXPECT_THAT(second.err, HasSubstr("0 cases run, 12 kept"));
    EXPECT_EQ(second.out, first.out);
}

TEST(BenchStability, RefusesWhatItCannotDo) {
    const TemporaryFolder folder;
    const auto refused = [&](std::vector<std::string> options, int code, const char* message) {
        options.insert(options.begin(), {"bench", "stability", "-o", folder / "b"});
        const Outcome outcome = drape(options);
        EXPECT_EQ(outcome.code, code) << message;
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_THAT(outcome.out, IsEmpty()) << message;
    };
    refused({"--filter", "no such case"}, 2, "matches no case");
    refused({"--mixes", "-1"}, 2, "--mixes: expected a whole number from 0");
    refused({"--short", "--filter", "single/base/relax", "--device", "no such device"}, 4, "no such device");
}

}  // namespace
}  // namespace drape
