// Particles, edges and triangles do not penetrate any collider kind: at rest, moving, rotated, overlapping.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "cloth/frame_inputs.h"
#include "support/every_kind.h"
#include "support/meshes.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/kernels.h"
#include "twin/twin.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

Vec3 point(const glsl::vec4& v) { return {double(v.x), double(v.y), double(v.z)}; }

Vec3 mean(std::initializer_list<Vec3> points) {
    Vec3 sum{};
    for (const Vec3& p : points)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k] / static_cast<double>(points.size());
    return sum;
}

struct Depths {
    double particles = 0, edges = 0, triangles = 0;  ///< deepest penetration, m; never inside where below zero
    bool touched = false;
};

/// Drops a horizontal sheet onto the colliders and measures against double precision every frame.
Depths drop(const std::vector<Collider>& colliders, const std::function<void(SceneDescription&)>& change = {}) {
    SceneDescription scene = test::sheet(33, 33, 1.6, 1.6, 12);
    scene.time.frame_count = 121;
    scene.colliders = colliders;
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.8, 0.9, -0.8}, {1, 0, 0}, {0, 0, 1}};
    cloth.thickness = 0;
    cloth.contact = ContactOf::particles;
    cloth.damping = 0.5;
    if (change) change(scene);
    const SimulationModel model(scene);
    Twin twin(model);
    Depths deepest{-1e300, -1e300, -1e300};
    const Grid& grid = model.cloths[0].grid;
    for (std::uint32_t frame = 1; frame <= 120; ++frame) {
        twin.run_frame(frame);
        const double time = frame / 60.0;
        const auto depth = [&](const Vec3& x) { return -exact::surface_distance(scene.colliders, time, x); };
        const std::vector<glsl::vec4>& x = twin.cloth(0)[Field::position];
        for (const glsl::vec4& p : x) {
            const double d = depth(point(p)) + cloth.thickness;
            deepest.particles = std::max(deepest.particles, d);
            deepest.touched = deepest.touched || d > -1e-5;
        }
        if (frame % 20 != 0) continue;
        const std::vector<std::uint32_t> triangles = grid.triangle_indices();
        for (std::size_t k = 0; k < triangles.size(); k += 3) {
            const Vec3 a = point(x[triangles[k]]), b = point(x[triangles[k + 1]]), c = point(x[triangles[k + 2]]);
            deepest.edges = std::max({deepest.edges, depth(mean({a, b})), depth(mean({b, c})), depth(mean({c, a}))});
            deepest.triangles = std::max(deepest.triangles, depth(mean({a, b, c})));
        }
    }
    return deepest;
}

/// `size`: of the collider; `radius`: least radius of curvature, 0 for a flat or sharp one, without a sagitta.
void expect_contact(const char* what, const Depths& depths, double size, double radius) {
    const double diagonal = 1.6 / 32 * std::sqrt(2.0) * 1.1;  // cell diagonal, stretched by a tenth
    const double sagitta = radius > 0 ? diagonal * diagonal / (8 * radius) : 0;
    std::printf("[ measured ] %s: particles %.2e m deep (%.1e of the size), edges %.2e, triangles %.2e, sagitta %.2e\n",
                what, depths.particles, depths.particles / size, depths.edges, depths.triangles, sagitta);
    EXPECT_TRUE(depths.touched) << what << ": the cloth must reach the collider";
    EXPECT_LE(depths.particles, 1e-5 * size) << what;
    if (radius > 0) {
        EXPECT_LE(depths.edges, sagitta) << what;
        EXPECT_LE(depths.triangles, sagitta) << what;
    }
}

const Collider one_sphere{Sphere{{0, 0.3, 0}, 0.5}};
const Collider one_ellipsoid{Ellipsoid{{0, 0.3, 0}, {0.6, 0.4, 0.3}}, 0.3, {20, 30, 40}};
const Collider one_box{Box{{0, 0.3, 0}, {0.4, 0.3, 0.3}}, 0.3, {10, 25, 15}};

const MotionPath moving{
    {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.2, 0.1, -0.1}, {30, 200, -40}}, {2, {0, 0.2, 0.1}, {0, 360, 0}}}};

Collider with_path(Collider collider, const MotionPath& path) {
    collider.path = path;
    return collider;
}

TEST(ContactTest, Plane) {
    const Collider plane{Plane{{0.2 / std::hypot(0.2, 1), 1 / std::hypot(0.2, 1), 0}, 0.1}};
    expect_contact("plane", drop({plane}), 1.0, 0);
    const MotionPath tilting{{{0, {0, 0, 0}, {0, 0, 0}}, {2, {0, 0.4, 0}, {10, 0, 15}}}};
    expect_contact("moving plane", drop({with_path(plane, tilting)}), 1.0, 0);
}

