// The control of a closed loop makes pure decisions from judgements.
#include "control/substep_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cloth/companions.h"

namespace drape {
namespace {

using Verdict = SubstepControl::Verdict;

SubstepControl control(std::uint32_t proposed) { return {row_of(SolverMethod::line), proposed, {1, 1}, 6}; }

/// Frames of a cloth whose errors fall with the square of the substeps and are 1 at `stretch` and `motion` substeps.
struct ConvergingCloth {
    double stretch, motion;
    Judgement judge(const Segment& segment) const {
        const double n = segment.substeps;
        return {std::pow(stretch / n, 2), segment.probes ? std::pow(motion / n, 2) : 0, std::pow(2 * stretch / n, 2)};
    }
};

struct Spent {
    std::uint32_t frames = 0, attempts = 0, last = 0;
    double work = 0;  // substeps
};

Spent run(SubstepControl& loop, const ConvergingCloth& cloth, std::uint32_t frames) {
    Spent run;
    while (run.frames < frames) {
        loop.begin(6, false);
        for (Verdict verdict = Verdict::again; verdict == Verdict::again;) {
            const Segment segment = loop.segment();
            ++run.attempts;
            run.work += segment.frame_count * segment.substeps * (segment.probes ? 1.5 : 1.0);
            verdict = loop.judge(cloth.judge(segment));
            run.last = segment.substeps;
        }
        run.frames += loop.segment().frame_count;
    }
    return run;
}

TEST(SubstepControl, RungsAreEvenSoThatAProbeCanHalveThem) {
    for (const Method& method : methods()) {
        EXPECT_EQ(substep_rungs(method).back(), method.most_substeps) << method.name();
        for (const std::uint32_t rung : substep_rungs(method)) EXPECT_EQ(rung % 2, 0u);
    }
}

TEST(SubstepControl, GoesUpUntilAllLimitsAreKept) {
    SubstepControl loop = control(2);
    EXPECT_TRUE(loop.begin(6, false).probes);
    EXPECT_GE(run(loop, {20, 3}, 1).last, 20u);
    SubstepControl other = control(2);
    EXPECT_GE(run(other, {3, 50}, 1).last, 50u);
}

TEST(SubstepControl, GoesDownWhereItIsEasyAndStaysNearTheLimit) {
    SubstepControl loop = control(256);
    const Spent calm = run(loop, {4, 9}, 600);
    EXPECT_GE(calm.last, 9u);
    EXPECT_LE(calm.last, 16u);
}

TEST(SubstepControl, GoesDownAtOnceWhereItIsVeryEasy) {
    SubstepControl loop = control(768);
    const Spent calm = run(loop, {4, 9}, 60);
    EXPECT_GE(calm.last, 9u);
    EXPECT_LE(calm.last, 16u);
}

TEST(SubstepControl, JudgingAndRedoingCostLittleOnceTheSubstepsFit) {
    SubstepControl loop = control(24);
    run(loop, {10, 16}, 400);
    const Spent settled = run(loop, {10, 16}, 2000);
    EXPECT_LT(settled.work, 1.08 * settled.frames * settled.last);
}

TEST(SubstepControl, GivesUpOnlyAtTheTop) {
    SubstepControl loop = control(8);
    loop.begin(6, false);
    Verdict verdict = Verdict::again;
    while (verdict == Verdict::again) verdict = loop.judge({.stretch = 2, .motion = 0});
    EXPECT_EQ(verdict, Verdict::give_up);
    EXPECT_EQ(loop.segment().substeps, 4096u);
    const double nan = std::nan("");
    SubstepControl broken = control(8);
    broken.begin(6, false);
    EXPECT_EQ(broken.judge({.stretch = INFINITY, .motion = nan}), Verdict::again);
}

TEST(SubstepControl, MotionThatMoreSubstepsDoNotMendIsKeptAndSaid) {
    SubstepControl loop = control(8);
    loop.begin(6, false);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 5}), Verdict::again);
    EXPECT_GT(loop.segment().substeps, 8u);
    while (loop.segment().substeps < 32) EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 4.9}), Verdict::again);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 4.8}), Verdict::unpredictable);
    EXPECT_LE(loop.begin(6, false).substeps, 8u);
    // Its stretch error is still a promise.
    EXPECT_EQ(loop.judge({.stretch = 1.5, .motion = 5}), Verdict::again);
}

