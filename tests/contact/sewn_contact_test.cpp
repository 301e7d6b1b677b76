// The exact checker judges runs of sewn cloths on the device that say of themselves "no crossing in any substep".
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "judged_run.h"
#include "library_device.h"
#include "support/sewn_scenes.h"

namespace drape::test {
namespace {

using testing::IsEmpty;

using SewnContactTest = LibraryTest;

/// Judges a run, and one without contact, which has to cross.
void expect_proved(SceneDescription scene, std::uint32_t frames) {
    scene.time.frame_count = frames;
    const JudgedRun run = judged_run(scene, library_device());
    for (Cloth& cloth : scene.cloths) cloth.self_collision.reset();
    const JudgedRun without = judged_run(scene, library_device());
    std::printf("[ measured ] %zu frames, %zu proved, %u pairs, %llu motions cut short; without contact %zu cross %s\n",
                run.frames, run.proved_frames, run.most_pairs, static_cast<unsigned long long>(run.cut_short),
                without.crossed_frames, run.ended.c_str());
    EXPECT_THAT(run.contradictions, IsEmpty());
    EXPECT_EQ(run.frames, frames);
    EXPECT_EQ(run.proved_frames, frames);
    EXPECT_EQ(run.crossed_frames, 0u);
    EXPECT_FALSE(run.implausible);
    EXPECT_GT(run.most_pairs, 300u) << "nothing met";
    EXPECT_GT(without.crossed_frames, 0u) << "it would not have crossed anyway";
}

TEST_F(SewnContactTest, OfATubeThatFallsOver) { expect_proved(falling_tube(SolverMethod::line, 16), 181); }
TEST_F(SewnContactTest, OfATubeByExplicitSteps) { expect_proved(falling_tube(SolverMethod::explicit_steps, 64), 121); }
TEST_F(SewnContactTest, OfACushionThatIsDropped) { expect_proved(dropped_cushion(SolverMethod::line, 17, 16), 121); }
TEST_F(SewnContactTest, OfPanelsThatFold) { expect_proved(folding_panels(SolverMethod::line, false, 16), 121); }

// Here nothing is said of some triangles: of unlike sides, and of seams that close.
TEST_F(SewnContactTest, OfUnlikePanelsThatClose) { expect_proved(folding_panels(SolverMethod::line, true, 16), 121); }

}  // namespace
}  // namespace drape::test