TEST(ContactTest, Sphere) {
    expect_contact("sphere", drop({one_sphere}), 0.5, 0.5);
    expect_contact("moving sphere", drop({with_path(one_sphere, moving)}), 0.5, 0.5);
}

TEST(ContactTest, Box) {
    expect_contact("box", drop({one_box}), 0.4, 0);
    expect_contact("moving box", drop({with_path(one_box, moving)}), 0.4, 0);
}

TEST(ContactTest, OutOfABoxLeadsTheNearestFace) {
    const glsl::vec3 half{0.4f, 0.3f, 0.2f};
    const auto way_out = [&](float x, float y, float z) {
        const glsl::SurfacePoint point = glsl::box_surface({x, y, z}, half);
        return std::array{point.normal.x, point.normal.y, point.normal.z, point.distance};
    };
    EXPECT_EQ(way_out(0.375f, 0, 0), (std::array{1.0f, 0.0f, 0.0f, 0.375f - 0.4f}));
    EXPECT_EQ(way_out(0, -0.25f, 0.125f), (std::array{0.0f, -1.0f, 0.0f, 0.25f - 0.3f}));
    EXPECT_EQ(way_out(0.125f, 0.125f, -0.125f), (std::array{0.0f, 0.0f, -1.0f, 0.125f - 0.2f}));
}

TEST(ContactTest, Ellipsoid) {
    const double curvature = 0.3 * 0.3 / 0.6;
    expect_contact("ellipsoid", drop({one_ellipsoid}), 0.6, curvature);
    expect_contact("moving ellipsoid", drop({with_path(one_ellipsoid, moving)}), 0.6, curvature);
}

TEST(ContactTest, Capsule) {
    const Collider rod{Capsule{{-0.4, 0.3, 0.1}, {0.4, 0.3, -0.1}, {0.25, 0.25}}};
    expect_contact("capsule", drop({rod}), 0.25, 0.25);
    expect_contact("moving capsule", drop({with_path(rod, moving)}), 0.25, 0.25);
    const Collider tapered{Capsule{{-0.4, 0.2, 0}, {0.35, 0.4, 0.1}, {0.35, 0.2}}, 0.3, {20, 30, 40}};
    expect_contact("turned, tapered capsule", drop({tapered}), 0.2, 0.2);
    expect_contact("moving, turned, tapered capsule", drop({with_path(tapered, moving)}), 0.2, 0.2);
    const Collider ball{Capsule{{0, 0.3, 0}, {0.1, 0.35, 0}, {0.4, 0.1}}};
    expect_contact("capsule whose one end holds the other", drop({ball}), 0.4, 0.4);
}

TEST(ContactTest, OverlappingColliders) {
    const Collider second{Sphere{{0.45, 0.35, 0.1}, 0.4}};
    expect_contact("two overlapping spheres", drop({one_sphere, second}), 0.5, 0);

    const Collider rod{Capsule{{-0.5, 0.3, 0.2}, {0.5, 0.35, -0.2}, {0.3, 0.15}}, 0.3, {0, 0, 10}};
    const MotionPath turning{{{0, {0, 0, 0}, {0, 0, 0}}, {2, {0, 0.15, 0}, {0, -15, 0}}}};  // opens the cross
    const Collider across{Capsule{{-0.1, 0.2, -0.5}, {0.1, 0.3, 0.5}, {0.2, 0.25}}};
    expect_contact("two crossing capsules, one moving", drop({with_path(rod, turning), across}), 0.15, 0);

    Collider box = with_path(one_box, moving);
    std::get<Box>(box.shape).center = {0.3, 0.3, 0.2};
    expect_contact("box, ellipsoid and plane overlapping, box moving", drop({one_ellipsoid, box, {Plane{}}}), 0.6, 0);
}

TEST(ContactTest, ThicknessKeepsItsDistance) {
    const Depths depths = drop({one_sphere}, [](SceneDescription& scene) { scene.cloths[0].thickness = 0.02; });
    EXPECT_TRUE(depths.touched);
    EXPECT_LE(depths.particles, 1e-5 * 0.5);
    EXPECT_LE(depths.edges, 0.0) << "thickness covers the sagitta";
}

/// Fastest particle (m/s) and deepest (m, into the collider) at each frame's end of a weightless sheet that starts
/// across it, 0.1 m above the origin.
struct Leaving {
    std::vector<double> speed, depth;
};

