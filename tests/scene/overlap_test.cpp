// Cloth that starts inside a collider, or through another cloth, is noticed (which, how deep, how much of it), and
// refused where the scene says so.
#include "world/overlap.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drape/scene_reader.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A sheet of 5 x 5 particles, 0.25 m apart, lies about the y axis, 0.1 m above the origin. It is so thick that edges
/// of boxes take its spacing.
SceneResult over(const std::string& colliders, const std::vector<std::string>& overrides = {}) {
    return read_scene_text(fmt::format(R"({{"name": "over",
"cloths": [{{"name": "sheet", "grid": [5, 5], "size": [1, 1], "thickness": 0.05,
  "placement": {{"origin": [-0.5, 0.1, -0.5], "u": [1, 0, 0], "v": [0, 0, 1]}}}}],
"colliders": {{{}}}}})",
                                       colliders),
                           "over.json", overrides);
}

/// Returns the warnings of a scene that is fine otherwise.
std::vector<std::string> warned(const std::string& colliders, const std::vector<std::string>& overrides = {}) {
    const SceneResult result = over(colliders, overrides);
    EXPECT_TRUE(result.scene) << (result.errors.empty() ? "" : result.errors[0].text());
    std::vector<std::string> texts;
    for (const SceneError& warning : result.warnings) texts.push_back(warning.text());
    return texts;
}

const std::string ball = R"("spheres": [{"radius": 0.3, "center": [0, 0, 0]}])";

/// Depths and counts are worked out by hand.
TEST(OverlapTest, EveryKindOfCollider) {
    const auto expect = [](const std::string& colliders, const std::string& text) {
        EXPECT_THAT(warned(colliders), ElementsAre(HasSubstr("cloth \"sheet\" starts up to " + text + ": contact")));
    };
    expect(R"("planes": [{"normal": [0, 1, 0], "offset": 0.2}])", "0.1 m inside /colliders/planes/0 (25 particles)");
    expect(ball, "0.2 m inside /colliders/spheres/0 (5 particles)");
    expect(R"("boxes": [{"center": [0, 0, 0], "half_extents": [0.3, 0.25, 0.3]}])",
           "0.15 m inside /colliders/boxes/0 (9 particles)");
    expect(R"("ellipsoids": [{"center": [0, 0, 0], "radii": [0.4, 0.2, 0.4]}])",
           "0.1 m inside /colliders/ellipsoids/0 (5 particles)");
    expect(R"("capsules": [{"from": [-1, 0, 0], "to": [1, 0, 0], "radius": 0.15}])",
           "0.05 m inside /colliders/capsules/0 (5 particles)");
}

TEST(OverlapTest, AClothLeavesABoxByOneFace) {
    const auto way = [](const std::string& box, const std::vector<std::string>& overrides = {}) {
        const SceneResult result = over("\"boxes\": [{" + box + "}]", overrides);
        return ways_out(result.scene->cloths[0], result.scene->colliders, 0.1).at(0);
    };
    const auto expect = [](const WayOut& found, const Vec3& normal, double until) {
        EXPECT_EQ(found.normal, normal);
        EXPECT_NEAR(found.until, until, 1e-9);
    };
    const std::string middle = R"("center": [0, 0, 0], "half_extents": [0.3, 0.25, 0.3])";
    expect(way(middle), {0, 1, 0}, 3);  // though most are nearer to a side
    expect(way(middle, {"/cloths/0/placement/origin=[-0.5,-0.1,-0.5]"}), {0, -1, 0}, 3);
    expect(way(middle + R"(, "rotate": [0, 0, 90])"), {1, 0, 0}, 4);  // its own x is up
    expect(way(middle, {"/cloths/0/placement/origin=[-0.5,0.3,-0.5]"}), {0, 0, 0}, 0);
    // An edge of the sheet is in the box by 0.1 m: sideways counts three times.
    expect(way(R"("center": [0.7, -0.02, 0], "half_extents": [0.3, 0.3, 0.3])"), {0, 1, 0}, 3.6);
    expect(way(R"("center": [0.7, 0.1, 0], "half_extents": [0.3, 0.35, 0.3])"), {-1, 0, 0}, 2);
    EXPECT_EQ(ways_out(over(ball).scene->cloths[0], over(ball).scene->colliders, 0.1), std::vector<WayOut>(1));
}

TEST(OverlapTest, IsSaidWhereTheClothIsPlaced) {
    EXPECT_THAT(warned(ball),
                ElementsAre("over.json:3:16: /cloths/0/placement: cloth \"sheet\" starts up to 0.2 m inside "
                            "/colliders/spheres/0 (5 particles): contact moves free particles out at 0.1 m/s, and held "
                            "ones stay"));
}

