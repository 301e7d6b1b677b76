// Friction is Coulomb's at any number of substeps: by closed forms, on every kind of collider, by every method.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/every_kind.h"
#include "support/meshes.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double coulomb_g = 9.81, slope = 25 * M_PI / 180;
constexpr std::uint32_t all_substeps[] = {1, 8, 64, 256, 4096};
constexpr SolverMethod named_methods[] = {SolverMethod::relax, SolverMethod::line, SolverMethod::explicit_steps};

const Vec3 downhill{-std::cos(slope), -std::sin(slope), 0}, uphill_normal{-std::sin(slope), std::cos(slope), 0};

/// A small sheet lies on a surface that falls by `slope` along -x, at the origin.
SceneDescription on_slope(const Collider& collider, double mu, SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::sheet(3, 3, 0.004, 0.004, substeps);
    scene.time.frame_count = 61;
    scene.solver.method = method;
    scene.colliders = {collider};
    scene.colliders[0].friction = mu;
    Cloth& cloth = scene.cloths[0];
    cloth.contact = ContactOf::particles;
    cloth.friction = mu;
    cloth.thickness = 0.005;
    cloth.areal_density = 1;
    cloth.stiffness = {false, 20, 2, 0};
    cloth.placement = {
        {0.002 * downhill[0] + 0.005 * uphill_normal[0], 0.002 * downhill[1] + 0.005 * uphill_normal[1], -0.002},
        {-downhill[0], -downhill[1], 0},
        {0, 0, 1}};
    return scene;
}

/// Returns how far the middle particle has moved after so many frames.
Vec3 moved_in(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    const glsl::vec4 start = model.cloths[0].position[model.cloths[0].position.size() / 2];
    const Vec3 end = test::position_of(twin.cloth(0), model.cloths[0].position.size() / 2);
    return {end[0] - double(start.x), end[1] - double(start.y), end[2] - double(start.z)};
}