TEST(SubstepControl, TheMotionOfASensitiveRunMayErrThreeTimesAsMuch) {
    SubstepControl loop = control(64);
    loop.begin(6, false);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 2.5, .coarse_stretch = 0.4, .sensitive = true}),
              Verdict::unpredictable);
    EXPECT_EQ(loop.segment().substeps, 64u);
    // An attempt that errs more is done again, and the stretch error is still a promise.
    while (!loop.begin(6, false).probes) loop.judge({.stretch = 0.1, .sensitive = true});
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 3.1, .coarse_stretch = 0.4, .sensitive = true}), Verdict::again);
    EXPECT_EQ(loop.judge({.stretch = 1.1, .motion = 0.5, .coarse_stretch = 4, .sensitive = true}), Verdict::again);
    // A run that is not sensitive is held to the limit itself.
    SubstepControl exact = control(64);
    exact.begin(6, false);
    EXPECT_EQ(exact.judge({.stretch = 0.1, .motion = 2.5, .coarse_stretch = 0.4}), Verdict::again);
}

TEST(SubstepControl, WhatHardlyHelpsIsSettledWithFourTimesTheSubstepsAtOnce) {
    SubstepControl loop = control(8);
    loop.begin(6, false);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 1.2}), Verdict::again);
    EXPECT_EQ(loop.segment().substeps, 12u);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 1.19}), Verdict::again);
    EXPECT_EQ(loop.segment().substeps, 32u);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 1.18}), Verdict::unpredictable);
}

TEST(SubstepControl, AnErrorOfFirstOrderIsMetWithAsManyMoreSubsteps) {
    SubstepControl loop = control(8);
    loop.begin(6, false);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 3}), Verdict::again);
    const double substeps = loop.segment().substeps, motion = 3 * 8 / substeps;
    ASSERT_GT(motion, 1);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = motion}), Verdict::again);
    EXPECT_GE(loop.segment().substeps, motion * substeps);
}

TEST(SubstepControl, AnAttemptThatFailedByItsStretchTellsNothingOfTheMotion) {
    SubstepControl loop = control(8);
    loop.begin(6, false);
    EXPECT_EQ(loop.judge({.stretch = 9, .motion = 0}), Verdict::again);  // ended before it was compared
    ASSERT_GE(loop.segment().substeps, 32u);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 1.2}), Verdict::again);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 0.5}), Verdict::keep);
}

/// Returns the verdict that ends the attempts, begun near the top, on a cloth with this error of motion by substeps.
Verdict verdict_near_the_top(SubstepControl& loop, double (*motion)(double)) {
    loop.begin(6, false);
    for (int attempts = 0; attempts < 20; ++attempts) {
        const Verdict verdict = loop.judge({.stretch = 0.1, .motion = motion(loop.segment().substeps)});
        if (verdict != Verdict::again) return verdict;
    }
    return Verdict::again;
}

TEST(SubstepControl, AtTheTopAQuarterOfItsSubstepsTellWhetherMoreWouldHelp) {
    SubstepControl chaotic = control(3072), resolving = control(3072);
    EXPECT_EQ(verdict_near_the_top(chaotic, [](double) { return 120.0; }), Verdict::unpredictable);
    EXPECT_EQ(chaotic.segment().substeps, 1024u);
    EXPECT_EQ(verdict_near_the_top(resolving, [](double n) { return std::pow(40000 / n, 2); }), Verdict::give_up);
    EXPECT_EQ(resolving.segment().substeps, 4096u);
}