TEST(OverlapTest, FollowsThePlacement) {
    EXPECT_THAT(warned(ball, {"/cloths/0/placement/origin=[-0.5,0.31,-0.5]"}), IsEmpty());
    EXPECT_THAT(warned(ball, {"/cloths/0/placement/origin=[0,0.1,0]"}), ElementsAre(HasSubstr("0.2 m")));
    EXPECT_THAT(warned(ball, {"/cloths/0/placement/v=[0,1,0]", "/cloths/0/placement/origin=[0,0.1,-0.5]"}), IsEmpty());
    EXPECT_THAT(warned(ball, {"/cloths/0/placement/scale=[0.5,1]"}), ElementsAre(HasSubstr("(7 particles)")));
    const auto scattered = warned(ball, {"/cloths/0/placement/jitter=0.05"});
    ASSERT_EQ(scattered.size(), 1u);
    EXPECT_THAT(scattered[0], Not(HasSubstr("up to 0.2 m")));
}

TEST(OverlapTest, FollowsTheCollidersPoseAtTheStart) {
    const auto moved = [](const char* path) {
        return warned(R"("spheres": [{"radius": 0.3, "center": [0, 0, 0], "path": )" + std::string(path) + "}]");
    };
    EXPECT_THAT(moved(R"([{"t": 0, "translate": [0, -1, 0]}, {"t": 1}])"), IsEmpty());
    EXPECT_THAT(moved(R"([{"t": 0, "translate": [0, 0.1, 0]}, {"t": 1, "translate": [0, 5, 0]}])"),
                ElementsAre(HasSubstr("0.3 m")));
    const std::string thin = R"("center": [0, -0.3, 0], "half_extents": [0.05, 0.5, 0.05])";
    EXPECT_THAT(warned("\"boxes\": [{" + thin + "}]"), ElementsAre(HasSubstr("0.05 m")));
    EXPECT_THAT(warned("\"boxes\": [{" + thin + R"(, "rotate": [0, 0, 90]}])"), IsEmpty());
}

TEST(OverlapTest, TheDeepestIsNamedByItsPlaceInTheFile) {
    EXPECT_THAT(warned(R"("planes": [{"offset": -5}, {"normal": [0, 1, 0], "offset": 0.15}],
"spheres": [{"radius": 0.1, "center": [0, 5, 0]}, {"radius": 0.3, "center": [0, 0, 0]}])"),
                ElementsAre(HasSubstr("0.2 m inside /colliders/spheres/1 (5 particles), and inside 1 other collider")));
}

TEST(OverlapTest, WhatLiesOnASurfaceIsNotInside) {
    EXPECT_THAT(warned(R"("planes": [{"normal": [0, 1, 0], "offset": 0.1}])"), IsEmpty()) << "thickness is not depth";
    EXPECT_THAT(warned(R"("planes": [{"normal": [0, 1, 0], "offset": 0.101}])"), ElementsAre(HasSubstr("0.001 m")));
}

TEST(OverlapTest, HolesHaveNoCloth) {
    const std::string pea = R"("spheres": [{"radius": 0.2, "center": [0, 0, 0]}])";
    EXPECT_THAT(warned(pea), ElementsAre(HasSubstr("(1 particle)")));
    EXPECT_THAT(warned(pea, {"/cloths/0/holes=[[[1,1],[3,3]]]"}), IsEmpty());
    EXPECT_THAT(warned(pea, {"/cloths/0/holes=[[[1,1],[2,3]],[[2,1],[3,3]]]"}), IsEmpty()) << "of two holes";
    EXPECT_THAT(warned(pea, {"/cloths/0/holes=[[[1,1],[2,3]]]"}), ElementsAre(HasSubstr("(1 particle)")));
}

TEST(OverlapTest, IsAnErrorWhereTheSceneRefusesIt) {
    const SceneResult refused = over(ball, {"/overlap=\"refuse\""});
    EXPECT_FALSE(refused.scene);
    ASSERT_EQ(refused.errors.size(), 1u);
    EXPECT_EQ(refused.errors[0].text(),
              "over.json:3:16: /cloths/0/placement: expected a start outside all colliders (/overlap is \"refuse\"): "
              "cloth \"sheet\" starts up to 0.2 m inside /colliders/spheres/0 (5 particles)");
    const SceneResult outside = over(ball, {"/overlap=\"refuse\"", "/cloths/0/placement/origin=[-0.5,0.4,-0.5]"});
    ASSERT_TRUE(outside.scene);
    EXPECT_EQ(outside.scene->overlap, Overlap::refuse);
    EXPECT_THAT(outside.warnings, IsEmpty());
}

/// A sheet lies about the origin, and one of half its size is placed as told.
SceneResult crossing(const std::string& placement, const std::vector<std::string>& overrides = {}) {
    return read_scene_text(fmt::format(R"({{"name": "crossing",
"cloths": [{{"name": "sheet", "grid": [5, 5], "size": [1, 1], "self_collision": true,
  "placement": {{"origin": [-0.5, 0, -0.5], "u": [1, 0, 0], "v": [0, 0, 1]}}}},
  {{"name": "other", "grid": [3, 3], "size": [0.5, 0.5],
  "placement": {}}}]}})",
                                       placement),
                           "crossing.json", overrides);
}
const std::string upright = R"({"origin": [-0.2, 0.3, 0.1], "u": [1, 0, 0], "v": [0, -1, 0]})",
                  beside = R"({"origin": [0.6, 0.3, 0.1], "u": [1, 0, 0], "v": [0, -1, 0]})",
                  along = R"({"origin": [-0.25, 0.25, 0], "u": [1, 0, 0], "v": [0, -1, 0]})",
                  above = R"({"origin": [-0.2, 0.001, -0.3], "u": [1, 0, 0], "v": [0, 0, 1]})",
                  upon = R"({"origin": [-0.2, 1e-7, -0.3], "u": [1, 0, 0], "v": [0, 0, 1]})";

