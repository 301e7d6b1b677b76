// What seams give to cloths, by the twin: against weights, against the load by which they rip, and by Newton's third
// law, which nothing in the program asks for where no pin holds what is sewn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "sewn_measures.h"
#include "simulated.h"
#include "support/sewn_scenes.h"

namespace drape {
namespace {

using namespace test;

class SeamForces : public testing::TestWithParam<SolverMethod> {};

Vec3 told(const ClothStatistics& cloth, const std::string& by) {
    for (const ForceOnCloth& each : cloth.forces)
        if (each.by == by) return each.force;
    ADD_FAILURE() << "no force by " << by;
    return {};
}

/// How far what is told is from Newton's laws.
struct Errors {
    double change = 0;   ///< the largest difference of the sum of a cloth's forces and its change of momentum
    double rest = 0;     ///< the largest sum of what seams give, where each cloth by itself gives them all that is left
    double largest = 0;  ///< force
};

/// Runs some frames and holds the forces against the change of momentum, which the statistics tell by other sums.
Errors run(Simulated& simulated, std::uint32_t frames) {
    Errors errors;
    std::vector<ClothStatistics> before;
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        simulated.frames(1);
        const std::vector<ClothStatistics> now = simulated.all_statistics();
        Vec3 left{};
        for (std::size_t k = 0; k < now.size(); ++k) {
            Vec3 sum{};
            for (const ForceOnCloth& each : now[k].forces) {
                sum = plus(sum, each.force);
                errors.largest = std::max(errors.largest, length(each.force));
            }
            left = plus(left, told(simulated.statistics(k), "seams"));
            if (before.empty()) continue;
            const Vec3 change = times(1 / simulated.frame_time(), minus(now[k].momentum, before[k].momentum));
            errors.change = std::max(errors.change, length(minus(sum, change)));
        }
        if (!before.empty()) errors.rest = std::max(errors.rest, length(left));
        before = now;
    }
    return errors;
}

void tell(const Errors& errors, SolverMethod method, const char* what) {
    std::printf("[ measured ] %s, %s: forces add up to %.1e N, seams by themselves to %.1e N, of %.3g N\n",
                name_of(method).c_str(), what, errors.change, errors.rest, errors.largest);
}

TEST_P(SeamForces, AddUpToTheChangeOfMomentum) {
    SceneDescription scene = by_method(two_panels(GetParam()), GetParam(), 12);
    scene.cloths[1].loads = {pull({{0, 8}, {16, 8}}, Vec3{0.3, -0.5, 0.2})};
    scene.cloths[1].damping = scene.cloths[0].damping = 0.5;
    Simulated simulated(scene);
    const Errors errors = run(simulated, 20);
    tell(errors, GetParam(), "a panel hangs from another");
    EXPECT_LT(errors.change, 1e-4 * errors.largest);
}

/// Without pins each cloth's seams give what nothing else gave it, so the third law is the solver's.
TEST_P(SeamForces, OfFreeClothsAreOpposite) {
    for (const bool unlike : {false, true}) {
        SceneDescription scene = by_method(unlike ? unlike_panels(GetParam()) : two_panels(GetParam()), GetParam(), 12);
        for (Cloth& cloth : scene.cloths) cloth.pins.clear();
        scene.colliders.clear();
        scene.wind = {};
        scene.cloths[1].loads = {pull({{0, 8}, {16, 8}}, Vec3{0.3, -0.5, 0.2})};
        Simulated simulated(scene);
        const Errors errors = run(simulated, 20);
        tell(errors, GetParam(), unlike ? "three free panels of unlike sides" : "two free panels");
        EXPECT_LT(errors.change, 1e-4 * errors.largest);
        EXPECT_LT(errors.rest, 1e-4 * errors.largest) << "the third law is the solver's while forces are steady";
    }
}

/// Two panels that hang from the row where they are sewn, which pins of the first one hold.
TEST_P(SeamForces, PinsOnSewnParticlesBearBothOnce) {
    SceneDescription scene = by_method(halves(8, true), GetParam(), 12);
    Cloth &one = scene.cloths[0], &other = scene.cloths[1];
    one.placement = {{-0.5, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    one.placement.origin[1] = -0.5;
    other.placement = {{-0.5, 0, 0}, {1, 0, 0}, {0, -1, 0}};
    one.pins = {pin_box(0, 4, 8, 4)};
    other.areal_density = 0.35;
    for (Cloth& cloth : scene.cloths) cloth.damping = 12;
    Simulated simulated(scene);
    simulated.frames(180);
    const std::vector<ClothStatistics> now = simulated.all_statistics();
    const double weight = now[0].mass * 9.81, other_weight = now[1].mass * 9.81;
    expect_near(told(now[0], "pins_0"), {0, weight + other_weight, 0}, 1e-4, "the pins of both");
    expect_near(told(now[0], "seams"), {0, -other_weight, 0}, 1e-4, "what the first bears of the other");
    expect_near(told(now[1], "seams"), {0, other_weight, 0}, 1e-4, "what bears the other");
}

TEST_P(SeamForces, BearWhatHangsFromThem) {
    for (const bool both_pinned : {false, true}) {
        SceneDescription scene = by_method(halves(8, !both_pinned), GetParam(), 12);
        for (Cloth& cloth : scene.cloths) {
            cloth.damping = 12;
            cloth.placement.v = {0, -1, 0};
        }
        if (!both_pinned) scene.cloths[1].placement.origin = {-0.5, 0.5, 0};
        Simulated simulated(scene);
        simulated.frames(180);
        const std::vector<ClothStatistics> now = simulated.all_statistics();
        const double weight = now[0].mass * 9.81;
        const auto expect_upward = [&](const ClothStatistics& cloth, const std::string& by, double expected) {
            // Along the load seams also pull sideways: the hanging sheet becomes narrower.
            expect_near({0, told(cloth, by)[1], 0}, {0, expected, 0}, both_pinned ? 5e-3 : 1e-4, by.c_str());
        };
        expect_upward(now[0], "pins_0", both_pinned ? weight : 2 * weight);
        if (!both_pinned) expect_upward(now[1], "seams", weight);
        if (both_pinned) expect_upward(now[1], "pins_0", weight);
        for (std::size_t k = 0; both_pinned && k < now.size(); ++k)
            EXPECT_LT(std::abs(told(now[k], "seams")[1]), 5e-3 * weight);
    }
}

/// The load by which a seam rips is summed on the device, by place; the force on the cloth is what is left of all else.
TEST_P(SeamForces, AreTheLoadsByWhichSeamsRip) {
    SceneDescription scene = by_method(pulled_strip(GetParam(), 3, 1000), GetParam(), 12);
    Simulated simulated(scene);
    simulated.frames(60);
    double worst = 0;
    for (std::uint32_t frame = 61; frame <= 80; ++frame) {
        simulated.frames(1);
        const Vec3 force = told(simulated.all_statistics()[0], "seams");
        const double load =
            0.2 * seam_statistics(simulated.model().cloths[0], simulated.twin().cloth(0).bytes(Field::seam_loads)).load;
        worst = std::max(worst, std::abs(length(force) - load) / load);
    }
    std::printf("[ measured ] %s: load and force of a seam differ by %.1e\n", name_of(GetParam()).c_str(), worst);
    EXPECT_LT(worst, 2e-3);
}

TEST_P(SeamForces, OnAGroundCollidersBearAll) {
    if (GetParam() == SolverMethod::explicit_steps) GTEST_SKIP() << "scenes of it are refused: 3 % are not told";
    SceneDescription scene = by_method(two_panels(GetParam()), GetParam(), 12);
    scene.wind = {};
    for (Cloth& cloth : scene.cloths) {
        cloth.pins.clear();
        cloth.damping = 4;
        cloth.velocity = {};
        cloth.placement.origin[1] = 0.02;
    }
    scene.colliders = {Collider{Plane{}}};
    Simulated simulated(scene);
    const Errors errors = run(simulated, 90);
    tell(errors, GetParam(), "two panels fall on the ground");
    // Each by itself gives seams what is left, so the ground's force is what was felt of it.
    const ClothStatistics one = simulated.statistics(0), other = simulated.statistics(1);
    const Vec3 borne = plus(told(one, "collider_0_plane"), told(other, "collider_0_plane"));
    expect_near(borne, {0, 9.81 * (one.mass + other.mass), 0}, 1e-4, "the ground");
}

INSTANTIATE_TEST_SUITE_P(Methods, SeamForces,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& each) {
                             return each.param == SolverMethod::explicit_steps ? "Explicit" : name_of(each.param);
                         });

}  // namespace
}  // namespace drape
