// Momentum of closed systems of cloths that strike each other, drawn from a seed. The bounds are those of rounding:
// what contact gives to one cloth it takes from another.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "base/vectors.h"
#include "cloth/simulation_model.h"
#include "support/self_contact_scenes.h"
#include "twin/twin.h"

namespace drape {
namespace {

/// Two to four sheets that fly at each other at 1 to 30 m/s, with densities that differ by up to 50 times.
SceneDescription closed_system(std::mt19937& random) {
    const auto between = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    constexpr std::array methods{SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps};
    constexpr std::array<std::uint32_t, 3> substeps{12, 16, 48};
    const std::size_t kind = std::uniform_int_distribution<std::size_t>(0, 2)(random);
    SceneDescription scene = test::layers(methods[kind], substeps[kind]);
    scene.gravity = {0, 0, 0};
    scene.colliders.clear();
    const Cloth sheet = scene.cloths[0];
    scene.cloths.clear();
    const auto count = std::uniform_int_distribution<std::uint32_t>(2, 4)(random);
    const double speed = std::pow(30.0, between(0, 1)), thickness = between(0.1, 0.9) * 0.1, friction = between(0, 1);
    for (std::uint32_t k = 0; k < count; ++k) {
        Cloth cloth = sheet;
        cloth.name = "cloth " + std::to_string(k);
        cloth.grid = {5, 5};
        cloth.size = {0.4, 0.4};
        cloth.pins.clear();
        cloth.damping = 0;
        cloth.areal_density = 0.1 * std::pow(50.0, between(0, 1));
        cloth.self_collision = SelfCollision{thickness, friction};
        cloth.placement.origin = {between(-0.1, 0.1), k * (thickness * 1.5 + 0.05), between(-0.1, 0.1)};
        cloth.velocity = {speed * between(-0.3, 0.3), -speed * k / (count - 1), speed * between(-0.3, 0.3)};
        scene.cloths.push_back(cloth);
    }
    return scene;
}

/// Mass times motion in a substep, of one cloth, in a unit of its own density.
Vec3 momentum(const SimulationModel& model, const Twin& twin, std::size_t cloth) {
    Vec3 sum{};
    const auto& position = twin.cloth(cloth)[Field::position];
    const auto& moved = twin.cloth(cloth)[Field::displacement];
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const double mass = model.scene.cloths[cloth].areal_density / double(position[i].w);
        const std::array<float, 3> d{moved[i].x, moved[i].y, moved[i].z};
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += mass * double(d[axis]);
    }
    return sum;
}

TEST(ContactMomentumTest, ClosedSystemsKeepTheirs) {
    std::mt19937 random(48);
    double worst = 0;
    int struck = 0;
    for (int trial = 0; trial < 12; ++trial) {
        const SimulationModel model(closed_system(random));
        Twin twin(model);
        std::vector<Vec3> start;
        for (std::size_t k = 0; k < model.cloths.size(); ++k) start.push_back(momentum(model, twin, k));
        for (std::uint32_t frame = 1; frame <= 8; ++frame) twin.run_frame(frame);
        Vec3 change{};
        double exchanged = 0, all = 0;
        for (std::size_t k = 0; k < model.cloths.size(); ++k) {
            Vec3 own = momentum(model, twin, k);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                own[axis] -= start[k][axis];
                change[axis] += own[axis];
            }
            exchanged += length(own);
            all += length(start[k]);
        }
        if (exchanged < 1e-3 * all) continue;  // nobody struck anybody
        ++struck;
        EXPECT_LT(length(change), 1e-4 * exchanged) << trial;
        EXPECT_EQ(twin.contact().record.unproved, 0u) << trial;
        worst = std::max(worst, length(change) / exchanged);
    }
    EXPECT_GE(struck, 8);
    std::printf("[ measured ] at most %.1e of what is exchanged is lost\n", worst);
}

}  // namespace
}  // namespace drape
