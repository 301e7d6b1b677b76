// Paths of SVG become closed curves of straight pieces.
#include "input/svg_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drape::input {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double area(const PathCurve& curve) {
    double doubled = 0;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const auto &a = curve.points[i], &b = curve.points[(i + 1) % curve.points.size()];
        doubled += a[0] * b[1] - a[1] * b[0];
    }
    return doubled / 2;
}

std::string fault(std::string_view text) {
    try {
        (void)read_path(text, 1e-3);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(SvgPathTest, LinesAreTheirEnds) {
    using P = std::array<double, 2>;
    const std::vector<P> square{{1, 2}, {4, 2}, {4, 4}, {1, 4}};
    for (const char* text : {"M1 2 L4 2 L4 4 L1 4 Z", "M 1,2 4,2 4,4 1,4", "m1 2h3v2h-3z", "M1 2H4V4H1V2",
                             "M1+2H4V4H1z", "M.1e1 2h3 0v2h-3"}) {
        const std::vector<PathCurve> curves = read_path(text, 1e-3);
        ASSERT_EQ(curves.size(), 1u) << text;
        EXPECT_EQ(curves[0].points, square) << text;
        EXPECT_THAT(curves[0].corners, ElementsAre(0, 1, 2, 3)) << text;
    }
}

TEST(SvgPathTest, ARelativeCurveBeginsWhereTheOneBeforeEnded) {
    const std::vector<PathCurve> closed = read_path("m1 1h1v1z m5 0h1v1z", 1e-3),
                                 open = read_path("m1 1h1v1 m5 0h1v1", 1);
    ASSERT_EQ(closed.size(), 2u);
    ASSERT_EQ(open.size(), 2u);
    EXPECT_EQ(closed[1].points[0], (std::array<double, 2>{6, 1})) << "Z goes back to the start";
    EXPECT_EQ(open[1].points[0], (std::array<double, 2>{7, 2}));
}

TEST(SvgPathTest, ArcsAreCircles) {
    for (const double tolerance : {1e-2, 1e-4, 1e-6})
        for (const char* text : {"M-1 0A1 1 0 0 0 1 0A1 1 0 0 0-1 0Z", "M-1 0a1 1 0 002 0a1 1 0 00-2 0",
                                 "M0 1A.5.5 0 11 0-1A.1.1 0 01 0 1"}) {
            const std::vector<PathCurve> curves = read_path(text, tolerance);
            ASSERT_EQ(curves.size(), 1u);
            EXPECT_THAT(curves[0].corners, ElementsAre()) << text;
            for (const auto& at : curves[0].points) EXPECT_NEAR(std::hypot(at[0], at[1]), 1, 1e-12) << text;
            EXPECT_NEAR(std::abs(area(curves[0])), std::numbers::pi, 4.5 * tolerance) << text;
        }
}

TEST(SvgPathTest, AnArcGoesTheWayOfItsFlags) {
    // From (0, 0) to (1, 1) about (1, 0) or (0, 1): a quarter of a circle or three.
    const auto area_of = [](const char* flags) {
        return area(read_path(std::string("M0 0A1 1 0 ") + flags + " 1 1Z", 1e-7).at(0));
    };
    const double quarter = std::numbers::pi / 4 - 0.5, rest = std::numbers::pi * 3 / 4 + 0.5;
    EXPECT_NEAR(area_of("0 1"), quarter, 1e-6);
    EXPECT_NEAR(area_of("0 0"), -quarter, 1e-6);
    EXPECT_NEAR(area_of("1 1"), rest, 1e-6);
    EXPECT_NEAR(area_of("1 0"), -rest, 1e-6);
}

TEST(SvgPathTest, ATurnedEllipseHasItsArea) {
    const std::vector<PathCurve> curves = read_path("M3 0A5 2 30 0 1 4 4A5 2 30 1 1 3 0Z", 1e-6);
    EXPECT_NEAR(std::abs(area(curves.at(0))), std::numbers::pi * 10, 1e-4);
}

TEST(SvgPathTest, BezierCurvesKeepTheTolerance) {
    // The area under a cubic from (0, 0) to (1, 0) with handles (0, h) and (1, h) is 3 h/5.
    for (const char* text : {"M0 0C0 1 1 1 1 0Z", "M0 0c0 1 1 1 1 0"})
        EXPECT_NEAR(-area(read_path(text, 1e-6).at(0)), 0.6, 1e-5) << text;
    // A parabola whose handle is (1/2, 1) has 2/3 of its triangle's area.
    EXPECT_NEAR(-area(read_path("M0 0Q.5 1 1 0Z", 1e-6).at(0)), 1.0 / 3, 1e-5);
    // S and T mirror the handle before: both curves go on below.
    EXPECT_NEAR(area(read_path("M0 0Q.5 1 1 0T2 0V-9H0Z", 1e-7).at(0)), -18, 1e-5) << "what is above is missing below";
    EXPECT_NEAR(area(read_path("M0 0C0 1 1 1 1 0S2-1 2 0V-9H0Z", 1e-7).at(0)), -18, 1e-5);
    EXPECT_LE(read_path("M0 0C0 1 1 1 1 0Z", 1e-2)[0].points.size(), 12u);
}

TEST(SvgPathTest, OnlyTurnsOfCurvesAreCorners) {
    const std::vector<PathCurve> curves = read_path("M0 0A1 1 0 0 0 2 0Z", 1e-3);
    const std::size_t last = curves.at(0).points.size() - 1;
    EXPECT_THAT(curves[0].corners, ElementsAre(0, last)) << "where the half circle meets its diameter";
}

TEST(SvgPathTest, WhatIsNoPathIsSaidWithItsPlace) {
    EXPECT_EQ(fault("L1 1"), "a path that begins with M at character 1 of the path");
    EXPECT_EQ(fault("M1"), "a number at character 3 of the path");
    EXPECT_EQ(fault("M1 1 K2 2"), "one of the commands M, L, H, V, C, S, Q, T, A and Z at character 7 of the path");
    EXPECT_EQ(fault("M1 1 Z 2 2"), "a command at character 8 of the path");
    EXPECT_THAT(fault("M1 1A1 1 0 2 0 3 3"), HasSubstr("a flag, 0 or 1"));
    EXPECT_THAT(fault("M1e99 1"), HasSubstr("a number of at most 1e9"));
    EXPECT_THAT(fault("M1 1Lnan 2"), HasSubstr("a number"));
    EXPECT_THAT(fault("M0 0C0 1e9 1e9 1e9 1e9 0Z"), HasSubstr("at most 20000 pieces"));
    EXPECT_EQ(read_path("", 1).size(), 0u);
    EXPECT_EQ(read_path("M1 1L2 2", 1).size(), 0u) << "two points go around nothing";
}

}  // namespace
}  // namespace drape::input