TEST(SubstepControl, TurnsBackWhereMoreSubstepsMakeNonsense) {
    const auto judged = [](std::uint32_t substeps) {
        if (substeps > 100) return Judgement{.stretch = 40, .plausible = false};
        return Judgement{.stretch = 0.1, .motion = std::pow(200.0 / substeps, 2)};
    };
    SubstepControl loop = control(16);
    loop.begin(6, false);
    Verdict verdict = Verdict::again;
    std::uint32_t finest = 0, last = 0;
    for (int attempts = 0; verdict == Verdict::again && attempts < 10; ++attempts) {
        last = loop.segment().substeps;
        finest = std::max(finest, last);
        verdict = loop.judge(judged(last));
    }
    EXPECT_EQ(verdict, Verdict::unpredictable);
    EXPECT_GT(finest, 100u);
    EXPECT_LE(last, 100u);
    EXPECT_GE(last, 16u);
    EXPECT_EQ(loop.begin(6, false).substeps, last);
    // The loop does not turn back to an attempt that was never plausible.
    SubstepControl hopeless = control(256);
    hopeless.begin(6, false);
    for (verdict = Verdict::again; verdict == Verdict::again;)
        verdict = hopeless.judge(judged(hopeless.segment().substeps));
    EXPECT_EQ(verdict, Verdict::give_up);
}

TEST(SubstepControl, WhatTheWatchBoundsDoesNotHoldSubstepsUp) {
    // Cloth in flight comes near to the speed that it can have, whatever its substeps are.
    const auto comes_to = [](const Judgement& judgement) {
        SubstepControl loop = control(48);
        for (int segment = 0; segment < 100; ++segment) {
            loop.begin(6, false);
            EXPECT_EQ(loop.judge(judgement), Verdict::keep);
        }
        return loop.begin(6, false).substeps;
    };
    const Judgement easy{.stretch = 0.01, .motion = 0.02, .coarse_stretch = 0.02};
    Judgement fast = easy, strained = easy;
    fast.watch = strained.stretch = strained.coarse_stretch = 0.8;
    EXPECT_LT(comes_to(fast), 48u);
    EXPECT_EQ(comes_to(fast), comes_to(easy));
    EXPECT_EQ(comes_to(strained), 48u);
    fast.watch = 1.1;
    SubstepControl loop = control(48);
    loop.begin(6, false);
    EXPECT_EQ(loop.judge(fast), Verdict::again);
}

TEST(SubstepControl, AnErrorFarFromItsLimitMakesProbesFewer) {
    const auto probes = [](double share) {
        SubstepControl loop = control(16);
        std::uint32_t count = 0;
        for (int segment = 0; segment < 100; ++segment) {
            count += loop.begin(6, false).probes;
            EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 0.9, .coarse_stretch = 0.3}), Verdict::keep);
            loop.accumulated({share, 0});
        }
        return count;
    };
    EXPECT_EQ(probes(1.4), probes(0.6));
    EXPECT_LT(probes(0.1), probes(0.6));
}

/// Keeps a tenth of a second at a time, in which errors are those of a cloth whose companion shows this by the
/// substeps.
template <class Shown>
void fly(SubstepControl& loop, int tenths, const Shown& shown) {
    for (int tenth = 0; tenth < tenths; ++tenth) {
        for (std::uint32_t frames = 0; frames < 6; frames += loop.segment().frame_count) {
            loop.begin(6, false);
            EXPECT_EQ(loop.judge({.stretch = 0.02, .motion = 0.02, .coarse_stretch = 0.08}), Verdict::keep);
        }
        loop.accumulated(shown(loop.segment().substeps));
    }
}

