// Coulomb friction on an incline and on a moving surface.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/twin.h"
#include "support/sheets.h"

namespace drape {
namespace {

constexpr double angle = 30.0 * M_PI / 180.0;

/// A sheet lying on a 30 degree incline that falls along -x, at rest; pair friction `mu`.
SceneDescription incline(double mu) {
    SceneDescription scene = test::sheet(5, 5, 0.4, 0.4, 16);
    scene.colliders.push_back({Plane{{-std::sin(angle), std::cos(angle), 0}, 0}, mu});
    Cloth& cloth = scene.cloths[0];
    cloth.friction = mu;
    cloth.thickness = 0.01;
    cloth.placement = {
        {-0.01 * std::sin(angle), 0.01 * std::cos(angle), 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, 1}};
    return scene;
}

/// Distance slid down the incline by the middle particle in one second.
double slide(double mu) {
    const SceneDescription scene = incline(mu);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    const glsl::vec4 start = model.cloths[0].position[12], end = twin.cloth(0)[Field::position][12];
    return -(double(end.x) - double(start.x)) * std::cos(angle) - (double(end.y) - double(start.y)) * std::sin(angle);
}

TEST(FrictionTest, SlidesDownAnInclineAsTheFormulaSays) {
    for (const double mu : {0.0, 0.1, 0.3, 0.5}) {
        const double expected = 0.5 * 9.81 * (std::sin(angle) - mu * std::cos(angle));
        const double slid = slide(mu);
        std::printf("[ measured ] mu %.1f: slid %.6f m, formula %.6f m\n", mu, slid, expected);
        EXPECT_NEAR(slid, expected, 1e-4 * 9.81) << "mu " << mu;
    }
}

TEST(FrictionTest, SticksExactlyWhenFrictionExceedsTheSlope) {
    for (const double mu : {0.578, 0.6, 1.0}) {  // tan 30 degrees = 0.5774
        const double slid = slide(mu);
        std::printf("[ measured ] mu %.3f: crept %.2e m\n", mu, slid);
        EXPECT_NEAR(slid, 0.0, 1e-6) << "mu " << mu;
    }
}

TEST(FrictionTest, ASurfaceThatMovesCarriesTheClothAlong) {
    SceneDescription scene = test::sheet(5, 5, 0.4, 0.4, 16);
    scene.time.frame_count = 61;
    Collider belt{Plane{}, 1};
    belt.path.keys = {{0, {0, 0, 0}, {}}, {1, {0.5, 0, 0}, {}}};
    scene.colliders.push_back(belt);
    Cloth& cloth = scene.cloths[0];
    cloth.friction = 1;
    cloth.placement = {{0, 0.005, 0}, {1, 0, 0}, {0, 0, 1}};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    for (std::size_t i = 0; i < 25; ++i)
        EXPECT_NEAR(double(twin.cloth(0)[Field::position][i].x) - double(model.cloths[0].position[i].x), 0.5, 2e-3);
}

}  // namespace
}  // namespace drape
