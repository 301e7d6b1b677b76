// The exact checker judges runs on the device that say of themselves "no crossing in any substep". With
// DRAPE_CONTACT_FRAMES=2000 in the environment it judges as many random frames as the claim is about, and with
// DRAPE_CONTACT_SCENE=53 that scene alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "contact_scenes.h"
#include "drape/scene_reader.h"
#include "judged_run.h"
#include "library_device.h"

namespace drape::test {
namespace {

using testing::IsEmpty;

using ContactCertificateTest = LibraryTest;

constexpr std::uint64_t seed = 12;

JudgedRun judged_random_run(std::uint32_t index) {
    const SceneResult read = read_scene_text(random_contact_scene(seed, index), "random");
    if (!read.scene) throw std::runtime_error(read.errors[0].text());
    const JudgedRun run = judged_run(*read.scene, library_device());
    EXPECT_THAT(run.contradictions, IsEmpty()) << "contact_scene random " << seed << " " << index;
    return run;
}

TEST_F(ContactCertificateTest, IsNeverGivenWhereTrianglesCross) {
    if (const char* scene = std::getenv("DRAPE_CONTACT_SCENE")) {
        judged_random_run(static_cast<std::uint32_t>(std::strtoul(scene, nullptr, 10)));
        return;
    }
    const char* asked = std::getenv("DRAPE_CONTACT_FRAMES");
    const std::size_t wanted = asked ? std::strtoul(asked, nullptr, 10) : 200;
    std::size_t frames = 0, proved = 0, crossed = 0, met = 0, ended = 0, lost = 0, started_crossed = 0, came_apart = 0,
                wild = 0;
    std::uint32_t index = 0;
    for (; frames < wanted; ++index) {
        const JudgedRun run = judged_random_run(index);
        frames += run.frames;
        proved += run.proved_frames;
        crossed += run.crossed_frames;
        met += run.most_pairs > 0 ? 1 : 0;
        ended += run.ended.empty() ? 0 : 1;
        lost += run.proved_frames < run.frames ? 1 : 0;
        wild += run.implausible ? 1 : 0;
        started_crossed += run.crossed_at_start ? 1 : 0;
        came_apart += run.came_apart ? 1 : 0;
    }
    std::printf(
        "[ measured ] %zu frames of %u scenes: %zu proved, %zu crossed; of the scenes cloth met in %zu, the proof "
        "was lost in %zu, cloths started crossed in %zu and came apart in %zu, %zu were not plausible, %zu ended "
        "early\n",
        frames, index, proved, crossed, met, lost, started_crossed, came_apart, wild, ended);
    // Without scenes that meet, and proofs and crossings, the comparison would say nothing.
    EXPECT_GT(met, index / 2);
    EXPECT_GT(proved, frames / 2);
    EXPECT_GT(crossed, 0u);
    EXPECT_GT(lost, 0u);
}

void expect_proved(const std::string& scene_text, std::uint32_t frames) {
    const JudgedRun run = judged_run(parse_scene(scene_text), library_device());
    std::printf("[ measured ] %zu frames, %u pairs, %llu motions cut short %s\n", run.frames, run.most_pairs,
                static_cast<unsigned long long>(run.cut_short), run.ended.c_str());
    EXPECT_EQ(run.frames, frames);
    EXPECT_EQ(run.proved_frames, frames);
    EXPECT_EQ(run.crossed_frames, 0u);
    EXPECT_FALSE(run.implausible);
    EXPECT_GT(run.most_pairs, 300u) << "nothing met";
    const std::vector<std::string> without{"/cloths/0/self_collision=false", "/time/frames=150"};
    EXPECT_GT(judged_run(*read_scene_text(scene_text, "scene", without).scene, library_device()).crossed_frames, 0u)
        << "it would not have crossed anyway";
}

TEST_F(ContactCertificateTest, OfAStripThatIsTwistedEightTimes) { expect_proved(twisted_strip(4, 301, 16), 301); }

TEST_F(ContactCertificateTest, OfASheetThatIsCrumpled) { expect_proved(crumpled_sheet(17, 401, 16), 401); }

TEST_F(ContactCertificateTest, OfADiscThatIsCrumpled) {
    std::string disc = crumpled_sheet(17, 401, 16);
    const std::string grid = R"("grid": [17, 17])";
    ASSERT_NE(disc.find(grid), std::string::npos);
    disc.replace(disc.find(grid), grid.size(),
                 R"("outline": {"path": "M0 .5A.5.5 0 0 0 1 .5A.5.5 0 0 0 0 .5Z", "spacing": 0.0625})");
    expect_proved(disc, 401);
}

TEST_F(ContactCertificateTest, OfClothThatAColliderLeadsOut) {
    const JudgedRun run = judged_run(parse_scene(led_sheet()), library_device());
    EXPECT_THAT(run.contradictions, IsEmpty());
    EXPECT_EQ(run.crossed_frames, 0u);
    EXPECT_EQ(run.proved_frames, run.frames);
    EXPECT_GT(run.cut_short, 0u) << "nothing held the sheet back";
}

}  // namespace
}  // namespace drape::test