TEST(SubstepControl, SubstepsLongerThanASwingNeedsAreTakenWhereTheErrorIsFarBelowItsLimit) {
    for (const double needed : {0.1, 0.5, 2.0, 5.0, 9.0, 20.0}) {
        SubstepControl loop(row_of(SolverMethod::line), 12, {1, 12}, 6);
        const auto shown = [&](std::uint32_t n) {
            const double error = std::pow(needed / n, 2);
            return Trend{error, error};
        };
        fly(loop, 1, shown);
        EXPECT_EQ(loop.begin(6, false).substeps, 12u) << "one comparison shows no growth that rises";
        fly(loop, 40, shown);
        const std::uint32_t calm = loop.begin(6, false).substeps;
        EXPECT_GE(calm, std::min(needed, 12.0));
        EXPECT_LE(calm, std::max(2.0, 3 * needed));
        loop.accumulated({});
        EXPECT_EQ(loop.begin(6, false).substeps, 12u) << "nobody tells";
    }
}

TEST(SubstepControl, LongSubstepsAreThoseOfTheCompanionAtMost) {
    SubstepControl loop(row_of(SolverMethod::line), 12, {1, 12}, 6);
    const auto shown = [](std::uint32_t) { return Trend{1e-4, 1e-4}; };
    fly(loop, 2, shown);
    EXPECT_EQ(loop.begin(6, false).substeps, companion_substeps(row_of(SolverMethod::line), 12));
    fly(loop, 1, shown);
    EXPECT_EQ(loop.begin(6, false).substeps, 2u);
}

TEST(SubstepControl, SubstepsStayThoseOfASwingWhileTheErrorGrowsEverFaster) {
    SubstepControl loop(row_of(SolverMethod::line), 12, {1, 12}, 6);
    double growth = 1e-4;
    for (int tenth = 0; tenth < 20; ++tenth, growth *= 1.2) {
        fly(loop, 1, [&](std::uint32_t) { return Trend{growth, growth}; });
        EXPECT_EQ(loop.begin(6, false).substeps, 12u);
    }
    fly(loop, 2, [&](std::uint32_t) { return Trend{growth, growth}; });
    EXPECT_LT(loop.begin(6, false).substeps, 12u);
}

TEST(SubstepControl, AnErrorThatComesNearerEndsLongSubsteps) {
    const auto small = [](std::uint32_t) { return Trend{0.01, 0.01}; };
    for (const Trend& large : {Trend{0.7, 0.1}, Trend{0.1, 1.1}}) {
        SubstepControl loop(row_of(SolverMethod::line), 12, {1, 12}, 6);
        fly(loop, 20, small);
        ASSERT_EQ(loop.begin(6, false).substeps, 2u);
        fly(loop, 1, [](std::uint32_t) { return Trend{0.1, 0.9}; });
        EXPECT_EQ(loop.begin(6, false).substeps, 2u) << "its limit allows so much to be added";
        int last = 0;
        for (const int least : {4, 8, 16, 32}) {
            fly(loop, 1, [&](std::uint32_t) { return large; });
            int tenths = 0;
            for (; loop.begin(6, false).substeps == 12 && tenths < 100; ++tenths) fly(loop, 1, small);
            EXPECT_GE(tenths, least) << "it waits longer each time, so that no cycle shakes cloth at rest";
            EXPECT_LT(tenths, 100);
            last = tenths;
            fly(loop, 10, small);
            EXPECT_EQ(loop.begin(6, false).substeps, 2u);
        }
        EXPECT_GE(loop.begin(6, true).substeps, 12u) << "the scene tells of something";
        EXPECT_EQ(loop.judge({.stretch = 0.1}), Verdict::keep);
        loop.accumulated({0.01, 0.01});
        int tenths = 0;
        for (; loop.begin(6, false).substeps >= 12 && tenths < last; ++tenths) fly(loop, 1, small);
        EXPECT_LT(tenths, 16) << "and then it waits no longer than at the start";
    }
}

