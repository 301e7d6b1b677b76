// Foot points on capsules in single precision agree with the nearest ball of the sweep in double precision.
#include <gtest/gtest.h>

#include <random>

#include "twin/kernels.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

Vec3 foot_of(const glsl::vec3& p, const glsl::SurfacePoint& surface) {
    return {double(p.x) - double(surface.normal.x) * double(surface.distance),
            double(p.y) - double(surface.normal.y) * double(surface.distance),
            double(p.z) - double(surface.normal.z) * double(surface.distance)};
}

/// Returns the capsule as the device holds it, in its own frame.
Capsule upright(const glsl::vec3& size) {
    return {{0, -double(size.x), 0}, {0, double(size.x), 0}, {double(size.y), double(size.z)}};
}

TEST(CapsuleTest, FootPointsMatchDoublePrecision) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1), ratio(0.05, 1);
    double worst_foot = 0, worst_distance = 0;
    int checked = 0, inside = 0, on_side = 0, swallowed = 0;
    while (checked < 20000) {
        // Some ends nearly or wholly hold each other.
        const double half = checked % 5 == 0 ? 0.3 * ratio(random) * ratio(random) : ratio(random);
        const glsl::vec3 size{float(half), float(ratio(random)), float(ratio(random))};
        const Capsule capsule = upright(size);
        const double extent = half + std::max(capsule.radii[0], capsule.radii[1]);
        const glsl::vec3 p{float(1.5 * extent * unit(random)), float(1.5 * extent * unit(random)),
                           float(1.5 * extent * unit(random))};
        const Vec3 point{double(p.x), double(p.y), double(p.z)};
        // On the axis, and in the middle of a ball, there is no one foot.
        if (std::hypot(point[0], point[2]) < 0.05 * extent) continue;
        Vec3 exact;
        const double distance = exact::capsule_sweep(capsule, point, &exact);
        const glsl::SurfacePoint surface = glsl::capsule_surface(p, size);
        worst_distance = std::max(worst_distance, std::abs(double(surface.distance) - distance) / extent);
        worst_foot = std::max(worst_foot, length(minus(foot_of(p, surface), exact)) / extent);
        inside += distance < 0;
        on_side += std::abs(exact[1]) < 0.9 * half;
        swallowed += std::abs(capsule.radii[0] - capsule.radii[1]) >= 2 * half;
        ++checked;
    }
    std::printf(
        "[ measured ] worst over %d points (%d inside, %d on a side, %d of a ball in a ball): foot %.2e, "
        "distance %.2e of the extent\n",
        checked, inside, on_side, swallowed, worst_foot, worst_distance);
    EXPECT_LE(worst_foot, 2e-6);
    EXPECT_LE(worst_distance, 5e-7);
    EXPECT_GT(std::min({inside, on_side, swallowed}), 500);
}

TEST(CapsuleTest, PointsOnTheAxisHaveAUnitNormal) {
    for (const glsl::vec3 size : {glsl::vec3{0.5f, 0.3f, 0.1f}, glsl::vec3{0.5f, 0.2f, 0.2f}, glsl::vec3{0, 0.2f, 0.2f},
                                  glsl::vec3{0.1f, 0.1f, 0.4f}, glsl::vec3{0.1f, 0.3f, 0.1f}})
        for (const float y : {-2.0f, -0.5f, -0.1f, 0.0f, 0.3f, 0.5f, 2.0f}) {
            const glsl::SurfacePoint surface = glsl::capsule_surface({0, y, 0}, size);
            EXPECT_NEAR(length({double(surface.normal.x), double(surface.normal.y), double(surface.normal.z)}), 1,
                        1e-6);
            EXPECT_NEAR(double(surface.distance), exact::shape_distance(upright(size), {0, double(y), 0}), 1e-6) << y;
        }
}

TEST(CapsuleTest, OfEqualRadiiIsTheSegmentsDistance) {
    const glsl::vec3 size{0.5f, 0.25f, 0.25f};
    EXPECT_FLOAT_EQ(glsl::capsule_surface({1, 0.25f, 0}, size).distance, 0.75f);
    EXPECT_FLOAT_EQ(glsl::capsule_surface({0, 1.5f, 0}, size).distance, 0.75f);
    EXPECT_FLOAT_EQ(glsl::capsule_surface({3, 4.5f, 0}, size).distance, 4.75f);
    EXPECT_FLOAT_EQ(glsl::capsule_surface({0, 0, -0.125f}, size).distance, -0.125f);
}

}  // namespace
}  // namespace drape
