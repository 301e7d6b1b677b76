// Cloth that meets itself is run for long: fold and twist until they have settled or are wound up.
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/self_contact_scenes.h"
#include "twin/statistics.h"

namespace drape {
namespace {

struct Seen {
    std::uint32_t first_crossed = 0, first_unproved = 0;  ///< frames; 0: none
};

/// Runs to the first crossing, or to the end.
Seen run(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    Seen seen;
    for (std::uint32_t frame = 1; frame <= frames && seen.first_crossed == 0; ++frame) {
        twin.run_frame(frame);
        if (test::crossings(model, twin) > 0) seen.first_crossed = frame;
        if (seen.first_unproved == 0 && twin.contact().record.unproved > 0) seen.first_unproved = frame;
    }
    return seen;
}

void expect_never_crossed(const SceneDescription& scene, std::uint32_t frames) {
    const Seen seen = run(scene, frames);
    EXPECT_EQ(seen.first_crossed, 0u);
    EXPECT_EQ(seen.first_unproved, 0u);
}

/// Everyday numbers run until the cloth has settled, DRAPE_FULL_CONTACT=1 in the environment finer sheets for longer.
std::uint32_t everyday(std::uint32_t number, std::uint32_t in_full) {
    return std::getenv("DRAPE_FULL_CONTACT") ? in_full : number;
}

TEST(SelfContactLongTest, Fold) {
    expect_never_crossed(test::fold(everyday(21, 33), 0.5, SolverMethod::line, 24), everyday(150, 300));
}
TEST(SelfContactLongTest, ThinFold) {
    expect_never_crossed(test::fold(everyday(17, 25), 0.1, SolverMethod::explicit_steps, 80), everyday(120, 150));
}
TEST(SelfContactLongTest, Twist) {
    expect_never_crossed(test::twist(everyday(17, 25), 0.4, SolverMethod::line, 40, 1.5, 2), everyday(150, 240));
}
TEST(SelfContactLongTest, Stack) {
    expect_never_crossed(test::stack(everyday(5, 8), everyday(10, 12), SolverMethod::line, 24), everyday(120, 150));
}

/// Sheets that fall onto a pile must not carry the lowest ones into the ball. A motion cut short once kept the mean of
/// all, and a pile of 50 sheets of 32 x 32 went 13 cm into the ball.
TEST(SelfContactLongTest, StackStaysOutsideTheBall) {
    const SimulationModel model(test::stack(12, 8, SolverMethod::line, 8));
    Twin twin(model);
    double deepest = 0;
    for (std::uint32_t frame = 1; frame <= 25; ++frame) {
        twin.run_frame(frame);
        const FrameInputs inputs = frame_inputs(model, frame);
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
            const glsl::StatisticsRecord record = twin_statistics(model, cloth, twin.cloth(cloth), inputs);
            deepest = std::max(deepest, cloth_statistics(model, model.cloths[cloth], record).penetration.value());
        }
    }
    EXPECT_LT(deepest, 1e-4);
    const glsl::vec4 middle = twin.cloth(0)[Field::position][8 * 4 + 4];
    EXPECT_GT(middle.y, 0.3f) << "the first sheet does not lie on the ball";
}

/// The bars cannot be stopped, and a rope that is wound tight cannot let them through.
TEST(SelfContactLongTest, WhatIsWoundTooFarIsNotCertified) {
    const Seen seen = run(test::twist(everyday(17, 25), 0.4, SolverMethod::line, 40, 8, 4), 240);
    EXPECT_GT(seen.first_crossed, 0u);
    EXPECT_GT(seen.first_unproved, 0u);
    EXPECT_LE(seen.first_unproved, seen.first_crossed);
}

}  // namespace
}  // namespace drape