TEST(SubstepControl, WithoutProbesSubstepsFollowTheErrorAndComeBack) {
    SubstepControl loop(row_of(SolverMethod::explicit_steps), 16, {2, 2}, 6);
    const auto frame = [&](double share) {
        EXPECT_FALSE(loop.begin(6, false).probes);
        EXPECT_EQ(loop.judge({.stretch = 0.1}), Verdict::keep);
        loop.accumulated({share, 0});
    };
    for (int k = 1; k <= 20; ++k) frame(0.5 + 0.1 * k);
    const std::uint32_t most = loop.segment().substeps;
    EXPECT_EQ(most, 128u) << "six rungs above the proposal";
    for (int k = 0; k < 20; ++k) frame(0.05);
    EXPECT_EQ(loop.segment().substeps, 16u);
}

/// Judges frames whose only trouble is that at fewer substeps than that something drawn may pass a collider.
std::uint32_t substeps_taken(SubstepControl& loop, double needed, std::uint32_t& attempts) {
    loop.begin(1, false);
    Verdict verdict = Verdict::again;
    for (attempts = 0; verdict == Verdict::again; ++attempts)
        verdict = loop.judge({.stretch = 0.5, .passage = needed / loop.segment().substeps});
    EXPECT_EQ(verdict, Verdict::keep);
    return loop.segment().substeps;
}

TEST(SubstepControl, WhatPassesAColliderTakesItsSubstepsAndOtherFramesTakeTheirs) {
    SubstepControl loop = control(8);
    std::uint32_t attempts = 0;
    EXPECT_EQ(substeps_taken(loop, 7.9, attempts), 8u);
    EXPECT_EQ(substeps_taken(loop, 600, attempts), 768u);
    EXPECT_EQ(attempts, 2u) << "what it takes is known";
    EXPECT_EQ(substeps_taken(loop, 550, attempts), 768u);
    EXPECT_EQ(attempts, 1u) << "the next frame will take as many";
    substeps_taken(loop, 0, attempts);
    EXPECT_EQ(substeps_taken(loop, 0, attempts), 8u);
}

TEST(SubstepControl, WhatPassesAColliderEvenAtTheTopIsKept) {
    SubstepControl loop = control(8);
    std::uint32_t attempts = 0;
    EXPECT_EQ(substeps_taken(loop, 1e6, attempts), 4096u);
    EXPECT_EQ(attempts, 2u);
}

TEST(SubstepControl, AProbeInWhichSomethingMayPassIsDoneAgain) {
    SubstepControl loop = control(8);
    loop.begin(6, false);
    ASSERT_TRUE(loop.segment().probes);
    EXPECT_TRUE(loop.fails({.passage = 1.2}));
    EXPECT_EQ(loop.judge({.passage = 1.2}), Verdict::again);
    EXPECT_EQ(loop.segment().substeps, 12u);
    EXPECT_FALSE(loop.fails({.passage = 1}));
    EXPECT_EQ(loop.judge({.stretch = 0.5, .motion = 0.9, .coarse_stretch = 0.9, .passage = 1}), Verdict::keep);
}

/// Judges a frame whose only trouble is a lag, by its substeps.
template <class Lag>
std::uint32_t substeps_lagging(SubstepControl& loop, const Lag& lag, std::uint32_t& attempts) {
    loop.begin(1, false);
    Verdict verdict = Verdict::again;
    for (attempts = 0; verdict == Verdict::again; ++attempts)
        verdict = loop.judge({.stretch = 0.5, .lag = lag(loop.segment().substeps)});
    EXPECT_EQ(verdict, Verdict::keep);
    return loop.segment().substeps;
}

TEST(SubstepControl, ALagThatMoreSubstepsLessenIsLessened) {
    SubstepControl loop = control(8);
    std::uint32_t attempts = 0;
    const auto lag = [](double substeps) { return 30 / substeps; };
    EXPECT_EQ(substeps_lagging(
                  loop, [](double) { return 1.0; }, attempts),
              8u);
    EXPECT_EQ(substeps_lagging(loop, lag, attempts), 32u);
    EXPECT_EQ(attempts, 2u);
    EXPECT_EQ(substeps_lagging(loop, lag, attempts), 32u);
    EXPECT_EQ(attempts, 1u) << "the next frame will take as many";
    substeps_lagging(
        loop, [](double) { return 0.0; }, attempts);
    EXPECT_EQ(substeps_lagging(
                  loop, [](double) { return 0.0; }, attempts),
              8u);
    EXPECT_TRUE(loop.fails({.lag = 1.1}));
}

