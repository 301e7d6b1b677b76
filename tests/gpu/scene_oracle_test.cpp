// Every shipped scene meets the oracles that its file names, and every one of them notices when the program is broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "drape/scene_reader.h"
#include "gpu_test.h"
#include "run/scene_oracles.h"
#include "scene/oracle_kinds.h"
#include "scene_breaks.h"
#include "scene_files.h"

namespace drape {
namespace {

class SceneOracleTest : public testing::TestWithParam<std::string> {};

/// The unbroken run meets the oracle as far as the broken one goes; the broken one does not.
void expect_noticed(const verify::SceneRun& unbroken, const verify::SceneRun& broken, const Oracle& oracle,
                    const test::SceneBreak& damage) {
    const verify::Verdict whole = verify::judge(unbroken.until(broken.last_frame()), oracle);
    EXPECT_TRUE(whole.met) << "unbroken until frame " << broken.last_frame() << ": " << whole.text;
    const verify::Verdict verdict = verify::judge(broken, oracle);
    std::printf("[ broken   ] %s: %s\n", damage.what.c_str(), verdict.text.c_str());
    EXPECT_FALSE(verdict.met) << "does not notice: " << damage.what << ": " << verdict.text;
}

TEST_P(SceneOracleTest, IsMetAndNoticesABreak) {
    const SceneDescription scene = test::shipped_scene(GetParam());
    const std::uint32_t last = scene.time.frame_count - 1;
    ASSERT_FALSE(scene.oracles.empty());
    const verify::SceneRun run = verify::run_frames(test::gpu().device, scene, SimulationModel(scene), {.last = last});
    ASSERT_EQ(run.frames.size(), scene.time.frame_count);
    std::map<std::string, verify::SceneRun> broken_runs;  // two oracles may share a broken run
    for (const Oracle& oracle : scene.oracles) {
        const verify::Verdict verdict = verify::judge(run, oracle);
        std::printf("[ measured ] %s: %s\n", oracle.check.c_str(), verdict.text.c_str());
        EXPECT_TRUE(verdict.met) << oracle.check << ": " << verdict.text;
        for (const test::SceneBreak& damage : test::scene_breaks()) {
            if (!damage.concerns(GetParam(), oracle.check)) continue;
            const std::string key = damage.what + std::to_string(damage.last);
            if (!broken_runs.contains(key)) {
                const SimulationModel model = damage.model_of(scene);
                broken_runs.emplace(
                    key, verify::run_frames(test::gpu().device, scene, model, {.last = std::min(damage.last, last)}));
            }
            expect_noticed(run, broken_runs.at(key), oracle, damage);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryScene, SceneOracleTest, testing::ValuesIn(test::shipped_scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(SceneBreakTest, EveryOracleOfEverySceneHasABreakAndEveryBreakAnOracle) {
    std::vector<bool> used(test::scene_breaks().size());
    for (const std::string& name : test::shipped_scene_names())
        for (const Oracle& oracle : test::shipped_scene(name).oracles) {
            bool breakable = false;
            for (std::size_t i = 0; i < used.size(); ++i) {
                if (!test::scene_breaks()[i].concerns(name, oracle.check)) continue;
                breakable = used[i] = true;
            }
            EXPECT_TRUE(breakable) << name << ": " << oracle.check;
        }
    for (std::size_t i = 0; i < used.size(); ++i)
        EXPECT_TRUE(used[i] || test::scene_breaks()[i].scene.empty())
            << test::scene_breaks()[i].scene << ": " << test::scene_breaks()[i].check;
}

TEST(SceneOracleNameTest, EveryCheckThatAFileMayNameIsJudged) {
    std::vector<std::string_view> judged, named;
    for (const std::span<const verify::SceneCheck> checks : {verify::shape_checks(), verify::motion_checks()})
        for (const verify::SceneCheck& check : checks) judged.push_back(check.name);
    for (const OracleKind& kind : oracle_kinds()) named.push_back(kind.name);
    std::ranges::sort(judged);
    std::ranges::sort(named);
    EXPECT_EQ(judged, named);
    const verify::SceneRun run{test::shipped_scene("hanging_sheet"), {}, {}};
    EXPECT_THROW(verify::judge(run, {"looks_nice", {}}), std::invalid_argument);
}

/// An upright cloth stands beside a lying one, and through it in the frame `crossed` alone; in frame 1 a cutter has
/// split all of the upright one.
verify::SceneRun cut_in_frame_1(std::size_t crossed) {
    SceneDescription scene;
    scene.cloths = {Cloth{.name = "lying", .grid = {2, 2}}, Cloth{.name = "upright", .grid = {2, 2}}};
    verify::SceneRun run{scene, {}, {}};
    for (std::size_t frame = 0; frame < 3; ++frame) {
        const float x = frame == crossed ? 0.3f : 2.0f;
        run.frames.push_back({{{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 1}, {1, 0, 1, 1}},
                              {{x, -1, 0.2f, 1}, {x, -1, 0.7f, 1}, {x, 1, 0.2f, 1}, {x, 1, 0.7f, 1}}});
    }
    const std::vector<std::uint32_t> whole{0, 1, 2, 1, 3, 2};
    run.cuts = {{0, 0, 0, 1, 0, 1, whole}, {0, 1, 0, 1, 0, 1, whole}, {1, 1, 4, 4, 0, 1, {}}};
    return run;
}

TEST(SceneOracleUncrossedTest, CountsTrianglesToTheEndOfTheFrameThatSplitsThem) {
    EXPECT_FALSE(verify::judge(cut_in_frame_1(0), {"uncrossed", {}}).met);
    EXPECT_FALSE(verify::judge(cut_in_frame_1(1), {"uncrossed", {}}).met);
    const verify::Verdict after = verify::judge(cut_in_frame_1(2), {"uncrossed", {}});
    EXPECT_TRUE(after.met) << after.text;
    EXPECT_TRUE(after.text.ends_with("; 2 that were split do not count")) << after.text;
}

}  // namespace
}  // namespace drape
