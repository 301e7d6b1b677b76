#include <gtest/gtest.h>

#include <cmath>

#include "support/sheets.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

using namespace glsl;

TEST(SpringTest, EqualMassesShareTheCorrection) {
    const SpringResult result = project_spring({2, 0, 0}, 2.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f);
    EXPECT_FLOAT_EQ(result.correction.x, -0.5f);  // second moves back by half, first forward by half
    const SpringResult squeezed = project_spring({0, 0.5f, 0}, 2.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f);
    EXPECT_FLOAT_EQ(squeezed.correction.y, 0.25f);
}

TEST(SpringTest, AFreeEndNextToAFixedOneTakesAllOfTheCorrection) {
    for (const float weight : {1.0f, 2.0f, 4.0f}) {
        const SpringResult result = project_spring({2, 0, 0}, weight, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f);
        EXPECT_FLOAT_EQ(weight * result.correction.x, -1.0f);
    }
}

TEST(SpringTest, LeavesAloneWhatHasNoDirectionOrNoFreeEnd) {
    for (const SpringResult& result : {project_spring({0, 0, 0}, 2.0f, 1.0f, 1.0f, 1.0f, 0.1f, 0.0f),
                                       project_spring({2, 0, 0}, 0.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f),
                                       project_spring({2, 0, 0}, 2.0f, 1.0f, 0.0f, 1.0f, 0.0f, 0.0f)}) {
        EXPECT_EQ(result.correction.x, 0.0f);
        EXPECT_EQ(result.tension, 0.0f);
    }
}

TEST(SpringTest, ComplianceConvergesToTheForceBalanceOfXpbd) {
    // The iterated tension is that of the extension C: the spring's own force, whatever the iteration count.
    const float compliance = 0.7f;
    vec3 edge{1.5f, 0, 0};
    float tension = 0;
    for (int iteration = 0; iteration < 60; ++iteration) {
        const SpringResult result = project_spring(edge, 2.0f, 1.0f, 1.0f, 1.0f, compliance, tension);
        edge = edge + result.correction * 2.0f;
        tension = result.tension;
    }
    const double strain = 0.5 * 0.7 / (2.0 + 0.7);  // C = a lambda and C = 0.5 - 2 lambda
    EXPECT_NEAR(double(edge.x) - 1.0, strain, 1e-6);
    EXPECT_NEAR(double(tension), strain, 1e-6);
}

TEST(SpringTest, TheOscillatorOfTheXpbdPaperHasItsPeriod) {
    // Two particles, one fixed, x0 = 1.5, rest 1, alpha = 1e-3, m = 1 (docs/physics.md 7) have the period 0.198692 s.
    const double h = 1e-5;
    const float compliance = static_cast<float>(1e-3 / (h * h));
    vec3 displacement{0, 0, 0};
    double x = 1.5, last = 0.5, crossing[2] = {0, 0};
    int crossings = 0;
    for (int step = 1; crossings < 2; ++step) {
        const vec3 edge{static_cast<float>(x) + displacement.x, 0, 0};
        displacement.x += project_spring(edge, 1.0f, 1.0f, 1.0f, 1.0f, compliance, 0.0f).correction.x;
        x += double(displacement.x);
        if (last > 0 && x - 1 <= 0) crossing[crossings++] = step * h;
        last = x - 1;
        ASSERT_LT(step, 100000);
    }
    EXPECT_NEAR(crossing[1] - crossing[0], 0.198692, 2e-3 * 0.198692);
}

TEST(SpringTest, MomentumIsKeptWithoutPinsAndGravity) {
    SceneDescription scene = test::sheet(9, 7, 0.8, 0.6, 10);
    scene.gravity = {0, 0, 0};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::size_t i = 0; i < 63; ++i) {  // stretched at the start
        twin.cloth(0)[Field::position][i].x *= 1.3f;
        twin.cloth(0)[Field::position][i].y *= 0.8f;
    }
    const auto momentum = [&](bool absolute) {
        Vec3 sum{};
        for (std::size_t i = 0; i < 63; ++i) {
            const glsl::vec4 d = twin.cloth(0)[Field::displacement][i];
            const double mass = 1 / double(twin.cloth(0)[Field::position][i].w);
            const double c[3] = {double(d.x), double(d.y), double(d.z)};
            for (std::size_t k = 0; k < 3; ++k) sum[k] += mass * (absolute ? std::abs(c[k]) : c[k]);
        }
        return sum;
    };
    for (std::uint32_t frame = 1; frame <= 20; ++frame) twin.run_frame(frame);
    const Vec3 net = momentum(false), moving = momentum(true);
    EXPECT_GT(moving[0], 1e-4) << "the sheet should swing";
    for (std::size_t k = 0; k < 2; ++k) EXPECT_LE(std::abs(net[k]), 1e-6 * moving[k] * 200);
}

}  // namespace
}  // namespace drape