TEST(StartCrossingTest, IsSaidOfClothsThatMeet) {
    const auto warned = [](const SceneResult& result) {
        std::vector<std::string> texts;
        for (const SceneError& warning : result.warnings) texts.push_back(warning.text());
        return texts;
    };
    EXPECT_THAT(
        warned(crossing(upright)),
        ElementsAre(AllOf(HasSubstr("crossing.json:5:16: /cloths/1/placement: cloths \"sheet\" and \"other\" "
                                    "start through each other (6 pairs of triangles cross; moved by 0.2 m one would "
                                    "be off the other)"),
                          HasSubstr("they are led apart at 1 m/s and meet from then on; place one"))));
    EXPECT_THAT(warned(crossing(along)), ElementsAre(HasSubstr("start on or through each other (moved by 0.25 m")))
        << "along lines of both grids";
    EXPECT_THAT(warned(crossing(upon)),
                ElementsAre(AllOf(HasSubstr("start on each other"), HasSubstr("the two will not meet, and no frame"))));
    const std::string pins = R"(=[{"box": [[0, 0], [0, 0]]}])";
    EXPECT_THAT(warned(crossing(upright, {"/cloths/0/pins" + pins})), ElementsAre(HasSubstr("led apart at 1 m/s")));
    EXPECT_THAT(warned(crossing(upright, {"/cloths/0/pins" + pins, "/cloths/1/pins" + pins})),
                ElementsAre(HasSubstr("held as both are, they are not led apart")));
    EXPECT_THAT(warned(crossing(beside)), IsEmpty());
    EXPECT_THAT(warned(crossing(above)), IsEmpty());
    EXPECT_THAT(warned(crossing(upright, {"/cloths/0/holes=[[[0,2],[4,3]]]"})), IsEmpty()) << "through a hole";
    EXPECT_THAT(warned(crossing(upright, {"/cloths/0/self_collision=false"})),
                ElementsAre(HasSubstr("are set to touch, but will pass through each other")));
}

TEST(StartCrossingTest, OfAClothWithItselfIsUntiedAndSaid) {
    const auto warned = [](const std::string& placement) {
        const SceneResult read =
            crossing(beside, {"/cloths/0/placement/" + placement, "/cloths/1/placement/origin=[9,9,9]"});
        std::string texts;
        for (const SceneError& warning : read.warnings) texts += warning.text() + "\n";
        return texts;
    };
    EXPECT_THAT(
        warned("jitter=0.3"),
        HasSubstr("/cloths/0/placement: cloth \"sheet\" would start through itself by its jitter: particles start "
                  "nearer to their places, by up to 0."));
    EXPECT_THAT(warned("scale=[0.01,0.01]"), IsEmpty());
    EXPECT_THAT(warned("scale=[-1,1]"), IsEmpty());
    EXPECT_THAT(warned("jitter=0.03"), IsEmpty());
    // This start is looked at and found to be apart.
    EXPECT_THAT(warned("jitter=0.06"), IsEmpty());
}

// A gathered cloth is refused since contact would keep all its particles where they are, for good.
TEST(StartCrossingTest, AClothThatMeetsItselfMayNotStartGathered) {
    for (const std::string scale : {"[1,0]", "[0,0]", "[0,1]", "[1e-6,1e-6]"}) {
        const std::string placement = "/cloths/0/placement/scale=" + scale;
        const SceneResult refused = crossing(beside, {placement, "/cloths/1/placement/origin=[9,9,9]"});
        ASSERT_EQ(refused.errors.size(), 1u) << scale;
        EXPECT_THAT(refused.errors[0].text(), HasSubstr("/cloths/0/placement: expected a cloth with room between its "
                                                        "particles: cloth \"sheet\", which meets itself"));
        EXPECT_TRUE(crossing(beside, {placement, "/cloths/0/self_collision=false"}).scene) << scale;
    }
}

TEST(StartCrossingTest, IsAnErrorWhereTheSceneRefusesIt) {
    const SceneResult refused = crossing(upright, {"/overlap=\"refuse\""});
    ASSERT_EQ(refused.errors.size(), 1u);
    EXPECT_THAT(refused.errors[0].text(),
                HasSubstr("expected cloths that start apart (/overlap is \"refuse\"): cloths "));
    EXPECT_TRUE(crossing(beside, {"/overlap=\"refuse\""}).scene);
}

}  // namespace
}  // namespace drape