TEST(SubstepControl, AFrameThatLagsIsProbedInsteadOfRefined) {
    SubstepControl loop = control(16);
    EXPECT_TRUE(loop.begin(6, false).probes);
    EXPECT_FALSE(loop.fails({.lag = 50})) << "the probe measures the motion";
    EXPECT_EQ(loop.judge({.stretch = 0.5, .motion = 0.8, .coarse_stretch = 0.9, .lag = 50}), Verdict::keep);
    while (!loop.begin(6, false).probes) EXPECT_EQ(loop.judge({.stretch = 0.5, .lag = 50}), Verdict::keep) << "known";
    EXPECT_EQ(loop.judge({.stretch = 0.5, .motion = 0.8, .coarse_stretch = 0.9}), Verdict::keep);
    ASSERT_FALSE(loop.begin(4, false).probes);
    EXPECT_TRUE(loop.fails({.stretch = 0.5, .lag = 50}));
    EXPECT_EQ(loop.judge({.stretch = 0.5, .lag = 50}), Verdict::again);
    EXPECT_EQ(loop.segment(), (Segment{16, 4, true}));
    EXPECT_EQ(loop.judge({.stretch = 0.5, .motion = 2, .coarse_stretch = 0.9, .lag = 50}), Verdict::again)
        << "a motion that is wrong is refined";
    EXPECT_GT(loop.segment().substeps, 16u);
    EXPECT_EQ(loop.judge({.stretch = 0.1, .motion = 0.5, .coarse_stretch = 0.4, .lag = 20}), Verdict::keep);
}

TEST(SubstepControl, ALagThatMoreSubstepsDoNotLessenIsKeptAndLeftAlone) {
    SubstepControl loop = control(8);
    std::uint32_t attempts = 0;
    const auto lag = [](double) { return 2.0; };
    EXPECT_EQ(substeps_lagging(loop, lag, attempts), 24u);
    EXPECT_EQ(attempts, 2u);
    for (int frame = 0; frame < 60; ++frame) {
        EXPECT_EQ(substeps_lagging(loop, lag, attempts), 8u) << "they are left alone for a while";
        EXPECT_EQ(attempts, 1u);
    }
    for (int frame = 0; frame < 12; ++frame) substeps_lagging(loop, lag, attempts);
    EXPECT_EQ(attempts, 2u) << "and looked at again";
}

TEST(SubstepControl, BeginsWithTheSubstepsThatTheLawProposes) {
    for (const std::uint32_t proposed : {4u, 8u, 32u})
        EXPECT_EQ(control(proposed).begin(6, false).substeps, first_rung(row_of(SolverMethod::line), proposed));
    EXPECT_EQ(first_rung(row_of(SolverMethod::line), 8), 8u);
}

TEST(SubstepControl, NeverGoesBelowWhatBendingNeeds) {
    SubstepControl loop(row_of(SolverMethod::line), 2, {30, 30}, 6);
    EXPECT_EQ(loop.segment().substeps, 0u);
    EXPECT_EQ(loop.begin(6, false).substeps, 32u);
    SubstepControl easy(row_of(SolverMethod::line), 64, {30, 30}, 6);
    EXPECT_EQ(run(easy, {1, 1}, 300).last, 32u);
}

TEST(SubstepControl, BeginsFinerAndWithAProbeWhereTheSceneTellsOfSomething) {
    SubstepControl calm = control(8), loop = control(8);
    EXPECT_GT(loop.begin(6, true).substeps, calm.begin(6, false).substeps);
    EXPECT_TRUE(loop.segment().probes);
    EXPECT_FALSE(loop.begin(1, true).probes);  // no room
}

}  // namespace
}  // namespace drape
