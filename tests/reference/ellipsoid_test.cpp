// Foot points on ellipsoids in single precision agree with bisection in double precision.
#include <gtest/gtest.h>

#include <random>

#include "twin/kernels.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

TEST(EllipsoidTest, FootPointsMatchDoublePrecision) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1), ratio(0.1, 1);
    double worst = 0;
    int checked = 0;
    while (checked < 20000) {
        const Vec3 radii{ratio(random), ratio(random), ratio(random)};
        const double size = std::max({radii[0], radii[1], radii[2]});
        Vec3 direction{unit(random), unit(random), unit(random)};
        if (length(direction) < 0.1) continue;
        // A surface point is moved along its normal: outside by up to the size, inside by up to half the least radius
        // of curvature, where the foot is unique.
        double level = 0;
        for (std::size_t k = 0; k < 3; ++k) level += std::pow(direction[k] / radii[k], 2);
        Vec3 surface, normal;
        for (std::size_t k = 0; k < 3; ++k) surface[k] = direction[k] / std::sqrt(level);
        for (std::size_t k = 0; k < 3; ++k) normal[k] = surface[k] / (radii[k] * radii[k]);
        const double smallest = std::min({radii[0], radii[1], radii[2]});
        const double shift = unit(random) > 0 ? std::abs(unit(random)) * size
                                              : -std::abs(unit(random)) * 0.5 * smallest * smallest / size;
        Vec3 point;
        for (std::size_t k = 0; k < 3; ++k) point[k] = surface[k] + shift * normal[k] / length(normal);
        const glsl::vec3 p{float(point[0]), float(point[1]), float(point[2])};
        const glsl::vec3 r{float(radii[0]), float(radii[1]), float(radii[2])};
        const glsl::vec3 foot = glsl::ellipsoid_foot(p, r);
        const Vec3 exact =
            exact::ellipsoid_foot({double(p.x), double(p.y), double(p.z)}, {double(r.x), double(r.y), double(r.z)});
        worst = std::max(worst, length(minus({double(foot.x), double(foot.y), double(foot.z)}, exact)) / size);
        ++checked;
    }
    std::printf("[ measured ] worst foot error over %d points: %.2e of the largest radius\n", checked, worst);
    EXPECT_LE(worst, 1e-6);
}

TEST(EllipsoidTest, PointsOnTheAxesAndTheCentreHaveAFoot) {
    const glsl::vec3 radii{0.5f, 0.25f, 0.125f};
    for (const glsl::vec3 p : {glsl::vec3{0, 0, 0}, glsl::vec3{0.3f, 0, 0}, glsl::vec3{0, 0.2f, 0},
                               glsl::vec3{0, 0, 0.1f}, glsl::vec3{0.6f, 0, 0}, glsl::vec3{0, -0.3f, 0}}) {
        const glsl::vec3 foot = glsl::ellipsoid_foot(p, radii);
        const double level = std::pow(double(foot.x) / 0.5, 2) + std::pow(double(foot.y) / 0.25, 2) +
                             std::pow(double(foot.z) / 0.125, 2);
        EXPECT_NEAR(level, 1.0, 1e-5) << p.x << " " << p.y << " " << p.z;
    }
}

}  // namespace
}  // namespace drape
