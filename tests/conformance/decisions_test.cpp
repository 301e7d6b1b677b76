// Decisions that rounding turns are told from values that are wrong, on numbers made up here: the device that runs
// these tests rounds as C++ does, so that it turns none.
#include <gtest/gtest.h>

#include <limits>

#include "contact_mirror.h"
#include "step_bounds.h"
#include "twin/kernels.h"

namespace drape {
namespace {

using test::FieldPair;
using test::StepBound;

constexpr std::size_t place_count = 1000;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Returns whether a field is judged to be right.
bool is_right(const FieldPair& pair, StepKind kind) {
    const StepBound& bound = test::step_bounds()[static_cast<std::size_t>(kind)];
    return static_cast<double>(difference_of(pair, bound.units).beyond) <= bound.may_turn(pair);
}
bool are_right(const test::DecidedPairs& decided, StepKind kind) {
    std::vector<FieldPair> pairs;
    decided.put_into(pairs);
    return std::ranges::all_of(pairs, [kind](const FieldPair& pair) { return is_right(pair, kind); });
}

/// Returns whether the collide step may mark so many places otherwise than the twin.
bool may_mark(std::size_t count, float device, float twin) {
    test::DecidedPairs marks("");
    for (std::size_t place = 0; place < place_count; ++place) {
        const float ours = place < count ? device : twin;
        marks.add(test::mark_of(ours), test::mark_of(twin).value(), ours, twin);
    }
    return are_right(marks, StepKind::collide);
}

/// Returns whether self_limit may leave so many places another share than the twin's, where so much was `made`.
bool may_share(std::size_t count, float device, float twin, float made = 0) {
    test::DecidedPairs shares("", 1);
    for (std::size_t place = 0; place < place_count; ++place) {
        const float ours = place < count ? device : twin;
        shares.add(test::goes_on(ours, made), test::goes_on(twin, made).value(), ours, twin);
    }
    return are_right(shares, StepKind::self_limit);
}

TEST(Decisions, OfWhatMovedAParticleMayTurnAtSomePlaces) {
    EXPECT_TRUE(may_mark(0, glsl::self_led_out, 0));
    EXPECT_TRUE(may_mark(50, glsl::self_led_out, 0));
    EXPECT_TRUE(may_mark(50, glsl::self_pushed, glsl::self_pushed_and_led));
    EXPECT_FALSE(may_mark(200, glsl::self_led_out, 0));
}

TEST(Decisions, WhatIsNoMarkIsWrong) {
    for (const float wrong : {4.0f, 0.5f, -1.0f, nan}) EXPECT_FALSE(may_mark(1, wrong, glsl::self_pushed)) << wrong;
}

TEST(Decisions, ToGoOnMayTurnAtFewPlaces) {
    EXPECT_TRUE(may_share(3, 1, 0));
    EXPECT_TRUE(may_share(3, 0.25f, 0.75f, 0.25f));
    EXPECT_FALSE(may_share(100, 1, 0));
}

TEST(Decisions, ShareThatIsOffIsWrongWhereBothGoOn) {
    EXPECT_TRUE(may_share(100, 0.5f + 0x1p-20f, 0.5f));
    EXPECT_FALSE(may_share(1, 0.5f, 0.501f));
    EXPECT_FALSE(may_share(1, 1, 0.5f));
}

TEST(Decisions, ShareThatNobodyCanMakeIsWrong) {
    for (const float wrong : {1.5f, 0.125f, -1.0f, nan}) EXPECT_FALSE(may_share(1, wrong, 0.25f, 0.25f)) << wrong;
}

/// The corner has no room left and moves along the plane, so that a unit of the last place of an edge's coordinate says
/// whether it moves towards the plane.
TEST(Decisions, RoundingTurnsWhetherACornerGoesOn) {
    const glsl::SelfGap gap{.normal = {0, 1, 0}, .distance = 0.03f, .apart = 0.03f};
    const auto share = [&gap](float along) { return glsl::self_share(gap, 0, -0.0075f, 1, along, 0, false, 5e-6f); };
    const float rounding = 0x1p-29f;  // of 0.03 m
    EXPECT_EQ(share(rounding), 0);
    EXPECT_EQ(share(-rounding), 1);
    EXPECT_TRUE(may_share(1, share(-rounding), share(rounding)));
}

}  // namespace
}  // namespace drape
