// Friction is Coulomb's on an incline, on a moving surface and around a bar.
#include <gtest/gtest.h>

#include <cmath>

#include "support/meshes.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double angle = 30.0 * M_PI / 180.0;

/// A sheet lies at rest on a 30 degree incline that falls along -x; the pair's friction is `mu`.
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

/// The same incline is the upper side of a box of triangles. The cloth is so thick that the box need not grow.
SceneDescription incline_of_triangles(double mu) {
    SceneDescription scene = incline(mu);
    scene.cloths[0].thickness *= 2;
    for (double& coordinate : scene.cloths[0].placement.origin) coordinate *= 2;
    constexpr double half = 0.25;
    Collider box{test::mesh_of(test::box_mesh({2.5, half, 0.6}), {half * std::sin(angle), -half * std::cos(angle), 0}),
                 mu};
    box.rotate = {0, 0, 30};
    scene.colliders = {box};
    return scene;
}

/// Distance slid down the incline by the middle particle in one second, or so many frames.
double slide(const SceneDescription& scene, std::uint32_t frames = 60) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    const glsl::vec4 start = model.cloths[0].position[12], end = twin.cloth(0)[Field::position][12];
    return -(double(end.x) - double(start.x)) * std::cos(angle) - (double(end.y) - double(start.y)) * std::sin(angle);
}

TEST(FrictionTest, SlidesDownAnInclineAsTheFormulaSays) {
    for (const double mu : {0.0, 0.1, 0.3, 0.5}) {
        const double expected = 0.5 * 9.81 * (std::sin(angle) - mu * std::cos(angle));
        const double slid = slide(incline(mu));
        std::printf("[ measured ] mu %.1f: slid %.6f m, formula %.6f m\n", mu, slid, expected);
        EXPECT_NEAR(slid, expected, 1e-4 * 9.81) << "mu " << mu;
    }
}

TEST(FrictionTest, SticksExactlyWhenFrictionExceedsTheSlope) {
    for (const double mu : {0.578, 0.6, 1.0}) {  // tan 30 degrees = 0.5774
        const double slid = slide(incline(mu));
        std::printf("[ measured ] mu %.3f: crept %.2e m\n", mu, slid);
        EXPECT_NEAR(slid, 0.0, 1e-6) << "mu " << mu;
    }
}

/// Rounding lets the cloth start a little in the box, so that friction holds it for a moment. What it slides beside
/// that tells the acceleration. Distances between samples are rounded by some 3e-8 m, a third of a percent of what
/// weight presses a particle in by in a substep, and where that is too deep friction takes its share of it.
TEST(FrictionTest, TrianglesRubAsTheFormulaSays) {
    for (const double mu : {0.0, 0.1, 0.3, 0.5}) {
        const double expected = 9.81 * (std::sin(angle) - mu * std::cos(angle));
        const SceneDescription scene = incline_of_triangles(mu);
        const double acceleration = 4 * (slide(scene) - 2 * slide(scene, 30));
        std::printf("[ measured ] mu %.1f: acceleration %.6f m/s2, formula %.6f m/s2\n", mu, acceleration, expected);
        EXPECT_NEAR(acceleration, expected, 1e-4 + 5e-3 * mu * 9.81 * std::cos(angle)) << "mu " << mu;
    }
    for (const double mu : {0.6, 1.0}) EXPECT_NEAR(slide(incline_of_triangles(mu)), 0, 1e-5) << "mu " << mu;
}

/// A row of cells is missing, so that the cloth is two pieces; a map gives each a friction of its own. The cloth's
/// coefficient is that of the collider, so a pair's is in proportion to the square root of the factor.
TEST(FrictionTest, AMapHoldsOnePieceAndLetsTheOtherSlide) {
    for (const double factor : {0.0, 0.25, 0.5}) {
        SceneDescription scene = incline(0.6);
        Cloth& cloth = scene.cloths[0];
        cloth.grid = {5, 8};
        cloth.size = {0.4, 0.7};
        cloth.holes = {{{0, 3}, {4, 4}}};
        cloth.particle_friction.assign(40, 1);
        std::fill_n(cloth.particle_friction.begin() + 20, 20, static_cast<float>(factor));
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
        const double expected = 0.5 * 9.81 * (std::sin(angle) - 0.6 * std::sqrt(factor) * std::cos(angle));
        for (std::size_t particle = 0; particle < 40; ++particle) {
            const glsl::vec4 start = model.cloths[0].position[particle], end = twin.cloth(0)[Field::position][particle];
            const double slid = -(double(end.x) - double(start.x)) * std::cos(angle) -
                                (double(end.y) - double(start.y)) * std::sin(angle);
            EXPECT_NEAR(slid, particle < 20 ? 0 : expected, particle < 20 ? 5e-6 : 1e-4 * 9.81)
                << "factor " << factor << " particle " << particle;
        }
    }
}

