// Cloths that start through each other are led apart, slowly, and meet from then on, on the twin. A checker that shares
// nothing with the search for crossings in the substeps judges them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/vectors.h"
#include "support/self_contact_scenes.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

Vec3 mean_of(const Twin& twin, std::size_t cloth) {
    Vec3 sum{};
    const std::vector<glsl::vec4>& all = twin.cloth(cloth)[Field::position];
    for (const glsl::vec4& x : all) sum = {sum[0] + double(x.x), sum[1] + double(x.y), sum[2] + double(x.z)};
    const auto count = static_cast<double>(all.size());
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

struct Parted {
    std::uint32_t last_crossed = 0, crossing_again = 0, met = 0;
    double fastest = 0;  ///< m/s at which the two part
};

Parted run(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    Parted found;
    bool apart = false;
    double before = mean_of(twin, 1)[1] - mean_of(twin, 0)[1];
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        twin.run_frame(frame);
        const bool crosses = test::crossings(model, twin) > 0;
        found.crossing_again += apart && crosses ? 1 : 0;
        apart = apart || !crosses;
        if (!apart) found.last_crossed = frame;
        if (apart) found.met = std::max(found.met, twin.contact().record.most_pairs);
        const double height = mean_of(twin, 1)[1] - mean_of(twin, 0)[1];
        found.fastest = std::max(found.fastest, std::abs(height - before) * scene.time.fps);
        before = height;
    }
    std::printf("[ measured ] cross until frame %u, parting at up to %.3f m/s, then %u pairs\n", found.last_crossed,
                found.fastest, found.met);
    return found;
}

TEST(CrossedStartTest, IsToldOfAndTheWayOffIsKnown) {
    const SimulationModel model(test::crossed(SolverMethod::line, 8));
    const SelfContact& contact = *model.self_contact;
    ASSERT_EQ(contact.crossed.size(), 1u);
    EXPECT_NEAR(contact.crossed[0].depth, 0.1, 1e-6);
    EXPECT_EQ(contact.meetings, (std::vector<glsl::uint>{1, glsl::self_meets_apart, glsl::self_meets_apart, 1}));
    ASSERT_EQ(contact.to_part.size(), 1u);
    // The standing one has 0.1 m above and 0.2 m below, so it goes down, and both go by their masses.
    EXPECT_EQ(contact.to_part[0].way.y, -1.0f);
    EXPECT_NEAR(double(contact.to_part[0].parts.x + contact.to_part[0].parts.y), 1, 1e-6);
    EXPECT_LT(contact.to_part[0].parts.x, contact.to_part[0].parts.y / 4);
}

TEST(CrossedStartTest, TheTwoAreLedApartWithoutMovingAsAWhole) {
    for (const auto& [method, substeps] : {std::pair{SolverMethod::line, 12u}, {SolverMethod::explicit_steps, 24u}}) {
        const SceneDescription scene = test::crossed(method, substeps);
        const SimulationModel model(scene);
        const double heavy = 0.6 * 0.5, light = 0.37 * 0.3 * 0.5;
        Twin twin(model);
        const double start = (heavy * mean_of(twin, 0)[1] + light * mean_of(twin, 1)[1]) / (heavy + light);
        for (std::uint32_t frame = 1; frame <= 10; ++frame) twin.run_frame(frame);
        const double then = (heavy * mean_of(twin, 0)[1] + light * mean_of(twin, 1)[1]) / (heavy + light);
        EXPECT_NEAR(then, start, 0.004);
        const Parted found = run(scene, 30);
        EXPECT_GT(found.last_crossed, 2u);
        EXPECT_LT(found.last_crossed, 12u);  // 0.1 m at 1 m/s takes 6 frames
        EXPECT_EQ(found.crossing_again, 0u);
        EXPECT_LT(found.fastest, 1.3);
    }
}

/// One cloth is led down off a sheet that is held, another one is led up and then lies on it.
TEST(CrossedStartTest, FromThenOnTheyMeet) {
    SceneDescription scene = test::crossed(SolverMethod::line, 16);
    scene.gravity = {0, -9.81, 0};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 10), test::pin_box(12, 0, 12, 10)};
    scene.cloths[1].placement.origin[1] = 0.75;
    const SimulationModel model(scene);
    EXPECT_EQ(model.self_contact->to_part[0].parts.x, 0.0f);
    EXPECT_EQ(model.self_contact->to_part[0].parts.y, 1.0f);
    const Parted found = run(scene, 60);
    EXPECT_LT(found.last_crossed, 20u);
    EXPECT_EQ(found.crossing_again, 0u);
    EXPECT_GT(found.met, 20u);
}

/// Two cloths that are both held are not led apart; without gravity they stay as they are.
TEST(CrossedStartTest, WhatIsHeldIsNotLed) {
    SceneDescription scene = test::crossed(SolverMethod::line, 8);
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 10)};
    scene.cloths[1].pins = {test::pin_box(0, 0, 0, 0)};
    const Parted found = run(scene, 10);
    EXPECT_EQ(found.last_crossed, 10u);
    EXPECT_LT(found.fastest, 1e-4);
}

TEST(CrossedStartTest, ThoseThatOnlyTouchNeverMeet) {
    SceneDescription scene = test::crossed(SolverMethod::line, 8);
    scene.cloths[1].placement.origin[1] = 0.8;  // stands on the other one
    const SimulationModel model(scene);
    EXPECT_EQ(model.self_contact->crossed.size(), 1u);
    EXPECT_TRUE(model.self_contact->to_part.empty());
    EXPECT_EQ(model.self_contact->meetings, (std::vector<glsl::uint>{1, 0, 0, 1}));
}

/// Against extended precision, crossings are found, and what is found all but crosses.
TEST(CrossedStartTest, EdgesThatGoThroughTrianglesAreFound) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    const auto point = [&] { return glsl::vec3{anywhere(random), anywhere(random), anywhere(random)}; };
    const float doubt = 4e-6f;
    std::size_t crossing = 0, found_only = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const glsl::vec3 p = point(), q = point(), a = point(), b = point(), c = point();
        const glsl::vec3 area = glsl::ordered_cross(b - a, c - a);
        if (glsl::ordered_dot(area, area) < 0.1f) continue;  // a cell's triangles are not as thin
        const auto exactly = [](glsl::vec3 x) {
            return TriangleCrossings::Point{double(x.x), double(x.y), double(x.z)};
        };
        // The needle about the edge has two more edges, which cross nothing that the edge does not.
        TriangleCrossings::Point beside = exactly(q);
        beside[0] += 1e-9;
        const TriangleCrossings::Mesh needle{{exactly(p), exactly(q), beside}, {0, 1, 2}},
            triangle{{exactly(a), exactly(b), exactly(c)}, {0, 1, 2}};
        const bool crosses = TriangleCrossings({needle, triangle}).any(),
                   found = glsl::self_pierces(p, q, a, b, c, doubt);
        crossing += crosses ? 1 : 0;
        found_only += found && !crosses ? 1 : 0;
        EXPECT_TRUE(found || !crosses) << trial;
    }
    EXPECT_GT(crossing, 1000u);
    EXPECT_LT(found_only, 20u);
}

}  // namespace
}  // namespace drape
