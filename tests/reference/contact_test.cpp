// Penetration of particles, edges and triangles into each collider kind: at rest, moving, rotated, overlapping.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reference/twin.h"
#include "support/sheets.h"
#include "support/surface_distance.h"

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
    double particles = 0, edges = 0, triangles = 0;  ///< deepest, m; below zero: never inside
    bool touched = false;
};

/// Drops a horizontal sheet onto the colliders and measures against double precision every frame.
Depths drop(const Colliders& colliders, const std::function<void(SceneDescription&)>& change = {}) {
    SceneDescription scene = test::sheet(33, 33, 1.6, 1.6, 12);
    scene.time.frame_count = 121;
    scene.colliders = colliders;
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.8, 0.9, -0.8}, {1, 0, 0}, {0, 0, 1}};
    cloth.thickness = 0;
    cloth.damping = 0.5;
    if (change) change(scene);
    const SimulationModel model(scene);
    Twin twin(model);
    Depths deepest{-1e300, -1e300, -1e300};
    const Grid& grid = model.cloths[0].grid;
    for (std::uint32_t frame = 1; frame <= 120; ++frame) {
        twin.run_frame(frame);
        const double time = frame / 60.0;
        const auto depth = [&](const Vec3& x) { return -test::surface_distance(scene.colliders, time, x); };
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

/// `size`: of the collider; `radius`: least radius of curvature (0: flat or sharp: no sagitta bound).
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

Colliders one_sphere() {
    Colliders colliders;
    SphereCollider sphere;
    sphere.center = {0, 0.3, 0};
    sphere.radius = 0.5;
    colliders.spheres.push_back(sphere);
    return colliders;
}

Colliders one_ellipsoid() {
    Colliders colliders;
    EllipsoidCollider ellipsoid;
    ellipsoid.center = {0, 0.3, 0};
    ellipsoid.radii = {0.6, 0.4, 0.3};
    ellipsoid.rotate = {20, 30, 40};
    colliders.ellipsoids.push_back(ellipsoid);
    return colliders;
}

Colliders one_box() {
    Colliders colliders;
    BoxCollider box;
    box.center = {0, 0.3, 0};
    box.half_extents = {0.4, 0.3, 0.3};
    box.rotate = {10, 25, 15};
    colliders.boxes.push_back(box);
    return colliders;
}

const MotionPath moving{
    {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.2, 0.1, -0.1}, {30, 200, -40}}, {2, {0, 0.2, 0.1}, {0, 360, 0}}}};

TEST(ContactTest, Plane) {
    Colliders colliders;
    PlaneCollider plane;
    plane.normal = {0.2 / std::hypot(0.2, 1), 1 / std::hypot(0.2, 1), 0};
    plane.offset = 0.1;
    colliders.planes.push_back(plane);
    expect_contact("plane", drop(colliders), 1.0, 0);
    colliders.planes[0].path = {{{0, {0, 0, 0}, {0, 0, 0}}, {2, {0, 0.4, 0}, {10, 0, 15}}}};
    expect_contact("moving plane", drop(colliders), 1.0, 0);
}

TEST(ContactTest, Sphere) {
    Colliders colliders = one_sphere();
    expect_contact("sphere", drop(colliders), 0.5, 0.5);
    colliders.spheres[0].path = moving;
    expect_contact("moving sphere", drop(colliders), 0.5, 0.5);
}

TEST(ContactTest, Box) {
    Colliders colliders = one_box();
    expect_contact("box", drop(colliders), 0.4, 0);
    colliders.boxes[0].path = moving;
    expect_contact("moving box", drop(colliders), 0.4, 0);
}

TEST(ContactTest, Ellipsoid) {
    Colliders colliders = one_ellipsoid();
    const double curvature = 0.3 * 0.3 / 0.6;
    expect_contact("ellipsoid", drop(colliders), 0.6, curvature);
    colliders.ellipsoids[0].path = moving;
    expect_contact("moving ellipsoid", drop(colliders), 0.6, curvature);
}

TEST(ContactTest, OverlappingColliders) {
    Colliders colliders = one_sphere();
    SphereCollider second = colliders.spheres[0];
    second.center = {0.45, 0.35, 0.1};
    second.radius = 0.4;
    colliders.spheres.push_back(second);
    expect_contact("two overlapping spheres", drop(colliders), 0.5, 0);

    colliders = one_ellipsoid();
    colliders.boxes = one_box().boxes;
    colliders.boxes[0].center = {0.3, 0.3, 0.2};
    colliders.planes.emplace_back();
    colliders.boxes[0].path = moving;
    expect_contact("box, ellipsoid and plane overlapping, box moving", drop(colliders), 0.6, 0);
}

TEST(ContactTest, ThicknessKeepsItsDistance) {
    const Depths depths = drop(one_sphere(), [](SceneDescription& scene) { scene.cloths[0].thickness = 0.02; });
    EXPECT_TRUE(depths.touched);
    EXPECT_LE(depths.particles, 1e-5 * 0.5);
    EXPECT_LE(depths.edges, 0.0) << "thickness covers the sagitta";
}

}  // namespace
}  // namespace drape