/// The same two pieces lie on a sheet that is held instead of a plane.
TEST(FrictionTest, AMapHoldsOnePieceOnAClothAndLetsTheOtherSlide) {
    SceneDescription scene = incline(0.8);
    scene.colliders.clear();
    Cloth& upper = scene.cloths[0];
    upper.grid = {5, 8};
    upper.size = {0.4, 0.7};
    upper.holes = {{{0, 3}, {4, 4}}};
    upper.particle_friction.assign(40, 1);
    std::fill_n(upper.particle_friction.begin() + 20, 20, 0.0f);
    upper.self_collision = SelfCollision{0.01, {}};
    Cloth lower = test::sheet(13, 9, 1.2, 0.8, 16).cloths[0];
    lower.name = "lower";
    lower.friction = 0.8;
    lower.thickness = 0.01;
    lower.placement = upper.placement;
    lower.placement.origin = {-0.77 * std::cos(angle), -0.77 * std::sin(angle), -0.05};
    lower.pins = {test::pin_box(0, 0, 12, 8)};
    scene.cloths.push_back(lower);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 15; ++frame) twin.run_frame(frame);
    const double expected = 0.5 * 9.81 * std::sin(angle) * 0.25 * 0.25;
    for (std::size_t particle = 0; particle < 40; ++particle) {
        const glsl::vec4 start = model.cloths[0].position[particle], end = twin.cloth(0)[Field::position][particle];
        const double slid =
            -(double(end.x) - double(start.x)) * std::cos(angle) - (double(end.y) - double(start.y)) * std::sin(angle);
        EXPECT_NEAR(slid, particle < 20 ? 0 : expected, 1e-3) << "particle " << particle;
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

/// A strip over a bar hangs to unequal lengths, held on top until it hangs still, then by friction alone.
struct Capstan {
    static constexpr std::uint32_t rows = 65, held_row = 13;
    static constexpr double length = 1.6, spacing = length / (rows - 1), radius = 0.1025;  ///< bar and cloth together
    static constexpr double arc = M_PI * radius;
    static constexpr double shorter = held_row * spacing - arc / 2, longer = length - held_row * spacing - arc / 2;

    /// Tension where the strip leaves the bar on the longer side, over weight per length, when it is about to slide
    /// there, by Euler's and Eytelwein's equation with the weight on the bar, dT/dt = mu (T + r sin t) + r cos t.
    static double bearable(double mu) {
        constexpr int parts = 20000;
        constexpr double step = M_PI / parts;
        double tension = shorter;
        for (int k = 0; k < parts; ++k) {
            const double t = (k + 0.5) * step;
            tension += step * (mu * (tension + radius * std::sin(t)) + radius * std::cos(t));
        }
        return tension;
    }

    /// The coefficient at which it just holds.
    static double critical() {
        double low = 0, high = 3;
        for (int k = 0; k < 60; ++k) (bearable(0.5 * (low + high)) < longer ? low : high) = 0.5 * (low + high);
        return low;
    }

    static SceneDescription scene(double mu) {
        SceneDescription scene;
        Cloth& strip = scene.cloths.emplace_back();
        strip.grid = {3, rows};
        strip.size = {2 * spacing, length};
        strip.placement = {{-spacing * held_row, radius, -spacing}, {0, 0, 1}, {1, 0, 0}};
        strip.stiffness = {false, 2000, 200, 1e-5};
        strip.damping = 2;
        strip.friction = mu;
        strip.thickness = 0.0025;
        Pin& held = strip.pins.emplace_back();
        held.particles = {{0, held_row}, {2, held_row}};
        held.release = 6;
        scene.colliders.push_back({Capsule{{0, 0, -0.3}, {0, 0, 0.3}, {0.1, 0.1}}, mu});
        scene.solver.method = SolverMethod::line;
        scene.solver.substeps = 12;
        return scene;
    }

    /// Returns how far the longer end has sunk `seconds` after the release.
    static double sunk(double mu, double seconds) {
        const SimulationModel model(scene(mu));
        Twin twin(model);
        const auto frames = [](double time) { return static_cast<std::uint32_t>(std::lround(60 * time)); };
        std::uint32_t frame = 1;
        for (; frame <= frames(6); ++frame) twin.run_frame(frame);
        const std::size_t end = 3 * rows - 2;
        const double before = double(twin.cloth(0)[Field::position][end].y);
        for (; frame <= frames(6 + seconds); ++frame) twin.run_frame(frame);
        return before - double(twin.cloth(0)[Field::position][end].y);
    }
};

TEST(FrictionTest, AStripOverABarHoldsForAMinuteAboveTheCapstanCoefficientAndSlidesBelow) {
    const double critical = Capstan::critical();
    const double held = Capstan::sunk(1.05 * critical, 60), slid = Capstan::sunk(0.95 * critical, 2);
    std::printf("[ measured ] capstan coefficient %.4f: sunk %.2e m in 60 s at 1.05 of it, %.3f m in 2 s at 0.95\n",
                critical, held, slid);
    EXPECT_NEAR(held, 0, 5e-4);
    EXPECT_GT(slid, 0.1);
}

}  // namespace
}  // namespace drape
