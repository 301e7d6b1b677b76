// Pins that are led into a collider or through it, or that jump at the start, are named with frame and depth.
#include "world/held.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "drape/scene_reader.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A sheet hangs by its top edge, of which `path` moves all 5 particles, from y = 0; `colliders` are at its side.
SceneResult held_sheet(const std::string& path, const std::string& colliders, double substeps = 4) {
    return read_scene_text(fmt::format(R"({{"time": {{"fps": 60, "frames": 61}},
"cloths": [{{"name": "sheet", "grid": [5, 5], "size": [1, 1], "placement": {{"origin": [0, 0, 0]}},
  "pins": [{{"edge": "top", "path": [{}]}}]}}],
"colliders": {{{}}}, "solver": {{"method": "line", "substeps": {}}}}})",
                                       path, colliders, substeps),
                           "held.json");
}

TEST(Held, APinThatIsLedIntoASolidIsNamedWithFrameAndDepth) {
    const SceneResult result = held_sheet(R"({"t": 0}, {"t": 0.5, "translate": [0, 0, 2]})",
                                          R"("spheres": [{"center": [0.5, 0, 2], "radius": 0.4}])");
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_THAT(result.warnings[0].text(), testing::AllOf(HasSubstr("held.json:3:"),
                                                          HasSubstr("/cloths/0/pins/0: cloth \"sheet\" is held up to "
                                                                    "0.4 m inside /colliders/spheres/0, from frame "),
                                                          HasSubstr("deepest in frame 30: what is held")));
}

/// Depths are known for a ball and for a plane, whichever of the two moves.
TEST(Held, DepthsAreThoseOfTheClosedForm) {
    std::mt19937 random(48);
    std::uniform_real_distribution<double> uniform(0.1, 1);
    for (int draw = 0; draw < 100; ++draw) {
        SceneDescription scene = held_sheet("{\"t\": 0}", "").scene.value();
        const double way = 3 * uniform(random), wall = 2 * uniform(random), time = uniform(random);
        scene.solver.method = draw % 2 == 0 ? SolverMethod::line : SolverMethod::automatic;
        Collider plane{Plane{{0, 0, -1}, -wall}, {}};
        MotionPath& path = draw % 3 == 0 ? plane.path : scene.cloths[0].pins[0].path;
        const double sign = draw % 3 == 0 ? -1 : 1;
        path.keys = {{0, {0, 0, 0}, {}}, {time, {0, 0, sign * way}, {}}};
        scene.colliders = {plane};
        const std::vector<HeldDeep> found = held_in_colliders(scene);
        ASSERT_EQ(found.size(), way > wall + 0.25e-3 ? 1u : 0u) << draw;
        if (found.empty()) continue;
        EXPECT_NEAR(found[0].depth, way - wall, 1e-6 + 1e-3 * way) << draw;
        EXPECT_LE(found[0].first, found[0].worst);
        EXPECT_NEAR(found[0].worst, 60 * time, 1.01);
    }
}

TEST(Held, APinThatPassesThroughWithinASubstepIsToldOf) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.1, 1);
    int through = 0;
    for (int draw = 0; draw < 50; ++draw) {
        SceneDescription scene = held_sheet("{\"t\": 0}", "").scene.value();
        scene.cloths[0].pins[0].path.keys = {{0, {0, 0, 0}, {}}, {0.1 * uniform(random), {0, 0, 10}, {}}};
        const double thickness = 0.02 * uniform(random);
        Collider plate{Box{{0.5, 0, 1 + 8 * uniform(random)}, {2, 2, thickness}}, {}};
        scene.colliders = {plate};
        const std::vector<HeldDeep> found = held_in_colliders(scene);
        ASSERT_EQ(found.size(), 1u) << draw;
        EXPECT_GT(found[0].depth, 0.5 * thickness);
        EXPECT_LE(found[0].depth, thickness * 1.0001);
        through += found[0].stays ? 0 : 1;
        std::get<Box>(scene.colliders[0].shape).center[2] = 11;
        EXPECT_THAT(held_in_colliders(scene), IsEmpty());
    }
    EXPECT_GT(through, 10);
}

TEST(Held, WhatIsReleasedBeforeItOrHeldBesideItIsFine) {
    SceneDescription scene = held_sheet(R"({"t": 0}, {"t": 0.5, "translate": [0, 0, 2]})",
                                        R"("spheres": [{"center": [0.5, 0, 2], "radius": 0.4}])")
                                 .scene.value();
    EXPECT_EQ(held_in_colliders(scene).size(), 1u);
    scene.cloths[0].pins[0].release = 0.1;
    EXPECT_THAT(held_in_colliders(scene), IsEmpty());
    scene.cloths[0].pins[0].release.reset();
    scene.time.frame_count = 7;
    EXPECT_THAT(held_in_colliders(scene), IsEmpty());
    scene.time.frame_count = 61;
    std::get<Sphere>(scene.colliders[0].shape).center[1] = 0.5;
    EXPECT_THAT(held_in_colliders(scene), IsEmpty());
}

TEST(Held, APathThatBeginsWithAJumpIsNamed) {
    const SceneResult result = held_sheet(R"({"t": 0, "translate": [0, 0.5, 0]}, {"t": 1})", "");
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_THAT(
        result.warnings[0].text(),
        HasSubstr("/cloths/0/pins/0/path: the path begins with a jump: at time 0 it has its particles up to 0.5 "
                  "m from where cloth \"sheet\" starts"));
    EXPECT_EQ(path_jumps(held_sheet(R"({"t": 3, "rotate": [0, 90, 0]})", "").scene.value()).size(), 1u);
    EXPECT_THAT(held_sheet(R"({"t": 0}, {"t": 1, "translate": [0, 0.5, 0]})", "").warnings, IsEmpty());
}

}  // namespace
}  // namespace drape
