// The force of a steady wind on a flat plate, and no force on what has no area.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/kernels.h"
#include "reference/twin.h"
#include "support/sheets.h"

namespace drape {
namespace {

/// Total wind force on a 0.6 x 0.4 m plate at rest in the xy plane.
Vec3 plate_force(const Vec3& wind, double drag, double lift) {
    SceneDescription scene = test::sheet(13, 9, 0.6, 0.4, 1);
    scene.wind.velocity = wind;
    scene.wind.drag = drag;
    scene.wind.lift = lift;
    const SimulationModel model(scene);
    Twin twin(model);
    twin.cloth(0)[Field::displacement].assign(13 * 9, {});
    twin.run_step({StepKind::wind, 0, 0}, frame_inputs(model, 1));
    Vec3 sum{};
    for (const glsl::vec4& force : twin.cloth(0)[Field::wind_force]) {
        sum[0] += double(force.x);
        sum[1] += double(force.y);
        sum[2] += double(force.z);
    }
    return sum;
}

TEST(WindTest, AFlatPlateFeelsTheStatedForce) {
    for (const double degrees : {0.0, 20.0, 45.0, 70.0, 85.0, 160.0})
        for (const auto& [drag, lift] : {std::pair{1.0, 0.5}, {1.2, 0.0}, {0.3, 0.9}}) {
            const double a = degrees * M_PI / 180;
            const Vec3 v{8 * std::sin(a), 0, 8 * std::cos(a)};  // the plate's normal is along z
            const Vec3 measured = plate_force(v, drag, lift);
            const double side = v[2] < 0 ? -1 : 1, along = std::abs(v[2]);
            const double scale = 0.5 * 1.2 * 0.6 * 0.4;
            const Vec3 stated{scale * (drag - lift) * along * v[0], 0,
                              scale * ((drag - lift) * along * v[2] + lift * 64 * side)};
            const double size = std::hypot(stated[0], stated[2]);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(measured[k], stated[k], 1e-5 * size) << degrees;
        }
}

TEST(WindTest, ADegenerateTriangleFeelsNothing) {
    using namespace glsl;
    const vec3 zero{0, 0, 0}, wind{5, 0, 3};
    const vec3 points[][3] = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
                              {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                              {{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}}};
    for (const auto& p : points) {
        const vec3 force = triangle_wind_force(p[0], p[1], p[2], zero, wind, 0.6f, 0.3f);
        EXPECT_EQ(force.x, 0.0f);
        EXPECT_EQ(force.y, 0.0f);
        EXPECT_EQ(force.z, 0.0f);
    }
}

TEST(WindTest, AMovingPlateFeelsTheRelativeWindOnly) {
    // Moving with the wind: no force at all, so the plate keeps its speed to rounding.
    SceneDescription scene = test::sheet(5, 5, 0.4, 0.4, 8);
    scene.gravity = {0, 0, 0};
    scene.wind.velocity = {2, 0, 3};
    scene.cloths[0].velocity = {2, 0, 3};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 60; ++frame) twin.run_frame(frame);
    for (std::size_t i = 0; i < 25; ++i) {
        EXPECT_NEAR(double(twin.cloth(0)[Field::position][i].x) - double(model.cloths[0].position[i].x), 2.0, 1e-5);
        EXPECT_NEAR(double(twin.cloth(0)[Field::position][i].z) - double(model.cloths[0].position[i].z), 3.0, 1e-5);
    }
}

}  // namespace
}  // namespace drape