Leaving leave(const Collider& collider, SolverMethod method, std::uint32_t frames,
              ContactOf contact = ContactOf::particles) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, 20);
    scene.time.frame_count = frames + 1;
    scene.gravity = {0, 0, 0};
    scene.solver.method = method;
    scene.cloths[0].contact = contact;
    scene.cloths[0].placement = {{-0.5, 0.1, -0.5}, {1, 0, 0}, {0, 0, 1}};
    scene.cloths[0].stiffness.stretch = 200;
    scene.cloths[0].stiffness.shear = 20;
    scene.colliders = {collider};
    const SimulationModel model(scene);
    Twin twin(model);
    Leaving seen;
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        twin.run_frame(frame);
        double speed = 0, depth = 0;
        for (std::size_t i = 0; i < model.cloths[0].position.size(); ++i) {
            const Vec3 d = test::displacement_of(twin.cloth(0), i);
            speed = std::max(speed, std::hypot(d[0], d[1], d[2]) / model.cloths[0].substep_length);
            depth = std::max(depth, -exact::surface_distance(scene.colliders, 0, test::position_of(twin.cloth(0), i)));
        }
        seen.speed.push_back(speed);
        seen.depth.push_back(depth);
    }
    return seen;
}

TEST(ContactTest, AnOverlapAtTheStartDoesNotBecomeSpeed) {
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        const Leaving seen = leave({Sphere{{0, 0, 0}, 0.2}}, method, 150);
        std::printf(
            "[ measured ] %s: from 0.1 m inside a ball, at most %.2f m/s; %.1e m deep after a second, %.1e after 2.5\n",
            std::string(named(method).name).c_str(), std::ranges::max(seen.speed), seen.depth[59], seen.depth.back());
        EXPECT_LE(std::ranges::max(seen.speed), 1);
        EXPECT_LT(seen.depth[59], 0.05);
        EXPECT_LE(seen.depth.back(), 1e-6);
    }
}

TEST(ContactTest, NoKindOfColliderThrowsWhatStartsInIt) {
    struct Case {
        const char* name;
        Collider collider;
        double speed;  ///< m/s
    };
    const Case cases[] = {{"plane", {Plane{{0, 1, 0}, 0.2}}, 1e-4},
                          {"box below all of it", {Box{{0, 0, 0}, {0.7, 0.2, 0.7}}}, 1e-4},
                          {"box below the middle", {Box{{0, 0, 0}, {0.3, 0.2, 0.3}}}, 0.6},
                          {"narrow box", {Box{{0, 0, 0}, {0.05, 0.2, 0.3}}}, 0.8},
                          {"box beside it", {Box{{0.5, 0, 0}, {0.3, 0.2, 0.3}}}, 0.6},
                          {"ellipsoid", {Ellipsoid{{0, 0, 0}, {0.3, 0.2, 0.25}}}, 1},
                          {"capsule", {Capsule{{-0.2, 0, 0}, {0.2, 0, 0}, {0.2, 0.2}}}, 1}};
    for (const auto& [name, collider, speed] : cases) {
        const Leaving seen = leave(collider, SolverMethod::line, 75);
        std::printf("[ measured ] %s: at most %.2f m/s, %.1e m deep after 1.25 s\n", name, std::ranges::max(seen.speed),
                    seen.depth.back());
        EXPECT_GT(seen.depth.front(), 0.04) << name;
        EXPECT_LE(std::ranges::max(seen.speed), speed) << name;
        EXPECT_LE(seen.depth.back(), 1e-6) << name;
        const Leaving surface = leave(collider, SolverMethod::line, 75, ContactOf::surface);
        std::printf("[ measured ] %s: all that is drawn at most %.2f m/s\n", name, std::ranges::max(surface.speed));
        EXPECT_LE(std::ranges::max(surface.speed), speed) << name;
        EXPECT_LE(surface.depth.back(), 1e-6) << name;
    }
}

/// Returns a collider of any kind but a mesh, 1 mm to 10 m large, anywhere and turned.
Collider random_collider(std::mt19937& random) {
    const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    const auto size = [&] { return std::pow(10, uniform(-3, 1)); };
    const auto place = [&] { return Vec3{uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)}; };
    const Plane plane{place(), uniform(-1, 1)};
    const Sphere sphere{place(), size()};
    const Box box{place(), {size(), size(), size()}};
    const Ellipsoid ellipsoid{place(), {size(), size(), size()}};
    const Capsule capsule{place(), place(), {size(), size()}};
    const std::vector<ColliderShape> shapes = test::of_every_kind<Mesh>(plane, sphere, box, ellipsoid, capsule);
    Collider collider{shapes[std::uniform_int_distribution<std::size_t>(0, shapes.size() - 1)(random)]};
    collider.rotate = {uniform(0, 360), uniform(0, 360), uniform(0, 360)};
    return collider;
}

