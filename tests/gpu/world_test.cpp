// A scene with z up is the scene with y up, turned: in what comes out of it, and in its pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drape/simulation.h"
#include "library_device.h"
#include "picture/fixtures.h"
#include "picture/framing.h"
#include "scene_files.h"
#include "world/up.h"

namespace drape {
namespace {

using test::library_device;
using WorldTest = test::LibraryTest;

void turn(Vec3& v) { v = in_world(Up::z, v); }

/// Turns angles about one axis: those about y become ones about z, those about z become ones about -y.
void turn_angles(Vec3& degrees) {
    const auto zeros = std::ranges::count(degrees, 0);
    if (zeros < 2) throw std::logic_error("angles about several axes do not turn component by component");
    turn(degrees);
}

void turn(MotionPath& path) {
    for (MotionKey& key : path.keys) {
        turn(key.translate);
        turn_angles(key.rotate);
    }
}

void turn_extents(Vec3& extents) { std::swap(extents[1], extents[2]); }

struct TurnShape {
    void operator()(Plane& plane) const { turn(plane.normal); }
    void operator()(Sphere& sphere) const { turn(sphere.center); }
    void operator()(Box& box) const { turn(box.center), turn_extents(box.half_extents); }
    void operator()(Ellipsoid& ellipsoid) const { turn(ellipsoid.center), turn_extents(ellipsoid.radii); }
    void operator()(Capsule& capsule) const { turn(capsule.from), turn(capsule.to); }
    void operator()(Mesh&) const { ADD_FAILURE() << "the triangles of a file are not turned"; }
};

/// Returns the same scene in a world with z up.
SceneDescription turned(SceneDescription scene) {
    scene.up = Up::z;
    turn(scene.gravity);
    turn(scene.wind.velocity);
    for (Cloth& cloth : scene.cloths) {
        for (Vec3* v : {&cloth.placement.origin, &cloth.placement.u, &cloth.placement.v, &cloth.velocity}) turn(*v);
        for (Pin& pin : cloth.pins) {
            turn(pin.path);
            if (pin.pivot) turn(*pin.pivot);
        }
    }
    for (Collider& collider : scene.colliders) {
        std::visit(TurnShape(), collider.shape);
        turn_angles(collider.rotate);
        turn(collider.path);
    }
    for (DirectionalLight& light : scene.lights) turn(light.direction);
    for (Cutter& cutter : scene.cutters) {
        for (Vec3& corner : cutter.triangle) turn(corner);
        turn(cutter.path);
    }
    if (scene.camera) turn(scene.camera->position), turn(scene.camera->target);
    return scene;
}

struct LastFrame {
    std::vector<std::uint8_t> rgba;
    std::vector<std::vector<float>> positions;
    std::vector<ClothStatistics> statistics;
};

LastFrame last_frame(const SceneDescription& scene, std::uint32_t frames) {
    SimulationOptions options;
    options.draw = true;
    options.positions = true;
    Simulation simulation(scene, options, library_device());
    for (std::uint32_t frame = 0; frame < frames; ++frame) EXPECT_TRUE(simulation.step());
    const FinishedFrame& last = simulation.frame();
    LastFrame result{{last.rgba.begin(), last.rgba.end()}, {}, last.statistics};
    for (const auto& cloth : last.positions) result.positions.emplace_back(cloth.begin(), cloth.end());
    return result;
}

/// Returns the peak signal-to-noise ratio of two pictures, dB.
double likeness(const LastFrame& one, const LastFrame& other) {
    double squares = 0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i) squares += std::pow(double(one.rgba[i]) - other.rgba[i], 2);
    return squares > 0 ? 10 * std::log10(255.0 * 255.0 * static_cast<double>(one.rgba.size()) / squares) : INFINITY;
}

/// Returns the largest distance of a particle from its twin in the other world, m.
double farthest(const LastFrame& one, const LastFrame& other) {
    double most = 0;
    for (std::size_t cloth = 0; cloth < one.positions.size(); ++cloth)
        for (std::size_t i = 0; i < one.positions[cloth].size(); i += 4) {
            const float *x = &one.positions[cloth][i], *y = &other.positions[cloth][i];
            const Vec3 there = in_world(Up::z, {x[0], x[1], x[2]});
            most = std::max(most, std::hypot(there[0] - y[0], there[1] - y[1], there[2] - y[2]));
        }
    return most;
}

/// Lights and ambient, floor, fixtures, wind, colliders that turn; with the scene's camera and with one that is found.
/// A flag buckles from rounding, which differs: it is compared before.
TEST_F(WorldTest, WithZUpShippedScenesAreThemselvesTurned) {
    for (const auto& [name, steps] :
         {std::pair{"flag", 4u}, {"four_colliders", 13u}, {"curtain", 13u}, {"cloth_on_sphere", 13u}})
        for (const bool has_camera : {true, false}) {
            SceneDescription scene = test::shipped_scene(name);
            scene.image.size = {320, 180};
            scene.solver.method = SolverMethod::line;
            scene.solver.substeps = 8;
            if (!has_camera) scene.camera.reset();
            const std::uint32_t frames = has_camera ? steps : 1;
            const LastFrame one = last_frame(scene, frames), other = last_frame(turned(scene), frames);
            std::printf("[ measured ] %s, frame %u: %.1f dB alike, %.1e m apart\n", name, frames - 1,
                        likeness(one, other), farthest(one, other));
            EXPECT_GT(likeness(one, other), 45) << name;
            EXPECT_LT(farthest(one, other), 1e-5) << name;
            EXPECT_NEAR(one.statistics[0].potential_energy, other.statistics[0].potential_energy, 1e-4);
            // The world counts: with its coordinates in a world with y up the scene lies on its side.
            SceneDescription on_its_side = turned(scene);
            on_its_side.up = Up::y;
            EXPECT_LT(likeness(one, last_frame(on_its_side, 1)), 30) << name;
        }
}

TEST_F(WorldTest, ItsCameraAndFixturesAreTurned) {
    for (const std::string& name : test::shipped_scene_names()) {
        SceneDescription scene = test::shipped_scene(name);
        // Numbers that are turned do not turn the triangles of a file.
        if (std::ranges::any_of(scene.colliders,
                                [](const Collider& each) { return std::holds_alternative<Mesh>(each.shape); }))
            continue;
        scene.camera.reset();
        for (Collider& collider : scene.colliders) collider.rotate = {}, collider.path = {};
        for (Cloth& cloth : scene.cloths)
            for (Pin& pin : cloth.pins)
                for (MotionKey& key : pin.path.keys) key.rotate = {};
        const SceneDescription other = turned(scene);
        const Camera y = picture_camera(scene, 640, 360), z = picture_camera(other, 640, 360);
        EXPECT_EQ(z.up, (Vec3{0, 0, 1}));
        const std::vector<Fixture> upright = fixtures(scene), found = fixtures(other);
        ASSERT_EQ(found.size(), upright.size()) << name;
        const auto expect_turned = [&](const Vec3& one, const Vec3& there) {
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(in_world(Up::z, one)[k], there[k], 1e-9) << name;
        };
        expect_turned(y.position, z.position);
        expect_turned(y.target, z.target);
        for (std::size_t i = 0; i < found.size(); ++i) {
            expect_turned(upright[i].from, found[i].from);
            expect_turned(upright[i].to, found[i].to);
        }
    }
}

}  // namespace
}  // namespace drape