double along(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Surfaces with a straight way down through the origin, 2 m long.
std::vector<ColliderShape> slopes() {
    const auto below = [](double depth) { return Vec3{-depth * uphill_normal[0], -depth * uphill_normal[1], 0}; };
    const Vec3 axis = below(0.5), from{axis[0] - 2 * downhill[0], axis[1] - 2 * downhill[1], 0},
               to{axis[0] + 2 * downhill[0], axis[1] + 2 * downhill[1], 0};
    return test::of_every_kind<Sphere, Ellipsoid>(Plane{uphill_normal, 0}, Box{below(0.25), {2, 0.25, 0.6}},
                                                  Capsule{from, to, {0.5, 0.5}},
                                                  test::mesh_of(test::box_mesh({2.5, 0.25, 0.6}), below(0.25)));
}

Collider turned(const ColliderShape& shape) {
    const bool by_angle = std::holds_alternative<Box>(shape) || std::holds_alternative<Mesh>(shape);
    return {shape, 0.3, {0, 0, by_angle ? 25.0 : 0.0}};
}

/// What is left to the start, m: beside a capsule's crest the sheet starts 4 um above it and falls, off balance.
double start_costs(const ColliderShape& shape) { return std::holds_alternative<Capsule>(shape) ? 1e-5 : 3e-7; }

/// Frames that so many substeps may cost.
std::uint32_t frames_for(std::uint32_t substeps) { return substeps > 1000 ? 8 : substeps > 200 ? 24 : 60; }

TEST(CoulombTest, SlidesByTheLawAtAnyNumberOfSubsteps) {
    for (const ColliderShape& shape : slopes())
        for (const SolverMethod method : named_methods)
            for (const std::uint32_t substeps : all_substeps) {
                const std::uint32_t frames = frames_for(substeps);
                const double t = frames / 60.0, mu = 0.3,
                             law = 0.5 * coulomb_g * t * t * (std::sin(slope) - mu * std::cos(slope));
                const double slid = along(moved_in(on_slope(turned(shape), mu, method, substeps), frames), downhill);
                std::printf("[ measured ] kind %zu, method %d, %u substeps: %.7f m, law %.7f, off by %.1e of it\n",
                            shape.index(), static_cast<int>(method), substeps, slid, law, slid / law - 1);
                EXPECT_NEAR(slid, law, 1e-5 * law + start_costs(shape))
                    << "kind " << shape.index() << ", method " << static_cast<int>(method) << ", " << substeps;
            }
}

TEST(CoulombTest, SticksAtAnyNumberOfSubsteps) {
    for (const ColliderShape& shape : slopes())
        for (const SolverMethod method : named_methods)
            for (const std::uint32_t substeps : {1u, 64u, 2048u})
                for (const double mu : {0.47, 1.0}) {  // tan 25 degrees = 0.4663
                    const double crept =
                        along(moved_in(on_slope(turned(shape), mu, method, substeps), frames_for(substeps)), downhill);
                    EXPECT_NEAR(crept, 0, 3 * start_costs(shape))
                        << "kind " << shape.index() << ", method " << static_cast<int>(method) << ", " << substeps
                        << " substeps, friction " << mu;
                }
}

/// Returns the angle by which a point slides down a ball in a time from the slope on: dv/dt = g sin a - mu (g cos a -
/// v^2/R).
double slid_down_a_ball(double radius, double mu, double time) {
    constexpr int parts = 100000;
    const double dt = time / parts;
    double angle = slope, speed = 0;
    for (int k = 0; k < parts; ++k) {
        const double pull = coulomb_g * std::sin(angle) - mu * (coulomb_g * std::cos(angle) - speed * speed / radius);
        angle += dt / radius * (speed + 0.5 * dt * pull);
        speed += dt * pull;
    }
    return angle - slope;
}

TEST(CoulombTest, SlidesDownABallByItsEquation) {
    constexpr double mu = 0.3;
    const Vec3 center{-uphill_normal[0], -uphill_normal[1], 0};
    for (const ColliderShape& shape : {ColliderShape(Sphere{center, 1}), ColliderShape(Ellipsoid{center, {1, 1, 1}})})
        for (const SolverMethod method : named_methods)
            for (const std::uint32_t substeps : {8u, 64u, 512u}) {
                const double law = slid_down_a_ball(1.005, mu, 0.5);
                const Vec3 end = moved_in(on_slope({shape, mu}, mu, method, substeps), 30);
                const double x = end[0] + 0.005 * uphill_normal[0] - center[0],
                             y = end[1] + 0.005 * uphill_normal[1] - center[1];
                const double turn = std::atan2(-x, y) - slope;
                std::printf("[ measured ] kind %zu, method %d, %u substeps: %.6f rad, law %.6f, off by %.1e of it\n",
                            shape.index(), static_cast<int>(method), substeps, turn, law, turn / law - 1);
                EXPECT_NEAR(turn, law, (2e-4 + 0.03 / substeps) * law) << substeps;
            }
}

/// What slides on a floor stops after v^2/(2 mu g), and a belt that rushes on beneath it takes it along by mu g.
TEST(CoulombTest, AFloorStopsAndABeltTakesAlong) {
    constexpr double mu = 0.2, speed = 0.25;
    for (const bool belt : {true, false})
        for (const SolverMethod method : named_methods)
            for (const std::uint32_t substeps : all_substeps) {
                SceneDescription scene = on_slope({Plane{}}, mu, method, substeps);
                scene.cloths[0].placement = {{-0.002, 0.005, -0.002}, {1, 0, 0}, {0, 0, 1}};
                if (belt)
                    scene.colliders[0].path.keys = {{0, {0, 0, 0}, {}}, {2, {50, 0, 0}, {}}};
                else
                    scene.cloths[0].velocity = {speed, 0, 0};
                constexpr double time = 10 / 60.0;  // it has come to rest on the floor
                const double moved = moved_in(scene, 10)[0],
                             law = belt ? 0.5 * mu * coulomb_g * time * time : speed * speed / (2 * mu * coulomb_g);
                std::printf("[ measured ] %s, method %d, %u substeps: %.7f m, law %.7f\n", belt ? "belt" : "floor",
                            static_cast<int>(method), substeps, moved, law);
                // The substep in which it stops takes all of what is left: less than what it would slide in that.
                const double h = 1.0 / (60 * substeps);
                EXPECT_NEAR(moved, law,
                            (substeps > 1000 ? 1e-3 : 1e-5) * law + (belt ? 0 : mu * coulomb_g * h * h) + 1e-6)
                    << substeps;
            }
}

/// The same on a sheet of cloth that is held.
TEST(CoulombTest, ClothSlidesOnClothByTheLaw) {
    for (const double mu : {0.3, 0.6})
        for (const SolverMethod method : named_methods)
            for (const std::uint32_t substeps : {8u, 64u, 256u}) {
                SceneDescription scene = on_slope({Plane{}}, mu, method, substeps);
                scene.colliders.clear();
                Cloth& upper = scene.cloths[0];
                upper.size = {0.1, 0.1};
                upper.self_collision = SelfCollision{};
                upper.placement.origin = {0.05 * downhill[0], 0.05 * downhill[1], -0.05};
                Cloth lower = upper;
                lower.name = "lower";
                lower.grid = {7, 5};
                lower.size = {0.3, 0.2};
                lower.placement.origin = {0.2 * downhill[0] - 0.005 * uphill_normal[0],
                                          0.2 * downhill[1] - 0.005 * uphill_normal[1], -0.1};
                lower.pins = {test::pin_box(0, 0, 6, 4)};
                scene.cloths.push_back(lower);
                constexpr std::uint32_t frames = 10;
                const double t = frames / 60.0,
                             law = std::max(0.0, 0.5 * coulomb_g * t * t * (std::sin(slope) - mu * std::cos(slope)));
                const double slid = along(moved_in(scene, frames), downhill);
                std::printf("[ measured ] on cloth, mu %.1f, method %d, %u substeps: %.7f m, law %.7f\n", mu,
                            static_cast<int>(method), substeps, slid, law);
                // It begins with sinking into what a pair may lack of its thickness.
                EXPECT_NEAR(slid, law, 0.015 * law + 1e-6) << substeps;
            }
}

}  // namespace
}  // namespace drape