/// The passes of the device leave out colliders whose reach a point is beyond, so contact must leave such points.
TEST(ContactTest, WhatIsBeyondReachIsLeftAsItIs) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    std::array<int, glsl::collider_kind_count> beyond{}, near{}, far{};
    for (int i = 0; i < 300000; ++i) {
        const Collider collider = random_collider(random);
        const glsl::ColliderRecord record = collider_record(collider, 0, 0);
        const double thickness = uniform(0, 1) < 0.2 ? 0 : std::pow(10, uniform(-4, -1));
        Vec3 at{uniform(-6, 6), uniform(-6, 6), uniform(-6, 6)};
        // Most points are next to where contact begins, moved along the distance's gradient to a few roundings of it.
        for (int step = 0; step < 3 && i % 8 != 0; ++step) {
            const auto distance = [&](const Vec3& x) { return exact::surface_distance(collider, 0, x); };
            const double wanted = thickness * (1 + 1e-6 * normal(random)), off = wanted - distance(at), d = 1e-7;
            Vec3 moved = at;
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3 there = at;
                there[k] += d;
                moved[k] += off * (distance(there) - distance(at)) / d;
            }
            at = moved;
        }
        const glsl::vec3 now{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
        const glsl::vec3 nowhere{0, 0, 0};
        const auto kept = static_cast<float>(thickness);
        const glsl::vec3 size{record.shape.x, record.shape.y, record.shape.z};
        const glsl::vec4 ball{record.pose_x.w, record.pose_y.w, record.pose_z.w,
                              glsl::bounding_radius(collider.kind(), size)};
        const bool far_off = !glsl::near_ball(ball, now, now, kept);
        const bool left_out = far_off || glsl::beyond_reach(collider.kind(), record, now, kept);
        far[static_cast<std::size_t>(collider.kind())] += far_off;
        const glsl::Contact contact =
            glsl::collider_contact(collider.kind(), record, now, nowhere, kept, 0.5f, 1.0f, true, nullptr);
        ++(left_out ? beyond : near)[static_cast<std::size_t>(collider.kind())];
        if (!left_out) continue;
        ASSERT_EQ(contact.depth, 0.0f) << "kind " << collider.kind() << " at " << at[0] << ", " << at[1] << ", "
                                       << at[2];
        ASSERT_TRUE(contact.displacement.x == 0.0f && contact.displacement.y == 0.0f && contact.displacement.z == 0.0f);
    }
    for (std::size_t kind = 0; kind < beyond.size(); ++kind) {
        if (kind == glsl::kind_mesh) continue;
        EXPECT_GT(beyond[kind], 1000) << "kind " << kind;
        EXPECT_GT(near[kind], 1000) << "kind " << kind;
        EXPECT_TRUE(kind == glsl::kind_plane || far[kind] > 1000) << "kind " << kind;
    }
}

/// Bounds leave out what is farther from a mesh than contact reaches, by its triangles' distances.
TEST(ContactTest, WhatIsBeyondReachOfAMeshIsFarFromIt) {
    std::mt19937 random(12);
    const auto uniform = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    Mesh mesh = test::mesh_of(test::torus_mesh(0.3, 0.1, 48), {0.1, 0.2, -0.1});
    mesh.grown = 0.02;
    const Collider collider{mesh, 0.3, {20, 30, 40}};
    const glsl::ColliderRecord record = collider_record(collider, 0, 0);
    const glsl::vec4 ball{
        record.pose_x.w, record.pose_y.w, record.pose_z.w,
        glsl::bounding_radius(glsl::kind_mesh, {record.shape.x, record.shape.y, record.shape.z}) + record.way_out.y};
    int left_out = 0, near = 0;
    for (int i = 0; i < 30000; ++i) {
        const Vec3 at{uniform(-0.6, 0.8), uniform(-0.5, 0.9), uniform(-0.8, 0.6)};
        const glsl::vec3 now{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
        const float thickness = 0.01f;
        const double distance = exact::surface_distance(collider, 0, at);
        near += distance < thickness;
        if (glsl::near_ball(ball, now, now, thickness) && !glsl::beyond_reach(glsl::kind_mesh, record, now, thickness))
            continue;
        ++left_out;
        EXPECT_GT(distance, thickness);
    }
    EXPECT_GT(left_out, 10000);
    EXPECT_GT(near, 1000);
}

}  // namespace
}  // namespace drape
