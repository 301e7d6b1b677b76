// A replay of what a failed run leaves comes to the same failure again: frame, words, numbers, exit code.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// The cloth falls and hangs for a second, then its pins fly off with it.
std::string torn_scene(const std::string& solver) {
    return fmt::format(
        R"({{"time": {{"fps": 60, "frames": 120}}, "cloths": [{{"name": "sheet", "grid": [10, 9], "size": [0.5, 0.4],
  "placement": {{"origin": [0, 1, 0]}}, "areal_density": 0.2, "pins": [{{"corner": "top_left"}},
  {{"corner": "top_right", "path": [{{"t": 0.3}}, {{"t": 0.6, "translate": [3, 0, 0]}}]}}]}}], "solver": {{{}}}}})",
        solver);
}

/// Returns the failure as the run tells it, without the words on its files.
std::string failure_in(const std::string& text) {
    const std::size_t begin = text.rfind("drape: ");
    return begin == std::string::npos ? text : text.substr(begin, text.find_first_of(";\n", begin) - begin);
}

struct Failing {
    const char* name;
    std::string solver;
    std::vector<std::string> more;
    int code;
};
void PrintTo(const Failing& each, std::ostream* out) { *out << each.name; }
class Replays : public testing::TestWithParam<Failing> {};

TEST_P(Replays, ReachTheSameFailure) {
    const SceneFolder folder(torn_scene(GetParam().solver));
    std::vector<std::string> arguments{"simulate", folder.scene(), "-o", folder.out(), "-q"};
    arguments.insert(arguments.end(), GetParam().more.begin(), GetParam().more.end());
    const Outcome failed = drape(arguments);
    ASSERT_EQ(failed.code, GetParam().code) << failed.err;
    EXPECT_THAT(failed.err, HasSubstr("drape replay " + folder.out() + "/failure.reproducer"));
    const Json::Value manifest = lasting_manifest(folder.out());
    EXPECT_EQ(manifest["reproducer"], "failure.reproducer");
    EXPECT_GT(manifest["failed"]["frame"].asInt(), 5) << "nothing was before it";
    EXPECT_LT(fs::file_size(folder / "out/failure.reproducer"), std::uintmax_t{1} << 20);
    fs::remove(folder.scene());  // the reproducer holds the scene
    const Outcome replayed = drape({"replay", folder.out() + "/failure.reproducer"});
    EXPECT_EQ(replayed.code, GetParam().code) << replayed.err;
    EXPECT_THAT(replayed.err, HasSubstr("the same failure, to the bit:"));
    EXPECT_EQ(failure_in(replayed.err), failure_in(failed.err));
    const bool from_checkpoint = GetParam().more.back() == "0";
    EXPECT_EQ(replayed.err.find("replays from frame 0\n") == std::string::npos, from_checkpoint) << replayed.err;
}
INSTANTIATE_TEST_SUITE_P(
    Of, Replays,
    testing::Values(Failing{"SomeFramesFromTheStart", R"("method": "relax", "substeps": 4)", {"-j", "3"}, 5},
                    Failing{"AToleranceFromACheckpoint",
                            R"("method": "line", "substeps": 4, "tolerance": 0.05)",
                            {"--checkpoint", "0"},
                            8},
                    Failing{"WhatAutoCannotKeep",
                            R"("method": "auto")",
                            {"--set", "/cloths/0/stiffness=\"rigid\"", "--set",
                             "/cloths/0/pins/1/path/1/translate=[0.2, 0, 0]", "--checkpoint", "0"},
                            8},
                    Failing{"NonsenseFromACheckpoint", R"("method": "relax", "substeps": 1)", {"--checkpoint", "0"}, 5},
                    Failing{"NonsenseThatIsKept", R"("method": "relax", "substeps": 1)", {"--on-failure", "keep"}, 5}),
    [](const auto& each) { return std::string(each.param.name); });

class Reproducer : public testing::Test {
  protected:
    Reproducer() : folder_(torn_scene(R"("method": "relax", "substeps": 1)")) {
        EXPECT_EQ(drape({"simulate", folder_.scene(), "-o", folder_.out(), "-q", "--checkpoint", "0"}).code, 5);
        good_ = read_text(path());
    }
    fs::path path() const { return folder_ / "out/failure.reproducer"; }
    Outcome replay(const std::string& bytes) const {
        write_text(path(), bytes);
        return drape({"replay", path().string()});
    }
    SceneFolder folder_;
    std::string good_;
};

TEST_F(Reproducer, DamagedForeignOrMissingIsRefused) {
    for (const double place : {0.01, 0.5, 0.9999}) {
        std::string bad = good_;
        bad[static_cast<std::size_t>(place * static_cast<double>(bad.size()))] ^= 1;
        const Outcome outcome = replay(bad);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_THAT(outcome.err, AllOf(HasSubstr("failure.reproducer'"), HasSubstr("is damaged: its checksum")));
    }
    EXPECT_THAT(replay(good_.substr(0, good_.size() / 2)).err, HasSubstr("is damaged"));
    EXPECT_THAT(replay("no reproducer at all").err, HasSubstr("is no reproducer"));
    EXPECT_EQ(replay("").code, 1);
    fs::remove(path());
    const Outcome missing = drape({"replay", path().string()});
    EXPECT_EQ(missing.code, 1);
    EXPECT_THAT(missing.err, HasSubstr("No such file"));
}

TEST_F(Reproducer, IsReplacedByTheNextRun) {
    ASSERT_EQ(drape({"simulate", folder_.scene(), "-o", folder_.out(), "-q", "--overwrite", "-e", "3"}).code, 0);
    EXPECT_FALSE(fs::exists(path()));
}

}  // namespace
}  // namespace drape
